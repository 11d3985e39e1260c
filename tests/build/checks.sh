#!/usr/bin/env bash
# Assertions (src/base/base_checks.F90): in the flavour debug a wrong call of linalg, cone or contact
# ends the program with what is wrong and where; release has no trace of them.
set -u
unset MAKEFLAGS MFLAGS MAKELEVEL FFLAGS WERROR
n_passed=0 n_failed=0

# expect WHAT STATUS: the last command has ended with 0.
expect() {
  if [[ $2 == 0 ]]; then n_passed=$((n_passed + 1)); else
    n_failed=$((n_failed + 1))
    printf 'failed: %s:\n%s\n' "$1" "$out"
  fi
}

# Only the layers that are called.
mkdir -p "$TMP/tree/src" "$TMP/tree/tests/unit" && cd "$TMP/tree" || exit 1
cp -r "$ROOT/Makefile" "$ROOT/scripts" "$ROOT/VERSION" .
for layer in base linalg cone deck material element model contact; do
  [ ! -d "$ROOT/src/$layer" ] || cp -r "$ROOT/src/$layer" src/
done
cp -r "$ROOT/tests/support" tests/
cp "$ROOT/tests/unit/test_checks.f90" tests/unit/
out=$(make -j2 FLAVOUR=debug build/debug/tests/test_checks 2>&1)
expect 'the debug flavour builds' $?

out=$(FLAVOUR=debug build/debug/tests/test_checks 2>&1)
expect 'right calls pass' $?

while IFS='|' read -r layer message; do
  out=$(FLAVOUR=debug build/debug/tests/test_checks "$layer" 2>&1)
  [[ $? == 70 && $out == *"bipact: assertion failed in $message"* ]]
  expect "a wrong call of $layer" $?
done <<'END'
linalg|ldlt_forward: the vector of all nodes has the shape (2, 2), expected (2, 3)
cone|solve_cone: mu has the shape (1), expected (2)
contact|update_lists: u has the shape (2, 1), expected (2, 2)
END

# No object of the release flavour calls an assertion.
if [[ -d $ROOT/build/release/obj ]]; then
  out=$(cd "$ROOT/build/release/obj" && nm -A -u ./*.o |
    grep -E "__base_checks_MOD_|__linalg_solver_MOD_check_")
  [[ -z $out ]]
  expect 'release calls no assertion' $?
fi

echo "$n_passed passed, $n_failed failed"
((n_failed == 0))

#!/usr/bin/env bash
# Tests the build tools on small trees: dependency scanner, Makefile, style check, test runner.
set -u
ROOT=${ROOT:-$(cd "$(dirname "$0")/../.." && pwd)}
PYTHON=${PYTHON:-python3}
TMP=${TMP:-$(mktemp -d)}
unset MAKEFLAGS MFLAGS MAKELEVEL FLAVOUR WERROR FFLAGS LIMIT
n_passed=0 n_failed=0

# expect WHAT CODE TEXT: the last command ended with CODE, and its output (in $out) contains TEXT.
expect() {
  local code=$?
  if [[ $code == "$2" && $out == *"$3"* ]]; then
    n_passed=$((n_passed + 1))
  else
    n_failed=$((n_failed + 1))
    printf 'failed: %s: code %s, expected %s and "%s" in:\n%s\n' "$1" "$code" "$2" "$3" "$out"
  fi
}

# expect_in TEXT WHAT PART: another look at the same output.
expect_in() {
  out=$1
  true
  expect "$2" 0 "$3"
}

# module FILE [LINE]: writes a correct module whose declarations begin with LINE.
module() {
  local name
  name=$(basename "${1%.*}")
  mkdir -p "$(dirname "$1")"
  printf '%s\n' "module $name" "${2-}" 'implicit none' 'private' 'contains' '!> Does nothing.' \
    'subroutine work()' 'end subroutine work' "end module $name" | sed '/^$/d' >"$1"
}

new_tree() {
  rm -rf "$TMP/tree" && mkdir -p "$TMP/tree/src/run" && cd "$TMP/tree" || exit 1
  cp -r "$ROOT/Makefile" "$ROOT/scripts" .
  echo 1.2.3 >VERSION
  printf '%s\n' 'program bipact' 'use base_version, only: version' 'implicit none' \
    'print "(a)", version' 'end program bipact' >src/run/main.f90
  module src/base/base_a.f90
  module src/linalg/linalg_a.f90 'use base_a, only:'
}

# ---- scanner: each fault stops it with a message that names the place

scan() { out=$(awk -f scripts/mkdeps.awk src/*/*.[fF]90 2>&1 >deps.mk); }

new_tree
sed -i /base_version/d src/run/main.f90
scan; expect 'clean tree' 0 ''
out=$(<deps.mk); expect 'dependency on a module' 0 \
  'linalg_a.o: src/linalg/linalg_a.f90 $(B)/flags $(B)/mod/base_a.mod'

while IFS='|' read -r file use message; do
  new_tree
  sed -i /base_version/d src/run/main.f90
  module src/material/material_a.f90
  module src/model/model_a.f90
  module src/fclib/fclib_a.f90
  module "$file" "$use"
  scan; expect "$file: $use" 1 "$message"
done <<'END'
src/base/base_b.f90|use linalg_a, only: x|src/base/base_b.f90:2: error: layer base may not use linalg_a
src/contact/contact_a.f90|USE, non_intrinsic :: Material_A|layer contact may not use material_a
src/deck/deck_a.f90|use :: fclib_a|layer deck may not use fclib_a
src/base/base_b.f90|use base_c, only: x ! text|no source holds module base_c
src/base/base_b.f90|use base_b, only: x|uses itself
src/base/linalg_b.f90||must begin with its folder
src/linalg/base_a.F90||exists already
src/misc/misc_a.f90||is not a layer
END

new_tree
sed -i 's/module base_a/module base_b/' src/base/base_a.f90
scan; expect 'name of the module' 1 'base_a.f90:1: error: module base_b must have the name of its file'

# ---- build: first, idle, after a change inside a procedure, after a change of an interface

build() { out=$(make -j2 "$@" 2>&1); }

new_tree
build; expect 'first build' 0 'LINK bin/bipact'
out=$(bin/bipact); expect 'version' 0 '1.2.3'
build; [[ -z $out ]]; expect 'idle build' 0 ''
sed -i 's/^end sub/print *\n&/' src/base/base_a.f90
build; [[ $(grep -c FC <<<"$out") == 1 ]]; expect 'changed body compiles one file' 0 base_a
sed -i 's/^private/&\npublic work/' src/base/base_a.f90
build; [[ $(grep -c FC <<<"$out") == 2 ]]; expect 'changed interface compiles its users' 0 linalg_a
sed -i 's/^end sub/block; integer :: unused; end block\n&/' src/base/base_a.f90
build; expect 'a warning does not stop the build' 0 'Warning: Unused variable'
build WERROR=1; expect 'but does with WERROR=1' 2 'Unused variable'
build FC=no-such-compiler; expect 'no compiler' 2 'run "make deps"'
out=$(FC=no-such-compiler scripts/install-deps.sh --dry-run); code=$?
[[ $code == 0 ]] || ! command -v apt-get >/dev/null; expect 'install-deps.sh --dry-run' 0 gfortran

# ---- style: a line for every class of fault, none for what only looks like one

style() { out=$("$PYTHON" scripts/check_style.py "$PWD" 2>&1); }

new_tree
cat >src/base/base_good.f90 <<'END'
!> A module that obeys every rule.
module base_good
  use, intrinsic :: iso_c_binding, only: c_int, &
    c_ptr
  implicit none
  private
  public :: good_t, work, operator(+)
  integer, parameter :: one = 1
  type, abstract :: good_t
    integer :: n = 0          ! a component may have a default
    real, pointer :: stop_at(:) => null()
  contains
    procedure :: add => good_add
  end type good_t
  !> Adds.
  interface operator(+)
    module procedure :: plus
  end interface operator(+)
  abstract interface
    real function force(t) result(f)
      real, intent(in) :: t
    end function force
  end interface
contains
  !> Works. goto and stop in a comment do not count.
  pure real(kind(1.0)) function work(this, x, p, f) result(y)
    class(good_t), intent(in) :: this
    real, intent(in), &
      optional :: x(:)
    real, pointer :: p
    procedure(force) :: f
    logical :: go_to, stop
    y = 0; go_to = .true.; stop = .false.
    select type (this)
    type is (good_t)
      write (*, *) 'common /x/ &
        & stop', "it's ! no ""goto 10"" "
    end select
    end_of: if (go_to) then
      stop = present(x)
    end if end_of
  end function work
  subroutine good_add(this, g)
    class(good_t), intent(inout) :: this
    interface
      subroutine g(c)
        import :: c_int
        integer(c_int), value :: c
      end subroutine g
    end interface
  end subroutine good_add
end module base_good
END
style; expect 'correct source' 0 'procedures, lines of code: median'

while IFS='|' read -r line message; do
  new_tree
  printf '%b\n' "module base_bad" 'implicit none' 'private' 'public :: work' "@contains" \
    '!> Works.' 'subroutine work(a)' 'integer, intent(in) :: a' 'end subroutine work' \
    'end module base_bad' | sed "$line; s/@//" >src/base/base_bad.f90
  style; expect "style: $line" 1 "$message"
done <<'END'
s/@/\t/|src/base/base_bad.f90:5: tab
s/private/& /|src/base/base_bad.f90:3: trailing blank
s/@/integer :: n\n/|5: a module variable must be a parameter
s/@/integer, save :: n\n/|5: save is not allowed
s/@/save\n/|5: save and data are not allowed
2i use base_a|2: use base_a needs an only list
s/^implicit.*//|needs the statement: implicit none
s/^private.*//|needs the statement: private
s/!> Works/! Works/|7: public work needs a !> comment
s/, intent(in)//|7: argument a of work needs an intent
/integer, /a integer :: i = 1|9: initialising i here
/integer, /a if (a > 0) goto 10|9: goto is not allowed
/integer, /a common /x/ i|9: common is not allowed
/integer, /a if (a > 0) error stop 'x'|9: stop belongs
s/Works./&                                                                                        x/|6: 98 columns
END
new_tree
yes '! long' | head -n 500 >>src/base/base_a.f90
style; expect 'style: long file' 1 'base_a.f90:1: 508 lines, more than 500'
new_tree
sed -i "s/^end sub/$(printf 'continue\\n%.0s' {1..99})&/" src/base/base_a.f90
style; expect 'style: long procedure' 1 'base_a.f90:6: work has 101 lines of code'
new_tree
printf 'cd /%s/someone' home >notes.md
style; expect 'style: absolute path' 1 'notes.md:1: absolute path'
expect_in "$out" 'style: final newline' 'notes.md:1: no newline'

# ---- test runner: counts, skips, failures, time limit

new_tree
mkdir -p tests/a tests/b/c
cp "$ROOT/tests/run.sh" tests/
script() { printf '%s\n' '#!/bin/sh' "$2" >"tests/$1"; chmod +x "tests/$1"; }
run() { out=$(tests/run.sh "$@" 2>/dev/null); }
script a/one.sh 'sleep 0.2; echo data >"$TMP/file"; echo "3 passed, 0 failed"'
script b/c/run.sh 'echo reason; exit 77'
run; expect 'runner: all well' 0 $'ok   a/one\nskip b/c: reason\nok   style\n4 passed, 0 failed, 1 skipped'
script a/two.sh 'echo "2 passed, 1 failed"; echo why; exit 1'
script a/three.sh 'sleep 20'
LIMIT=1 run a/; expect 'runner: time limit' 1 $'FAIL a/three\n       (killed after 1 s'
expect_in "$out" 'runner: output of a failure' $'FAIL a/two\n       2 passed, 1 failed\n       why\n'
expect_in "$out" 'runner: counts' '5 passed, 2 failed'
run none; expect 'runner: nothing ran' 1 '0 passed, 0 failed'

echo "$n_passed passed, $n_failed failed"
((n_failed == 0))

#!/usr/bin/env bash
# Runs the tests, or those whose name contains PATTERN:  tests/run.sh [PATTERN]
#
# A test is a built program of tests/unit, an executable tests/*/*.sh or tests/*/*/run.sh, or the
# style check. Exit code 0 = passed, 77 = skipped (its last line says why), else failed. A test that
# prints a line "N passed, N failed" is counted by it. Each test gets BIPACT, PYTHON, ROOT and an
# empty directory TMP. Settings: FLAVOUR, JOBS (tests at once), LIMIT (seconds a test may take),
# SHOW=1 (print the measured figures of the deck tests beside their bounds), TIMES=FILE (seconds of
# each test go there).
set -u
cd "$(dirname "$0")/.." || exit 1

export ROOT=$PWD FLAVOUR=${FLAVOUR:-release}
suffix=-$FLAVOUR
[ "$FLAVOUR" = release ] && suffix=
export BIPACT=$ROOT/bin/bipact$suffix PYTHON=$ROOT/.venv/bin/python
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}   # several tests run at once
# nproc counts no more than OMP_NUM_THREADS, which is for each test.
JOBS=${JOBS:-$(env -u OMP_NUM_THREADS nproc 2>/dev/null || echo 2)}
LIMIT=${LIMIT:-300}
[ -x "$PYTHON" ] || PYTHON=$(command -v python3)    # enough for the style check
[ -x "$BIPACT" ] || echo "note: $BIPACT is not built; make test builds it" >&2

mkdir -p "build/$FLAVOUR"
work=$(mktemp -d "$ROOT/build/$FLAVOUR/scratch.XXXXXX")

# Stops what still runs, also after an interrupt.
finish() {
  cat "$work"/*.pid 2>/dev/null | xargs -r kill 2>/dev/null
  rmdir "$work" 2>/dev/null    # kept if it holds the scratch directory of a failed test
}
trap finish EXIT
trap 'exit 130' INT TERM

names=() commands=()
add() {
  [[ $1 == *"$pattern"* ]] || return 0
  names+=("$1") commands+=("$2")
}

pattern=${1:-}
shopt -s nullglob
for file in tests/unit/test_*.f90; do
  name=$(basename "$file" .f90)
  add "unit/${name#test_}" "build/$FLAVOUR/tests/$name"
done
for file in tests/*/*.sh tests/*/*/run.sh; do
  [[ $file == tests/support/* || ! -x $file ]] && continue
  name=${file#tests/} name=${name%.sh}
  add "${name%/run}" "$file"
done
add style scripts/check_style.py

run_one() {
  local base=$work/$1 command=("$ROOT/${commands[$1]}") begin=$SECONDS
  mkdir "$base.tmp"
  [[ ${command[0]} == *.py ]] && command=("$PYTHON" "${command[@]}")
  TMP=$base.tmp TMPDIR=$base.tmp timeout -k 5 "$LIMIT" "${command[@]}" \
    >"$base.out" 2>&1 </dev/null &
  echo $! >"$base.pid"
  wait $!
  echo $? >"$base.part"
  rm "$base.pid"
  [ -z "${TIMES:-}" ] || echo "$((SECONDS - begin)) s  ${names[$1]}" >>"$TIMES"
  mv "$base.part" "$base.status"    # at once: who sees it can read it
}

passed=0 failed=0 skipped=0

report() {
  local name=${names[$1]} base=$work/$1 status count p=0 f=0 s=0 why=
  status=$(<"$base.status")
  count=$(grep -aE '^[0-9]+ passed, [0-9]+ failed(, [0-9]+ skipped)?$' "$base.out" | tail -n 1)
  [[ $count =~ ^([0-9]+)\ passed,\ ([0-9]+)\ failed(,\ ([0-9]+))? ]] &&
    p=${BASH_REMATCH[1]} f=${BASH_REMATCH[2]} s=${BASH_REMATCH[4]:-0}
  case $status in
    0) [[ -n $count ]] || p=1
       ((p + f + s > 0)) || { f=1; why="nothing was checked"; } ;;
    77) p=0 f=0 s=1 ;;
    124 | 137) f=1 why="killed after $LIMIT s" ;;
    *) why="exit code $status"; ((f > 0)) || f=1 ;;
  esac
  ((passed += p, failed += f, skipped += s))
  if ((f > 0)); then
    echo "FAIL $name"
    sed 's/^/       /' "$base.out"
    echo "       ($why${why:+; }scratch files: ${base#"$ROOT"/}.tmp)"
  elif ((status == 77)); then
    echo "skip $name: $(tail -n 1 "$base.out")"
  else
    echo "ok   $name"
    [ -z "${SHOW:-}" ] || sed 's/^/       /' "$base.out"
  fi
  rm "$base.out" "$base.status"
  ((f > 0)) || rm -rf "$base.tmp"
}

next=0
report_finished() {
  while [[ -e $work/$next.status ]]; do
    report $next
    ((next += 1))
  done
}

for i in "${!names[@]}"; do
  while (($(jobs -rp | wc -l) >= JOBS)); do
    wait -n
    report_finished
  done
  run_one "$i" &
done
while [[ -n $(jobs -rp) ]]; do
  wait -n
  report_finished
done
report_finished

echo "$passed passed, $failed failed$( ((skipped == 0)) || echo ", $skipped skipped")"
((failed == 0 && passed > 0))

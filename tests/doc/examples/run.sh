#!/usr/bin/env bash
# The examples of the library print what their heads say (numbers to 1e-6, and 1e-12 where they are
# round-off), and the command of doc/library.md builds one.
set -euo pipefail
for source in "$ROOT"/examples/*.f90; do
  name=$(basename "$source" .f90)
  "$ROOT/build/$FLAVOUR/examples/$name" >"$TMP/$name.out"
  sed -n '/^!> Expected output:$/,/^program/s/^!>    //p' "$source" >"$TMP/$name.expected"
  [ -s "$TMP/$name.expected" ] || { echo "$name says nothing of its output"; exit 1; }
  "$PYTHON" - "$TMP/$name.expected" "$TMP/$name.out" <<'END'
import sys


def same(a, b):
    """Equal words, or numbers that differ in round-off alone."""
    try:
        return abs(float(a) - float(b)) <= max(1e-6 * abs(float(a)), 1e-12)
    except ValueError:
        return a == b


expected, found = ([line.split() for line in open(path)] for path in sys.argv[1:])
if len(expected) != len(found) or not all(
    len(a) == len(b) and all(map(same, a, b)) for a, b in zip(expected, found)
):
    sys.exit("expected:\n%s\nfound:\n%s" % tuple(open(path).read() for path in sys.argv[1:]))
END
done
[ "$FLAVOUR" = release ] || exit 0
cd "$ROOT"
compiler=$(cut -d' ' -f1 build/release/flags)    # module files are its own
command=$(sed -n 's/^    gfortran \(.*\) -o cone_small$/\1/p' doc/library.md)
# shellcheck disable=SC2086
$compiler $command -o "$TMP/cone_small" -J "$TMP"
"$TMP/cone_small" | cmp - "$TMP/cone_small.out"

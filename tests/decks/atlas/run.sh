#!/usr/bin/env bash
# An axis of the stability atlas at finite deformation, in its short form: exit code 1 if a cell is
# silent or breaks a promise; THETA within its bound on the bar whose strains are known. Then
# another axis alone: the cells of the first come from the page that is there.
set -eu
atlas() {
  "$PYTHON" "$ROOT/bench/stability.py" --quick --only "$1" --jobs 1 --store "$TMP/kept" --out "$TMP/page"
}
atlas "finite bar, aspect"
[ "$(grep -c '^"finite bar, aspect ratio",.*,THETA,.*,within,' "$TMP/page/cells.csv")" = 4 ]
grep '^"finite bar, aspect ratio"' "$TMP/page/cells.csv" >"$TMP/first"
atlas "finite rubber bars, density"
grep '^"finite bar, aspect ratio"' "$TMP/page/cells.csv" | cmp - "$TMP/first"
[ "$(grep -c '^"finite rubber bars, density' "$TMP/page/cells.csv")" = 20 ]

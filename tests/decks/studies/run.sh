#!/usr/bin/env bash
# The study of error against time runs from end to end in its short form: every run done, no growth
# of energy with THETA, exact where the method is (dispersion-tuned mass at Courant number 1).
set -eu
"$PYTHON" "$ROOT/bench/report.py" --quick --fresh --jobs 1 --store "$TMP/kept" --out "$TMP/report"
[ -s "$TMP/report/index.md" ] && [ -s "$TMP/report/aligned.png" ]
"$PYTHON" - "$TMP/report/runs.csv" <<'END'
import csv
import sys

with open(sys.argv[1]) as file:
    rows = list(csv.DictReader(file))
theta = [r for r in rows if r["scheme"] == "THETA"]
exact = [
    r
    for r in theta
    if (r["scene"], r["mass"], r["redist"], r["courant"]) == ("aligned", "DISPERSION", "0", "1")
]
tests = [
    ("THETA runs that failed", not [r for r in theta if r["failed"]]),
    ("THETA runs whose energy grew", not [r for r in theta if r["growth"] == "True"]),
    ("exact runs", len(exact) == 2 and all(float(r["err"]) < 1e-9 for r in exact)),
    ("combinations", len({(r["scheme"], r["theta"], r["mass"], r["redist"]) for r in rows}) == 14),
]
for words, ok in tests:
    if not ok:
        print("FAIL", words)
print("%d passed, %d failed" % (sum(ok for _, ok in tests), sum(not ok for _, ok in tests)))
sys.exit(not all(ok for _, ok in tests))
END

#!/usr/bin/env bash
# The walk-throughs of doc/developer.md, done with their own text: the new linear solver and the new
# time scheme are built, pass the tests that the page names, and give the tables of LDLT and of THETA at 1.
"$PYTHON" "$ROOT/tests/doc/walkthrough/walkthrough.py"

#!/usr/bin/env bash
# The walk-throughs of doc/developer.md, done with their own text: the new linear solver, the new time
# scheme and the new element are built, pass the tests that the page names; the first two give the
# tables of LDLT and of THETA at 1.
"$PYTHON" "$ROOT/tests/doc/walkthrough/walkthrough.py"

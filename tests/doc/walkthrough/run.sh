#!/usr/bin/env bash
# The walk-through of doc/developer.md, done with its own text: the new linear solver is built, passes
# the unit test and the style check, and solves a deck as LDLT does.
"$PYTHON" "$ROOT/tests/doc/walkthrough/walkthrough.py"

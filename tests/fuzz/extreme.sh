#!/usr/bin/env bash
# 48 extreme scenes at finite deformation, three of each family; any number: EXTREME=2000 tests/run.sh
# fuzz/extreme, or the command in the script's head.
exec "$PYTHON" "$ROOT/tests/fuzz/extreme_finite.py" --count "${EXTREME:-48}"

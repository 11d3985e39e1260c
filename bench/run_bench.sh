#!/usr/bin/env bash
# Accuracy, processor time, memory and the split of a step for the two-bar impact; cost of
# a step from 404 to 2e5 unknowns; speed of the reader; fields and restarts: make bench
set -euo pipefail
cd "$(dirname "$0")/.."
.venv/bin/python bench/two_bars.py "$@"
echo
.venv/bin/python bench/steps.py
echo
.venv/bin/python bench/reading.py
echo
.venv/bin/python bench/storage.py

#!/usr/bin/env bash
# Accuracy, processor time, memory and the split of a step for the two-bar impact; speed of the
# reader: make bench
set -euo pipefail
cd "$(dirname "$0")/.."
.venv/bin/python bench/two_bars.py "$@"
echo
.venv/bin/python bench/reading.py

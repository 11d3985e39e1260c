#!/usr/bin/env bash
# Accuracy, processor time, memory and the split of a step for the two-bar impact: make bench
set -euo pipefail
cd "$(dirname "$0")/.."
exec .venv/bin/python bench/two_bars.py "$@"

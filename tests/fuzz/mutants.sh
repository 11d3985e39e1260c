#!/usr/bin/env bash
# 3500 damaged decks; the slower flavours take 5 000. Any number: make fuzz N=...
count=3500
[ "$FLAVOUR" = release ] || count=5000
exec "$PYTHON" "$ROOT/tests/fuzz/fuzz.py" --count "${FUZZ:-$count}"

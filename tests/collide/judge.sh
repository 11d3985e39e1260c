#!/usr/bin/env bash
# The judge of the random collisions, and the scenes themselves, on cases made by hand.
exec "$PYTHON" "$ROOT/tests/collide/judge.py"

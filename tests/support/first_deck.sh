#!/bin/sh
# Prints the first deck of README.md.
sed -n '/^    \*KEYWORD/,/^    \*END/s/^    //p' "$ROOT/README.md"

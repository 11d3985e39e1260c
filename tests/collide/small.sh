#!/usr/bin/env bash
# A dozen random collisions, and half as many with rigid parts, with mortars and at finite deformation;
# a dozen of those in space. Any number:
# make collide N=... The last line sums up.
count=${COLLIDE:-12}
for kind in "$count" "$((count / 2)) --rigid" "$((count / 2)) --mortar" \
  "$((count / 2)) --soft"; do
  # shellcheck disable=SC2086 # two words
  "$PYTHON" "$ROOT/scripts/collide.py" $kind --jobs 1 --out "$TMP/collide" ||
    echo "failed: collide.py $kind"
done | tee "$TMP/collide.out"
# In step 60 of this scene no turn of a rigid part repeats itself: the run goes on.
"$PYTHON" "$ROOT/scripts/collide.py" --rigid --only 167 --no-symmetry --out "$TMP/collide" > "$TMP/one"
grep -q '"code": 0,' "$TMP/one" || echo "failed: scene 167 stops" | tee -a "$TMP/collide.out"
"$PYTHON" "$ROOT/scripts/collide_space.py" "$count" --soft --jobs 1 || echo "failed: soft, in space" |
  tee -a "$TMP/collide.out"
awk '/ passed, /{p += $1; f += $3} /^failed: /{n++} END{
  print p " passed, " f " failed"; exit f > 0 || n > 0}' "$TMP/collide.out"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pages of `dalembert report` run as `simulate` does, also with what they copy as command line. They are the same bytes each time, load
# nothing, and show the text of a model as text.
# Needs node, the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/; all of them if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
command -v node >/dev/null || failed "node is missing (on Debian: apt-get install nodejs)"
tests=$SOURCE/tests/javascript
"$PROGRAM" report "$tests/hostile.toml" -o "$here" >/dev/null 2>&1 || failed "hostile.toml"
node "$tests/hostile.mjs" "$here/hostile.html"
"$PROGRAM" report "$tests/hostile.toml" "$tests/network.toml" -o "$here/several" >/dev/null 2>&1 || failed "several models"
node "$tests/hostile.mjs" "$here/several/index.html"
[ "$(grep -c '<article>' "$here/several/index.html")" = 2 ] || failed "the list of pages"
cmp "$here/hostile.html" "$here/several/hostile.html" || failed "a page of several is not that of one"
"$PROGRAM" report "$tests/network.toml" -o "$here" >/dev/null || failed "network.toml"
node "$tests/network.mjs" "$here/network.html"
bad=()
mapfile -t models < <(machines_and_parts "$@")
[ $# -gt 0 ] || models+=("$SOURCE"/tests/regressions/{flat_parallelogram,moving_supply}.toml)
for path in "${models[@]}"; do
  [ -f "$path" ] || failed "there is no model $path"
  page=$here/$(sed -n 's/^name *= *"\(.*\)"/\1/p' "$path" | head -1).html
  "$PROGRAM" report "$path" -o "$here" >"$here/told.txt" 2>/dev/null || failed "$path"
  ! grep 'does not run' "$here/told.txt" | sed "s|^|$(basename "$path" .toml):|" || true
  ! grep -qE '(src|href)="[^#]|url\(|@import|fetch\(|XMLHttpRequest' "$page" || failed "$page loads something"
  node "$tests/runs.mjs" "$PROGRAM" "$page" "$path" || bad+=("$(basename "$path")")
done
[ ${#bad[@]} -eq 0 ] || failed "${bad[*]}"
# Copied as command line, with all kinds of changes and with some; what the page refuses, the program refuses, too.
for line in cart_pendulum bouncing_ball 'bouncing_ball {"parameters":{"e":0.9}}' 'bouncing_ball {"parameters":{"h_0":5}}' kepler \
  'kepler {"parameters":{"e":0.5}}' 'projectile {"parameters":{"alpha":1}}' four_bar 'four_bar {"start":{"alpha":1.4}}' \
  'four_bar {"parameters":{"a":0.25}}' 'four_bar {"parameters":{"a":3},"refused":"constraint"}' heavy_top \
  'heavy_top {"scene":"attitude","parameters":{"J":0.0011}}' 'heavy_top {"scene":"attitude","start":{"e_0":0.8,"e_1":0.6}}' \
  "heavy_top {\"scene\":\"attitude\",\"start\":{\"e_0\":0.9},\"refused\":\"the quaternion 'e' has the norm 1.0\"}" \
  'free_body {"parameters":{"J_3":3.5},"refused":"has the principal moments 1, 2 and 3.5 kg*m^2; no"}' \
  'stick_slip {"parameters":{"mu_C":0.9},"refused":"coefficient"}' \
  'knots {"until":14}' 'knots {"parameters":{"m":2},"until":14}' 'formulas {"parameters":{"T":1.3}}' 'formulas {"until":9}' 'formulas {"parameters":{"d":0.003,"l":0.6}}' \
  'formulas {"start":{"x":2},"held":{"w":0.3}}' 'formulas {"parameters":{"l":2},"refused":"range"}' \
  "formulas {\"parameters\":{\"m_1\":4},\"refused\":\"the mass of body 'block' is -1 kg at the start, but must not be below zero\"}"; do
  read -r model changes <<<"$line"
  path=$(find "$SOURCE/systems" "$tests" -name "$model.toml" -print -quit)
  [ -f "$here/$model.html" ] || "$PROGRAM" report "$path" -o "$here" >/dev/null 2>&1 || failed "$path"
  node "$tests/command.mjs" "$PROGRAM" "$here/$model.html" "$path" ${changes:+"$changes"} || failed "copied as command line: $line"
done
node "$tests/settings.mjs" "$here/formulas.html" "$here/four_bar.html"
mkdir "$here/again"
"$PROGRAM" report "${models[0]}" -o "$here/again" >/dev/null 2>&1
cmp "$here/$(basename "${models[0]}" .toml).html" "$here/again/$(basename "${models[0]}" .toml).html" || failed "other bytes"
echo "${#models[@]} pages run as simulate does"

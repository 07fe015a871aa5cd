#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pages of `dalembert report` run as `simulate` does, also with what they copy as command line. They are the same bytes each time, load
# nothing, and show the text of a model as text.
# Needs node, the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/; all of them if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
command -v node >/dev/null || failed "node is missing (on Debian: apt-get install nodejs)"
tests=$SOURCE/tests/javascript
"$PROGRAM" report "$tests/hostile.toml" -o "$here" >/dev/null 2>&1 || failed "hostile.toml"
node "$tests/hostile.mjs" "$here/hostile.html"
models=()
bad=()
for model in "$@"; do models+=("$SOURCE"/systems/*/"$model".toml); done
[ $# -gt 0 ] || mapfile -t models < <(find "$SOURCE/systems" -name '*.toml' -not -path '*/book/*' | sort)
for path in "${models[@]}"; do
  [ -f "$path" ] || failed "there is no model $path"
  page=$here/$(basename "$path" .toml).html
  "$PROGRAM" report "$path" -o "$here" >"$here/told.txt" 2>/dev/null || failed "$path"
  ! grep 'does not run' "$here/told.txt" | sed "s|^|$(basename "$path" .toml):|" || true
  ! grep -qE '(src|href)="[^#]|url\(|@import|fetch\(|XMLHttpRequest' "$page" || failed "$page loads something"
  node "$tests/runs.mjs" "$PROGRAM" "$page" "$path" || bad+=("$(basename "$path")")
done
[ ${#bad[@]} -eq 0 ] || failed "${bad[*]}"
node "$tests/command.mjs" "$PROGRAM" "$here/$(basename "${models[0]}" .toml).html" "${models[0]}" || failed "copied as command line"
mkdir "$here/again"
"$PROGRAM" report "${models[0]}" -o "$here/again" >/dev/null 2>&1
cmp "$here/$(basename "${models[0]}" .toml).html" "$here/again/$(basename "${models[0]}" .toml).html" || failed "other bytes"
echo "${#models[@]} pages run as simulate does"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The table of what effects cost (systems/README.md): states and operations, which do not depend on the machine.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
count=0
while IFS='|' read -r _ scene states operations _; do
  scene=$(grep -o '`[^`]*`' <<<"$scene" | tr -d '`')
  "$PROGRAM" generate "$SOURCE/systems/hydraulics/hydraulic_cylinder.toml" --scene "$scene" -o "$here" >"$here/generated.txt"
  header=$(grep -o '^[^ ]*\.hpp' "$here/generated.txt")
  grep -q ", $(tr -d ' ' <<<"$operations") operations" "$here/generated.txt" || { echo "the page says $operations of scene $scene:"; cat "$here/generated.txt"; exit 1; }
  grep -q "state_count = $(tr -d ' ' <<<"$states");" "$header" || { echo "the page says $states states of scene $scene"; exit 1; }
  count=$((count + 1))
done < <(awk '/^## Only the effects/ { inside = 1; next } /^## / { inside = 0 } inside && /^\| `/' "$SOURCE/systems/README.md")
[ "$count" -ge 5 ] || { echo "systems/README.md has no table of effects"; exit 1; }

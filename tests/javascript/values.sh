#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Modules of JavaScript compute what compiled plants do. Needs node, the program (PROGRAM) and the sources (SOURCE). Arguments: names of
# models of systems/; all of them if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
command -v node >/dev/null || failed "node is missing (on Debian: apt-get install nodejs)"
"${CC:-gcc}" -std=gnu11 -O1 -Wall -Wextra -Werror -I "$SOURCE/runtime" "$SOURCE/tests/javascript/values.c" -o "$here/values" -lm -ldl
mapfile -t models < <(machines_and_parts "$@")
count=0
for path in "${models[@]}"; do
  [ -f "$path" ] || failed "there is no model $path"
  rm -rf "$here/js" "$here/so"
  "$PROGRAM" generate "$path" --every-scene --language javascript -o "$here/js" >/dev/null
  for module in "$here"/js/*.js; do
    scene=$(sed -n 's/^        scene: "\(.*\)",$/\1/p' "$module")
    "$PROGRAM" compile "$path" --scene "$scene" -o "$here/so" >/dev/null 2>&1 || continue # nothing moves
    "$here/values" "$here/so/$(basename "$module" .js).so" >"$here/values.txt" || failed "$module"
    node "$SOURCE/tests/javascript/values.mjs" "$module" "$here/values.txt" || failed "$(basename "$module")"
    count=$((count + 1))
  done
done
[ "$count" -gt 0 ] || failed "nothing was compared"
echo "$count modules compute what plants do"

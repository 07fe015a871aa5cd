#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pages of `dalembert report` in a browser, wide and narrow, light and dark: every scene runs and moves, nothing is outside of the window,
# nothing is written to the console, nothing is loaded. Needs node, chromium, the program (PROGRAM) and the sources (SOURCE). Arguments:
# names of models of systems/. SHOTS: a folder for pictures. AXE: axe.min.js of axe-core, which finds what is hard to use without eyes or a
# pointer.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
pages=()
for model in "$@"; do
  "$PROGRAM" report "$(machines "$model")" -o "$here" >/dev/null 2>&1
  pages+=("$here/$model.html")
done
node "$SOURCE/tests/javascript/browser.mjs" "${pages[@]}"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `dalembert watch`. Needs node, the program (PROGRAM) and the sources (SOURCE).
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
command -v node >/dev/null || { echo "FAILED: node is missing (on Debian: apt-get install nodejs)"; exit 1; }
node "$SOURCE/tests/javascript/watch.mjs" "$PROGRAM" "$SOURCE/systems/mechanics/pendulum.toml"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Energy minus supplied and dissipated work over 100 periods at tolerance 1e-12, every scene of every system: below 1e-9.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
"$PROGRAM" survey "$SOURCE"/systems/*/*.toml --every-scene --periods 100 --tolerance 1e-12 --method fehlberg78 --samples 2000 --no-plot -o . --format json >result.json 2>log ||
  { cat log; exit 1; }
awk -F'[:,]' '
  /"model"/ { model = $2 }
  /"scene"/ { scene = $2 }
  /"status"/ { status = $2 }
  /"energy_error"/ {
    count++
    printf "%-24s %-14s %s %s\n", model, scene, status, $2
    if (status !~ /success|event/ || $2 !~ /[0-9]/ || $2 + 0 >= 1e-9) { bad++ }
  }
  END { if (count < 15 || bad > 0) { printf "%d of %d runs fail\n", bad, count; exit 1 } }
' result.json

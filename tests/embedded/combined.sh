#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What `generate --trig combined` and `--fix parameters` gain on the board: headers measured as all others, and what an angle costs, whatever its size.
# Needs the program (PROGRAM). 1: a gate failed, or a promise is not kept.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
require_tools
work=${BUILD:-build}/embedded/combined
headers=$work/headers
mkdir -p "$headers"

systems=$here/../../systems/mechanics
generate() {
  local model=$systems/$1.toml name=$2
  shift 2
  "$PROGRAM" generate "$model" "$@" --trig combined -o "$headers" --header "${name}_combined.hpp" >/dev/null
  "$PROGRAM" generate "$model" "$@" --fix parameters -o "$headers" --header "${name}_fixed.hpp" >/dev/null
  "$PROGRAM" generate "$model" "$@" --fix parameters --trig combined -o "$headers" --header "${name}_both.hpp" >/dev/null
}
generate cart_pendulum cart_pendulum_lab --scene lab
generate spherical_pendulum spherical_pendulum_forced --scene forced
generate n_pendulum n_pendulum_N3_full --size N=3
generate n_pendulum n_pendulum_N5_full --size N=5
BUILD=$work bash "$here/table.sh" "$headers"/*.hpp
awk '
  BEGIN { most["n_pendulum_N3_full"] = 240; most["n_pendulum_N5_full"] = 485 }
  $2 == "O2" && match($1, /_(combined|both)$/) {
    name = substr($1, 1, RSTART - 1)
    if (!(name in most)) next
    seen++
    if ($4 > most[name]) { print "FAILED: rhs of " $1 " takes " $4 " instructions at -O2, not at most " most[name]; failed = 1 }
  }
  END { if (seen != 4) { print "FAILED: 4 rows of chains are to be there, not " seen + 0; failed = 1 } exit failed }' "$work"/embedded/rows/*.txt

compile -O2 -I"$here/../../runtime" "$here/angles.cpp" "$board/startup.cpp" "${link[@]}" -o "$work/angles.elf"
run_board "$work/angles.elf" >"$work/angles.txt" || { echo "the board stopped: $(tail -1 "$work/angles.txt")" >&2; exit 1; }
echo
echo "sine and cosine of one angle, -O2: most instructions"
awk '
  BEGIN { printf "%-14s %10s %10s\n", "up to (rad)", "newlib", "combined" }
  { printf "%-14s %10d %10d\n", $1, $2, $3; rows++; if ($1 + 0 <= 500 && $3 > near) near = $3; if ($3 > most) most = $3 }
  END {
    if (rows != 5) { print "5 ranges are to be measured, not " rows; exit 1 }
    if (near > 80 || most > 300) { print "promised are at most 80 instructions up to 500 rad, and 300 beyond"; exit 1 }
  }' "$work/angles.txt"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSL-1.0
# Designs the controller on the desk, lets the board balance the rod, checks and plots what it did.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
source "$here/../tools.sh"
source "$here/../gates.sh"
require_tools
work=${BUILD:-build}/embedded/example
mkdir -p "$work"
model=$root/generated/mechanics

host() { ${CXX:-c++} -std=c++17 -O1 -Wall -Wextra -I"$root/runtime" -I"$model" -isystem /usr/include/eigen3 "$@" || exit 3; }
host "$here/design.cpp" -o "$work/design"
"$work/design" >"$work/gains.hpp"
head -1 "$work/gains.hpp"
compile -Os -I"$model" -I"$work" "$here/firmware.cpp" "$board/startup.cpp" "${link[@]}" -o "$work/balance.elf"
check_linked "the example" "$work/balance.elf"
arm-none-eabi-size "$work/balance.elf"
run_board "$work/balance.elf" >"$work/balance.txt" || { echo "the board stopped: $(tail -1 "$work/balance.txt")" >&2; exit 1; }
host "$here/check.cpp" -o "$work/check"
"$work/check" "$work/balance.txt" >"$work/balance.csv"
echo "$work/balance.csv"
if command -v gnuplot >/dev/null; then
  gnuplot -e "csv='$work/balance.csv'; svg='$work/balance.svg'" "$here/plot.gp"
  echo "$work/balance.svg"
fi

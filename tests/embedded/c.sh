#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What C headers take on the board beside C++ headers: instructions of rates and Jacobian, and bytes, at most 1.05 times as many at -Os and -O2.
# Up to 16 bytes more do not count: so much the compiler's choice of registers changes in the same operations.
# Needs the program (PROGRAM). Arguments: C++ headers, by default those of all mechanical systems. 1: a gate failed, or one takes more.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
require_tools
root=$(cd "$here/../.." && pwd)
work=$(realpath -m "${BUILD:-build}")/embedded/c
rm -rf "$work"
mkdir -p "$work/headers" "$work/rows"

headers=("$@")
[ ${#headers[@]} -gt 0 ] || headers=("$root"/generated/mechanics/*.hpp)
one() {
  local header=$1 name command
  name=$(basename "$header" .hpp)
  # The command that the banner shows makes the other language, too.
  command=$(sed -n 's|^//     dalembert generate ||p' "$header" | head -1)
  eval "set -- $command"
  local model
  model=$(find "$here/../../systems" -name "$1" | head -1)
  shift
  "$PROGRAM" generate "$model" "$@" --language c -o "$work/headers" >/dev/null
  BUILD=$work/cpp bash "$here/measure.sh" "$header" Os O2 >"$work/rows/$name.cpp" && BUILD=$work/c C_HEADER=$work/headers/$name.h bash "$here/measure.sh" "$header" Os O2 >"$work/rows/$name.c" ||
    echo "$name" >>"$work/failed"
}
export -f one
export here work PROGRAM
printf '%s\n' "${headers[@]}" | xargs -P "${JOBS:-$(nproc)}" -I{} bash -c 'one "$1"' _ {}

awk '
  BEGIN { printf "%-32s %-4s %23s %23s %17s %17s %13s\n", "instructions and bytes, C / C++", "", "rhs", "with Jacobian", "bytes", "bytes (Jacobian)", "worst ratio" }
  { key = $1 " " $2 }
  FILENAME ~ /[.]cpp$/ { for (i = 4; i <= 9; i++) cpp[key, i] = $i; next }
  {
    worst = 0
    for (i = 4; i <= 9; i++) if (i != 6 && i != 7 && cpp[key, i] > 0 && (i < 6 || $i > cpp[key, i] + 16) && $i / cpp[key, i] > worst) worst = $i / cpp[key, i]
    printf "%-32s -%-3s %11.0f %11.0f %11.0f %11.0f %8d %8d %8d %8d %13.3f\n", $1, $2, $4, cpp[key, 4], $5, cpp[key, 5], $8, cpp[key, 8], $9, cpp[key, 9], worst
    rows++
    if (worst > 1.05) { over++; names = names " " $1 "(-" $2 ")" }
    sum += $5 / cpp[key, 5]
  }
  END {
    if (rows == 0) { print "nothing was measured"; exit 1 }
    printf "%d rows; instructions of rates and Jacobian are %.3f times those of C++ in the mean; above 1.05: %d%s\n", rows, sum / rows, over + 0, names
    exit over > 0
  }' "$work"/rows/*.cpp "$work"/rows/*.c || failed=1
[ ! -f "$work/failed" ] || { echo "Failed, see above:"; cat "$work/failed"; exit 1; }
exit ${failed:-0}

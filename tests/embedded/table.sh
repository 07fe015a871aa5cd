#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# table.sh [HEADER...]: measures generated headers at -Os and -O2, by default those of all mechanical systems, and prints the table.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
require_tools
export BUILD=${BUILD:-build}
rows=$BUILD/embedded/rows
rm -rf "$rows"
mkdir -p "$rows"

headers=("$@")
[ ${#headers[@]} -gt 0 ] || headers=("$here"/../../generated/mechanics/*.hpp)

one() { bash "$here/measure.sh" "$1" Os O2 >"$rows/$(basename "$1" .hpp).txt" || echo "$1 $?" >>"$rows/failed"; }
export -f one
export here rows
printf '%s\n' "${headers[@]}" | xargs -P "${JOBS:-$(nproc)}" -I{} bash -c 'one "$1"' _ {}

awk '
  FILENAME ~ /goals.txt$/ { if ($1 !~ /^#/) for (i = 2; i <= 5; i++) goal[$1, i] = $i; next }
  BEGIN {
    print "rhs, and rhs with Jacobian: mean instructions (own: without functions of the C library), own bytes, stack in bytes with the library; errors of rates and Jacobian\n"
    printf "%-32s %-4s %3s %17s %17s %13s %6s %11s   %-23s %s\n", "system", "", "dof", "rhs (own)", "Jacobian (own)", "bytes", "set-up", "stack", "errors, limit", "goals: rhs; with Jacobian"
  }
  function beside(value, i) { return sprintf("%s%s", goal[$1, i], value > goal[$1, i] ? " missed" : " met") }
  {
    printf "%-32s -%-3s %3d %8.0f (%6.0f) %8.0f (%6.0f) %6d %6d %6d %5d %5d   %-7s %-7s %-7s", $1, $2, $3, $4, $6, $5, $7, $8, $9, $10, $11, $12, $13, $15, $14
    if ($2 == "Os" && ($1, 2) in goal)
      printf "instructions %s, bytes %s; instructions %s, bytes %s", beside($4, 2), beside($8, 3), beside($5, 4), beside($9, 5)
    print ""
  }' "$here/goals.txt" "$rows"/*.txt

if [ -f "$rows/failed" ]; then
  printf '\nFailed, see above:\n'
  cat "$rows/failed"
  awk '$2 > worst { worst = $2 } END { exit worst }' "$rows/failed"
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs one regression, tests/regressions/NAME.sh: a model that once gave a wrong answer, and the answer that is expected.
# A regression is a script in terms of what stands below; its model lies beside it as NAME.toml. It works in an empty folder.
# With "# tier: full" in its second line it is of the full tier.
set -uo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
name=$1
model=$folder/$name.toml
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# dalembert CODE ARGUMENT...: runs the program; what it prints is in the file `printed`. Another exit code than CODE fails.
dalembert() {
  local code=$1 got=0
  shift
  echo "> dalembert $*"
  timeout "${limit:-120}" "$PROGRAM" "$@" >printed 2>&1 || got=$?
  if [ "$got" -ne "$code" ]; then
    fail "exit code $got, expected $code"
    cat printed
  fi
}

# prints PATTERN: a line of what was printed last matches (grep -E).
prints() { grep -qE -e "$1" printed || { fail "not printed: $1"; cat printed; }; }

# prints_not PATTERN
prints_not() { ! grep -qE -e "$1" printed || { fail "printed, but should not be: $1"; cat printed; }; }

# last FILE COLUMN: the value in the last row of a CSV; COLUMN is its heading without the unit.
last() { column "$1" "$2" 1e300; }

# column FILE COLUMN T: the value in the last row whose time is at most T.
column() {
  awk -v wanted="$2" -v until="$3" '
    function cells(line, out,   n, i, c, inside, cell) {  # commas in quotes do not divide
      n = 0; inside = 0; cell = ""
      for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") inside = !inside
        else if (c == "," && !inside) { out[++n] = cell; cell = "" }
        else cell = cell c
      }
      out[++n] = cell
      return n
    }
    NR == 1 { n = cells($0, head); for (i = 1; i <= n; i++) { sub(/ \[.*/, "", head[i]); if (head[i] == wanted) at = i } next }
    at { cells($0, row); if (row[1] + 0 <= until + 0) value = row[at] }
    END { print at ? value : "no-column" }' "$1"
}

# near WHAT VALUE EXPECTED TOLERANCE: |VALUE - EXPECTED| <= TOLERANCE; what is no number fails.
near() {
  awk -v v="$2" -v e="$3" -v tolerance="$4" 'BEGIN { d = v - e; if (d < 0) d = -d; exit !(v ~ /^[-+0-9.]+(e[-+]?[0-9]+)?$/ && d <= tolerance) }' ||
    fail "$1 is '$2', expected $3 within $4"
}

# number PATTERN: the first number behind the first match of PATTERN in what was printed last.
number() { grep -oE -e "$1.*" printed | head -1 | sed -E "s#$1##" | grep -oE '[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?' | head -1; }

# shellcheck source=/dev/null
source "$folder/$name.sh"
[ "$failures" -eq 0 ] && echo "$name: as expected"
exit "$((failures > 0))"

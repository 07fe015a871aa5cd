#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs one regression, tests/regressions/NAME.sh: a model that once gave a wrong answer, and the answer that is expected.
# A regression is a script in the terms defined below; its model lies beside it as NAME.toml. It works in an empty folder.
# With a line "# tier: full" it is of the full tier. FOLDER/NAME runs a script of another folder of tests/.
set -uo pipefail
case $1 in */*) folder=$(dirname "$1") ;; *) folder=regressions ;; esac
folder=$(cd "$(dirname "$0")/../$folder" && pwd)
name=$(basename "$1")
model=$folder/$name.toml
[ -f "$folder/$name.sh" ] || { echo "there is no $folder/$name.sh" >&2; exit 2; }
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

# digits WHAT VALUE EXPECTED LEAST: tells the digits that agree, -log10 of the relative error (of the error itself below 1), and fails below LEAST.
digits() {
  awk -v what="$1" -v v="$2" -v e="$3" -v least="$4" 'BEGIN {
    d = v - e; if (d < 0) d = -d
    size = e < 0 ? -e : e; if (size > 1) d /= size
    n = v !~ /^[-+0-9.]+(e[-+]?[0-9]+)?$/ ? 0 : d == 0 ? 16 : -log(d)/log(10); if (n > 16) n = 16
    printf "| %s | %s | %s | %.1f |\n", what, v, e, n
    exit !(n >= least) }' || fail "$1 has less than $4 digits"
}

# number PATTERN: the first number behind the first match of PATTERN in what was printed last.
number() { grep -oE -e "$1.*" printed | head -1 | sed -E "s#$1##" | grep -oE '[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?' | head -1; }

# shellcheck source=/dev/null
source "$folder/$name.sh"
[ "$failures" -eq 0 ] && echo "$name: as expected"
exit "$((failures > 0))"

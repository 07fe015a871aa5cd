#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a lookup in a curve costs: instructions on the board at -O2, and ns on this machine in double, of a right-hand side with one lookup
# less one without. Needs the program (PROGRAM). 1: a gate failed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
require_tools
work=${BUILD:-build}/embedded/lookups
rm -rf "$work"
mkdir -p "$work/headers"

# model NAME RATE [KEYS OF THE CURVE]
model() {
  local curve=
  [ $# -lt 3 ] || curve=$(printf '[curves.f]\nunit = "1"\noutside = "held"\n%b' "$3")
  cat >"$work/$1.toml" <<END
[model]
format = 1
name   = "$1"

$curve

[states]
x = { unit = "1", start = 3.7, derivative = "($2)/(1 s)", range = [0, 10] }
y = { unit = "1", start = 4.1, derivative = "y/(7 s)", range = [0, 10] }
END
  "$PROGRAM" generate "$work/$1.toml" -o "$work/headers" --header "$1.hpp" >/dev/null
}

# places COUNT EVEN: from 0 to 10, farther from each other at the end where they are not even.
places() { awk -v n="$1" -v even="$2" 'BEGIN { for (i = 0; i < n; i++) { s = i/(n - 1); printf "%s%.4f", (i ? " " : ""), 10.08*s*(even ? 1 : (s + 3)/4) } }'; }
points() { awk -v x="$(places "$1" "$2")" 'BEGIN { n = split(x, at); for (i = 1; i <= n; i++) printf "%s[%s, %.3f]", (i > 1 ? ", " : ""), at[i], sin(at[i]) + at[i] }'; }
grid() {
  awk -v x="$(places "$1" "$2")" 'BEGIN {
    n = split(x, at)
    for (k = 1; k <= n; k++) first = first (k > 1 ? ", " : "") at[k]
    printf "[%s]", first
    for (i = 1; i <= n; i++) { printf ", [%s", at[i]; for (k = 1; k <= n; k++) printf ", %.3f", sin(at[i] + 0.3*at[k]) + at[i]*at[k]/5; printf "]" }
  }'
}

model lookup_none "2*x + y"
model lookup_sine "sin(x) + y"  # to compare with
for even in 1 0; do
  word=$([ $even = 1 ] && echo even || echo uneven)
  for count in 8 64; do
    model "lookup_${count}_$word" "f(x) + y" "of = \"x [1]\"\npoints = [$(points $count $even)]"
  done
  model "lookup_8x8_$word" "f(x, y) + y" "of = \"x [1], y [1]\"\ngrid = [$(grid 8 $even)]"
done
model lookup_8x8_uneven_linear "f(x, y) + y" "of = \"x [1], y [1]\"\nshape = \"linear\"\ngrid = [$(grid 8 0)]"

BUILD=$work bash "$here/table.sh" "$work"/headers/*.hpp >"$work/table.txt" || { cat "$work/table.txt"; exit 1; }

# ns NAME: the best of many short runs.
ns() {
  cat >"$work/time.cpp" <<END
#include <chrono>
#include <cstdio>
#include "$1.hpp"
using namespace $1::full;
int main() {
    const System<double> plant;
    System<double>::State x{}, rate{};
    double best = 1e9, sum = 0;
    for (int run = 0; run < 200; ++run) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 10000; ++i) {
            x[0] = (i * 7919 % 10000) * 1e-3 + rate[1] * 1e-30;  // each begins when the one before is done
            x[1] = (i * 104729 % 10000) * 1e-3;
            plant.rhs(x, {}, 0.0, rate);
            rate[1] += rate[0];
        }
        sum += rate[1];
        const double time = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / 10000;
        best = time < best ? time : best;
    }
    std::printf("%.2f %g\n", best, sum);
}
END
  ${CXX:-c++} -std=c++17 -O2 -I"$work/headers" -I"$here/../../runtime" -isystem /usr/include/eigen3 "$work/time.cpp" -o "$work/time"
  "$work/time" | cut -d' ' -f1
}
none=$(ns lookup_none)
printf '%-22s %14s %8s\n' "lookup" "instructions" "ns"
for row in "$work"/headers/*.hpp; do
  name=$(basename "$row" .hpp)
  [ "$name" = lookup_none ] && continue
  awk -v name="$name" -v time="$(ns "$name")" -v none="$none" '
    $2 == "O2" && $1 == "lookup_none" { base = $4 }
    $2 == "O2" && $1 == name { own = $4 }
    END { printf "%-22s %14.0f %8.1f\n", substr(name, 8), own - base, time - none }' "$work"/embedded/rows/*.txt
done

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How code for chains grows: operations, bytes of code, seconds to generate (and prove) and to compile; of SymPy's code what is there of it.
#     sizes.sh PROGRAM MODEL [SYMPY_HEADER]
set -euo pipefail
export LC_ALL=C
program=$1 model=$2 sympy=${3:-}
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
flags=(-std=c++20 -O2 -w -I"$source_dir/runtime" -I"$source_dir/tests" -I"$here")

seconds() { local begin=$EPOCHREALTIME; "$@" >/dev/null; awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }'; }
operations() { awk -v f="$2" '$1 == "//" && $2 == f { print $3 + $4 + $5 + $6 + $7; exit }' "$1"; }

# measure INCLUDE TYPE JACOBIAN: bytes of rhs, bytes with Jacobian, seconds to compile the latter
measure() {
  printf '%s\nusing S = %s;\nvoid rhs(const S& s, const S::State& x, S::State& f) { s.rhs(x, {}, 0.0, f); }\n' "$1" "$2" >"$here/rhs.cpp"
  printf '%s\nusing S = %s;\nvoid both(const S& s, const S::State& x, S::State& f, %s& J) { s.rhs_and_jacobian(x, {}, 0.0, f, J); }\n' "$1" "$2" "$3" >"$here/both.cpp"
  g++ "${flags[@]}" -c "$here/rhs.cpp" -o "$here/rhs.o"
  local time
  time=$(seconds g++ "${flags[@]}" -c "$here/both.cpp" -o "$here/both.o")
  echo "$(size "$here/rhs.o" | awk 'NR == 2 { print $1 }') $(size "$here/both.o" | awk 'NR == 2 { print $1 }') $time"
}

printf '\nchains: operations, bytes of code (-O2), seconds\n\n%5s %16s %18s %16s   %18s %10s\n' '' 'operations' 'bytes' 'seconds to' "SymPy's: bytes" 'seconds'
printf '%5s %7s %8s %9s %8s %8s %8s   %8s %9s %10s\n' N rhs Jacobian rhs Jacobian generate compile rhs Jacobian compile
for n in 1 2 3 5 8 12 20 30; do
  time=$(seconds "$program" generate "$model" --size N="$n" -o "$here")
  header=$here/n_pendulum_N${n}_full.hpp
  read -r rhs both compile < <(measure "#include \"$header\"" "n_pendulum_N$n::full::System<double>" S::JacobianX)
  their=(- - -)
  if [ -n "$sympy" ] && grep -q "class Chain<$n>" "$sympy"; then
    # one class alone
    awk -v n="$n" '/^template <>/ { held = $0; next } held != "" { inside = $0 == "class Chain<" n "> {"; skipping = !inside; if (inside) print held; held = "" } /^}  \/\/ namespace/ { skipping = 0 } !skipping { print }' "$sympy" >"$here/one.hpp"
    read -ra their < <(measure "#include \"$here/one.hpp\"" "by_sympy::Chain<$n>" S::Jacobian)
  fi
  printf '%5s %7s %8s %9s %8s %8s %8s   %8s %9s %10s\n' "$n" "$(operations "$header" rhs)" "$(operations "$header" rhs_and_jacobian)" "$rhs" "$both" "$time" "$compile" "${their[@]}"
done

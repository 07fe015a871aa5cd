#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What each pass of the generator gains: operations and time without it, over those with all, of rhs and of rhs with Jacobian.
#     passes.sh PROGRAM
set -euo pipefail
export LC_ALL=C
program=$1
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
passes=(rewriting chain constants factoring angles)

operations() { awk -v f="$2" '$1 == "//" && $2 == f { print $3 + $4 + $5 + $6 + $7; exit }' "$here/$1.hpp"; }

# build NAME MODEL OPTION...: header and program of that name
build() {
  local name=$1 model=$2 name_space
  shift 2
  "$program" generate "$source_dir/systems/$model.toml" "$@" -o "$here" --header "$name.hpp" >/dev/null
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$here/$name.hpp" | head -1)
  sed "s|@HEADER@|$here/$name.hpp|; s|@NAME_SPACE@|$name_space|" "$source_dir/tests/benchmarks/passes.cpp.in" >"$here/$name.cpp"
  ${CXX:-c++} -std=c++17 -O3 -march=native -w -I"$source_dir/tests" "$here/$name.cpp" -o "$here/$name"
}

# row NAME MODEL OPTION...: a line for each pass that changes the header
row() {
  local name=$1 pass round built=()
  shift
  build all "$@"
  for pass in "${passes[@]}"; do
    build "$pass" "$@" --without "$pass"
    cmp -s <(grep -v '^//' "$here/$pass.hpp") <(grep -v '^//' "$here/all.hpp") || built+=("$pass")
  done
  rm -f "$here"/*.times
  for round in 1 2 3 4 5 6 7; do  # in turns
    for pass in all "${built[@]}"; do "$here/$pass" >>"$here/$pass.times"; done
  done
  for pass in "${built[@]}"; do
    awk -v name="$name" -v pass="$pass" -v o="$(operations all rhs) $(operations "$pass" rhs) $(operations all rhs_and_jacobian) $(operations "$pass" rhs_and_jacobian)" '
      function least(i) { if (!((FILENAME, i) in best) || $i < best[FILENAME, i]) best[FILENAME, i] = $i }
      { least(1); least(2); if (FNR == 1) file[++files] = FILENAME }
      END {
        split(o, n, " ")
        printf "%-30s %-10s %5d %5d %6.2f   %5d %5d %6.2f\n", name, pass, n[1], n[2], best[file[2], 1] / best[file[1], 1], n[3], n[4], best[file[2], 2] / best[file[1], 2]
      }' "$here/all.times" "$here/$pass.times"
  done
}

printf 'operations with all passes and without one, and time without it over time with all\n%-30s %-10s %18s   %18s\n' system without rhs 'with Jacobian'
row 'cart_pendulum, lab' mechanics/cart_pendulum --scene lab
row 'spherical_pendulum, forced' mechanics/spherical_pendulum --scene forced
row 'n_pendulum, N = 3' mechanics/n_pendulum --size N=3
row 'n_pendulum, N = 5' mechanics/n_pendulum --size N=5
row 'n_pendulum, N = 12' mechanics/n_pendulum --size N=12
row 'arm_6r, plain' mechanics/arm_6r --scene plain
row 'hydraulic_cylinder, real' hydraulics/hydraulic_cylinder --scene real
row 'pneumatic_cylinder, thermal' pneumatics/pneumatic_cylinder --scene thermal

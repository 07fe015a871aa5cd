#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What each pass of the generator gains: operations and time without it, over those with all, of rhs and of rhs with Jacobian. Beside them
# `implicit`, what Jacobians cost that are made by differentiating the generated rhs with Eigen's dual numbers, and `together`, what calls one after
# the other cost beside one call of `together`.
#     passes.sh PROGRAM
set -euo pipefail
export LC_ALL=C
program=$1
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
march=-march=$([ "$(uname -m)" = x86_64 ] && echo x86-64-v3 || echo native)
IFS=, read -ra passes <<<"$("$program" generate --help | sed -n 's/.*--without TEXT:{\(.*\)}.*/\1/p')"

operations() { awk -v f="$2" '$1 == "//" && $2 == f { print $3 + $4 + $5 + $6 + $7; exit }' "$here/$1.hpp"; }

# build NAME MODEL OPTION...: header and program of that name
build() {
  local name=$1 model=$2 name_space
  shift 2
  "$program" generate "$source_dir/systems/$model.toml" "$@" -o "$here" --header "$name.hpp" >/dev/null
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$here/$name.hpp" | head -1)
  local define=()
  [ "$name" = implicit ] && define=(-DDUALS $(pkg-config --cflags eigen3))
  [ "$name" = together ] && define=(-DTOGETHER)
  sed "s|@HEADER@|$here/$name.hpp|; s|@NAME_SPACE@|$name_space|" "$source_dir/tests/benchmarks/passes.cpp.in" >"$here/$name.cpp"
  ${CXX:-c++} -std=c++17 -O3 $march -w "${define[@]}" -I"$source_dir/tests" "$here/$name.cpp" -o "$here/$name"
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
  case "$1" in mechanics/*) build implicit "$@"; built+=(implicit) ;; esac  # where there is an M to solve with
  build together "$@" --together
  rm -f "$here"/*.times
  for round in 1 2 3 4 5 6 7; do  # in turns
    for pass in all "${built[@]}" together; do "$here/$pass" >>"$here/$pass.times"; done
  done
  for pass in "${built[@]}"; do
    awk -v name="$name" -v pass="$pass" -v o="$(operations all rhs) $(operations "$pass" rhs) $(operations all rhs_and_jacobian) $(operations "$pass" rhs_and_jacobian)" '
      function least(i) { if (!((FILENAME, i) in best) || $i < best[FILENAME, i]) best[FILENAME, i] = $i }
      { least(1); least(2); if (FNR == 1) file[++files] = FILENAME }
      END {
        split(o, n, " ")
        if (pass == "implicit") printf "%-30s %-12s %18s   %18.2f\n", name, pass, "", best[file[2], 2] / best[file[1], 2]
        else printf "%-30s %-12s %5d %5d %6.2f   %5d %5d %6.2f\n", name, pass, n[1], n[2], best[file[2], 1] / best[file[1], 1], n[3], n[4], best[file[2], 2] / best[file[1], 2]
      }' "$here/all.times" "$here/$pass.times"
  done
  local apart=0 f
  for f in rhs_and_jacobian output kinetic_energy potential_energy internal_energy; do apart=$((apart + $(operations together $f || echo 0) + 0)); done
  awk -v name="$name" -v o="$(operations together together) $apart" '
    { if (NR == 1 || $1 < once) once = $1; if (NR == 1 || $2 < apart) apart = $2 }
    END { split(o, n, " "); printf "%-30s %-12s %18s   %5d %5d %6.2f\n", name, "together", "", n[1], n[2], apart / once }' "$here/together.times"
}

printf 'operations with all passes and without one, and time without it over time with all\n%-30s %-12s %18s   %18s\n' system without rhs 'with Jacobian'
row 'cart_pendulum, lab' mechanics/cart_pendulum --scene lab
row 'spherical_pendulum, forced' mechanics/spherical_pendulum --scene forced
row 'n_pendulum, N = 3' mechanics/n_pendulum --size N=3
row 'n_pendulum, N = 5' mechanics/n_pendulum --size N=5
row 'n_pendulum, N = 12' mechanics/n_pendulum --size N=12
row 'n_pendulum, N = 12, with M' mechanics/n_pendulum --size N=12 --without chain
row 'arm_6r, plain' mechanics/arm_6r --scene plain
row 'hydraulic_cylinder, real' hydraulics/hydraulic_cylinder --scene real
row 'pneumatic_cylinder, thermal' pneumatics/pneumatic_cylinder --scene thermal

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers of the same machine, generated with different options, compute the same: rates, Jacobian and outputs at 20 points.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cat >"$here/print.cpp" <<'CODE'
#include <cmath>
#include <cstdio>

#include HEADER

using S = NAME_SPACE::System<NUMBER>;

template <class Values>
void print(const char* what, int point, const Values& values) {
    for (std::size_t i = 0; i < values.size(); ++i) std::printf("%s.%d %.17g\n", what, point, static_cast<double>(values[i]));
}

int main() {
    const S system;
    for (int k = 0; k < 20; ++k) {
        auto x = system.start_state();
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += (std::abs(x[i]) > 10 ? x[i] : NUMBER(1)) * NUMBER(0.1 * std::sin(1.0 + k + 7.0 * static_cast<double>(i)));
        typename S::Input u{};
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = NUMBER(0.3 * std::cos(2.0 + k + static_cast<double>(i)));
        typename S::State f{};
        typename S::JacobianX J{};
        typename S::Output y{};
        system.rhs_and_jacobian(x, u, NUMBER(0.2), f, J);
        system.output(x, u, NUMBER(0.2), y);
        print("rates", k, f);
        print("jacobian", k, J);
        print("outputs", k, y);
    }
}
CODE

# values MODEL NUMBER OPTION...: prints what the header gives.
values() {
  local model=$SOURCE/systems/$1.toml number=$2 name_space
  shift 2
  "$PROGRAM" generate "$model" "$@" -o "$here" --header one.hpp >/dev/null
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$here/one.hpp" | head -1)
  ${CXX:-c++} -std=c++17 -O1 -Wall -Wextra -Wconversion -Wno-overflow -DHEADER="\"$here/one.hpp\"" -DNAME_SPACE="$name_space" -DNUMBER="$number" "$here/print.cpp" -o "$here/print" || exit 1
  "$here/print"
}

# same MODEL LIMIT NUMBER COMMON -- OPTION...: the largest difference, relative to the largest entry of its vector, is below LIMIT.
same() {
  local model=$1 limit=$2 number=$3 common=() difference
  shift 3
  while [ "$1" != -- ]; do common+=("$1"); shift; done
  shift
  values "$model" double "${common[@]}" >"$here/expected.txt"
  cp "$here/one.hpp" "$here/plain.hpp"
  values "$model" "$number" "${common[@]}" "$@" >"$here/got.txt"
  cmp -s "$here/one.hpp" "$here/plain.hpp" && { echo "FAILED: $model: $* changes nothing"; exit 1; }
  difference=$(paste "$here/expected.txt" "$here/got.txt" | awk '
    function size(v) { return v < 0 ? -v : v }
    $1 != $3 { print "nothing to compare"; exit }
    $4 != $4 + 0 && $2 != $2 + 0 { next }
    { d = size($2 - $4); if (!(d <= off[$1])) off[$1] = d; if (size($2) > largest[$1]) largest[$1] = size($2) }
    END { for (v in off) if (off[v] > worst * largest[v]) worst = off[v] / largest[v]; print worst + 0 }')
  echo "$model $*: $difference"
  awk -v d="$difference" -v limit="$limit" 'BEGIN { exit !(d + 0 == d && d <= limit) }' || { echo "FAILED: $model $*: off by $difference, not within $limit"; exit 1; }
}

for model in mechanics/cart_pendulum mechanics/slider_crank mechanics/four_bar hydraulics/valve_cylinder hydraulics/torricelli pneumatics/pneumatic_cylinder heat/fin; do
  same "$model" 1e-12 double -- --fix parameters
done
same mechanics/n_pendulum 1e-12 double --size N=6 -- --fix g
same mechanics/n_pendulum 1e-12 double --size N=6 -- --without chain
same mechanics/n_pendulum 1e-12 double --size N=12 -- --without constants
same mechanics/arm_6r 1e-12 double --scene plain -- --fix parameters
same mechanics/arm_6r 1e-12 double --scene plain -- --without chain
same mechanics/spherical_pendulum 1e-12 double -- --without rewriting
for pass in constants factoring angles; do
  same mechanics/cart_pendulum 1e-12 double -- --without $pass
  same mechanics/arm_6r 1e-12 double --scene plain -- --without $pass
done
for model in mechanics/four_bar mechanics/slider_crank hydraulics/hydraulic_cylinder pneumatics/pneumatic_cylinder heat/fin; do
  same $model 1e-12 double -- --without constants,factoring
done
same mechanics/spherical_pendulum 4e-6 float -- --trig combined
same mechanics/n_pendulum 4e-6 float --size N=5 -- --trig combined
same mechanics/arm_6r 4e-6 float --scene plain -- --trig combined --fix parameters

# A value of one's own, and what the header then has.
"$PROGRAM" generate "$SOURCE/systems/mechanics/cart_pendulum.toml" --fix 'g=9.81,l_S=600 mm,m_W' -o "$here" >/dev/null
header=$here/cart_pendulum_lab.hpp
for line in 'parameter_count = 6;' "^// Fixed: m_W = 1 kg, l_S = 0.6 m, g = 9.81 m/s^2$" "generate cart_pendulum.toml --scene lab --fix 'g=9.81,l_S=600 mm,m_W'$"; do
  grep -q "$line" "$header" || { echo "FAILED: the header has no '$line'"; exit 1; }
done
"$PROGRAM" generate "$SOURCE/systems/mechanics/cart_pendulum.toml" --fix parameters -o "$here" >/dev/null
! grep -q 'c_\.' "$header" || { echo "FAILED: what depends on fixed parameters alone is computed at run time"; exit 1; }

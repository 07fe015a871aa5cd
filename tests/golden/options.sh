#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers of the same machine, generated with different options, compute the same: rates, Jacobian, outputs and energies at 20 points, within 4 ulp beyond the
# condition. "full [MODEL.toml]": every machine of the repository with all passes and with none but `rewriting`, which keeps digits, and asked for all
# at once; and each option of machines that take longer.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cat >"$here/print.cpp" <<'CODE'
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "dalembert/matrices.hpp"
#include HEADER

#ifdef HAS_MODES
constexpr std::size_t modes = NAME_SPACE::mode_count;
#define IN(mode, ...) static_cast<NAME_SPACE::Mode>(mode), __VA_ARGS__
#else
constexpr std::size_t modes = 1;
#define IN(mode, ...) __VA_ARGS__
#endif

template <class Scalar>
using System = NAME_SPACE::System<Scalar>;
constexpr std::size_t states = NAME_SPACE::state_count, inputs = NAME_SPACE::input_count, parameters = NAME_SPACE::parameter_count;

template <class Scalar>
Scalar ulp(Scalar value) {
    return std::nextafter(std::abs(value), std::numeric_limits<Scalar>::infinity()) - std::abs(value);
}

/// Rates, Jacobian, outputs, energies, mass matrix and bias at [x; u; t; p].
template <class Scalar>
std::vector<Scalar> evaluated([[maybe_unused]] std::size_t mode, const std::vector<Scalar>& at) {
    typename System<Scalar>::State x{}, f{};
    typename System<Scalar>::Input u{};
    typename System<Scalar>::JacobianX J{};
    typename System<Scalar>::Output y{};
    NAME_SPACE::Parameters<Scalar> p;
    std::copy_n(at.begin(), states, x.begin());
    std::copy_n(at.begin() + states, inputs, u.begin());
    if (parameters > 0) std::memcpy(static_cast<void*>(&p), at.data() + states + inputs + 1, parameters * sizeof(Scalar));
    const System<Scalar> system(p);
    const Scalar t = at[states + inputs];
#ifdef HAS_TOGETHER
    typename System<Scalar>::Energies energies{};
    system.together(IN(mode, x, u, t, f, J, y, energies));
    const auto [kinetic, potential, internal] = energies;
#else
    system.rhs_and_jacobian(IN(mode, x, u, t, f, J));
    system.output(IN(mode, x, u, t, y));
    const Scalar kinetic = system.kinetic_energy(IN(mode, x, t)), potential = system.potential_energy(IN(mode, x, t)), internal = system.internal_energy(IN(mode, x, t));
#endif
    std::vector<Scalar> all(f.begin(), f.end());
    const auto dense = dalembert::detail::expanded<typename System<Scalar>::PatternX>(J, states, states);
    all.insert(all.end(), dense.data(), dense.data() + dense.size());
    all.insert(all.end(), y.begin(), y.end());
    all.insert(all.end(), {kinetic, potential, internal});
    if constexpr (NAME_SPACE::degrees_of_freedom > 0) {
        typename System<Scalar>::MassMatrix M{};
        typename System<Scalar>::Generalised b{};
        system.mass_matrix(IN(mode, x, t, M));
        system.bias(IN(mode, x, u, t, b));
        all.insert(all.end(), M.begin(), M.end());
        all.insert(all.end(), b.begin(), b.end());
    }
    return all;
}

template <class Scalar>
std::vector<Scalar> point(int k) {
    const NAME_SPACE::Parameters<Scalar> p{};
    std::vector<Scalar> at(states + inputs + 1 + parameters);
    const auto x = System<double>().start_state();
    for (std::size_t i = 0; i < states; ++i) at[i] = static_cast<Scalar>(x[i] + (std::abs(x[i]) > 10 ? x[i] : 1) * 0.1 * std::sin(1.0 + k + 7.0 * static_cast<double>(i)));
    for (std::size_t i = 0; i < inputs; ++i) at[states + i] = static_cast<Scalar>(0.3 * std::cos(2.0 + k + static_cast<double>(i)));
    at[states + inputs] = Scalar(0.2);
    if (parameters > 0) std::memcpy(at.data() + states + inputs + 1, &p, parameters * sizeof(Scalar));
    return at;
}

/// Where M a = b is solved, its entries are data, each with its unit: |M^-1| (U |a| + u) more for the solutions. Of the right sides of Jacobians
/// only the rounding is known.
template <class Number>
void add_solved(const std::vector<long double>& values, std::vector<long double>& unit) {
    constexpr int n = NAME_SPACE::degrees_of_freedom;
    if constexpr (n > 0) {
        using Matrix = Eigen::Matrix<long double, n, n>;
        using Vector = Eigen::Matrix<long double, n, 1>;
        const std::size_t mass = values.size() - n * n - n, first = states - NAME_SPACE::plain_state_count - n;
        const Eigen::Map<const Matrix> M(&values[mass]), U(&unit[mass]);
        const Matrix inverse = Matrix(M.inverse()).cwiseAbs();
        for (std::size_t column = 0; column <= states; ++column) {
            const Eigen::Map<const Vector> a(&values[column * states + first]);
            Vector u = Eigen::Map<const Vector>(&unit[mass + n * n]);
            if (column > 0) u = (M * a).unaryExpr([](long double one) -> long double { return ulp(static_cast<Number>(one)); });
            Eigen::Map<Vector>(&unit[column * states + first]) += inverse * (U * a.cwiseAbs() + u);
        }
    }
}

int main() {
    constexpr std::size_t first_output = states + states * states, first_energy = first_output + NAME_SPACE::output_count, values_shown = first_energy + 3;
    for (std::size_t run = 0; run < 20 * modes; ++run) {
        const std::size_t k = run / modes, mode = run % modes;
        const std::vector<NUMBER> at = point<NUMBER>(static_cast<int>(k));
        const std::vector<NUMBER> values = evaluated(mode, at);
        const std::vector<long double> finer(at.begin(), at.end());
        std::vector<long double> unit(values.size());
        // An entry of a Jacobian is seen beside the largest of its row, each times the size of what it is the slope by.
        const auto size = [&](std::size_t j) { return std::max(std::abs(at[j]), NUMBER(1e-3)); };
        for (std::size_t i = 0; i < values.size(); ++i) unit[i] = std::abs(values[i]);
        for (std::size_t i = 0; i < states; ++i) {
            NUMBER largest = std::abs(values[i]);
            for (std::size_t j = 0; j < states; ++j) largest = std::max(largest, std::abs(values[states + j * states + i]) * size(j));
            for (std::size_t j = 0; j < states; ++j) unit[states + j * states + i] = largest / size(j);
        }
        for (long double& one : unit) one = ulp(static_cast<NUMBER>(one));
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (at[i] == 0) continue;
            std::vector<long double> above = finer, below = finer;
            const long double step = 1e-7L * std::abs(finer[i]);
            above[i] += step;
            below[i] -= step;
            const std::vector<long double> high = evaluated(mode, above), low = evaluated(mode, below);
            for (std::size_t v = 0; v < values.size(); ++v) unit[v] += std::abs(high[v] - low[v]) / (2 * step) * ulp(at[i]) / 2;
        }
        add_solved<NUMBER>(evaluated(mode, finer), unit);
#ifdef BESIDE_LARGEST
        const auto beside_largest = [&](std::size_t first, std::size_t last) {
            NUMBER largest = 0;
            for (std::size_t v = first; v < last; ++v) largest = std::max(largest, std::abs(values[v]));
            for (std::size_t v = first; v < last; ++v) unit[v] = std::max<long double>(unit[v], ulp(largest));
        };
        beside_largest(0, states);
        beside_largest(first_output, first_energy);
#endif
        const auto number = [](long double one) {
            if (std::isfinite(one)) std::printf(" %.17Lg", one);
            else std::printf(" -");
        };
        for (std::size_t v = 0; v < values_shown; ++v) {
            std::printf("%zu.%zu", run, v);
            number(values[v]);
            number(unit[v]);
            std::printf("\n");
        }
    }
}
CODE

eigen=$(pkg-config --cflags eigen3)

# code HEADER: without what tells how it was made.
code() { grep -v '^ *//' "$1"; }

# values NUMBER HEADER: prints what the header gives, and the size of one ulp beyond the condition beside it.
values() {
  local name_space has=()
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$2" | head -1)
  ! grep -q 'mode_count = ' "$2" || has+=(-DHAS_MODES)
  ! grep -q 'void together(' "$2" || has+=(-DHAS_TOGETHER)
  ${CXX:-c++} -std=c++17 "${has[@]}" ${beside_largest:+-DBESIDE_LARGEST} -Wall -Wextra -Wconversion -Wno-overflow $eigen -I"$SOURCE/runtime" -DHEADER="\"$2\"" -DNAME_SPACE="$name_space" -DNUMBER="$1" "$here/print.cpp" -o "$here/print" || exit 1
  "$here/print"
}

# same MODEL NUMBER COMMON -- OPTION...: the largest difference is within 4 ulp of NUMBER beyond the condition, or within `limit` where one is named.
# The condition is that of the header without OPTION, without that of the right sides of Jacobians. `beside_largest`: rates and outputs are seen
# beside the largest of them, because some are zero at every point, and have no condition that would say how large their terms are.
plain=
beside_largest=
failed=0
same() {
  local model=$SOURCE/systems/$1.toml name=$1 number=$2 common=() difference
  shift 2
  while [ "$1" != -- ]; do common+=("$1"); shift; done
  shift
  if [ "$plain" != "$name $number ${common[*]}" ]; then
    "$PROGRAM" generate "$model" "${common[@]}" -o "$here" --header plain.hpp >/dev/null
    values "$number" "$here/plain.hpp" >"$here/expected.txt"
    plain="$name $number ${common[*]}"
  fi
  "$PROGRAM" generate "$model" "${common[@]}" "$@" -o "$here" --header one.hpp >/dev/null
  if cmp -s <(code "$here/one.hpp") <(code "$here/plain.hpp"); then
    [ "${1:-}" = "--without" ] && [ "$2" = "$passes" ] && return
    echo "FAILED: $name: $* changes nothing"
    failed=1
    return
  fi
  values "$number" "$here/one.hpp" >"$here/got.txt"
  difference=$(paste "$here/expected.txt" "$here/got.txt" | awk '
    $1 != $4 { print "other entries"; wrong = 1; exit }
    $2 == "-" && $5 == "-" { next }
    $2 == "-" || $5 == "-" || $3 == "-" { print "a value, or its condition, that is not finite in", $1; wrong = 1; exit }
    { d = $2 - $5; d = (d < 0 ? -d : d) / $3; if (d > worst) worst = d; ++compared }
    END { if (!wrong) print compared ? worst + 0 : "nothing to compare" }')
  echo "$name ${common[*]} $*: $difference"
  awk -v d="$difference" -v limit="${limit:-4}" 'BEGIN { exit !(d ~ /^[0-9]/ && d + 0 <= limit) }' || { echo "FAILED: $name: $* is off by $difference ulp beyond the condition, not within ${limit:-4}"; failed=1; }
}

# Without rewriting, too, digits are lost that it keeps: `dalembert accuracy --without rewriting` shows these.
passes=$("$PROGRAM" generate --help | sed -n 's/.*--without TEXT:{rewriting,\(.*\)}.*/\1/p')
if [ "${1:-}" = full ]; then
  only=${2:-}
  while read -r model; do
    [ -z "$only" ] || [ "$only" = "$model" ] || continue
    limit=4 beside_largest=
    case $model in
      heat/glazing.toml) limit=80 ;;  # a quotient of two small differences
      parts/accumulator.toml | drives/hydraulic_servo_axis.toml) limit=200 ;;  # the way at the start, from which the points are moved, is a small difference
      drives/battery_hoist.toml) beside_largest=1 ;;  # what leaks beside a current of 40 A
      drives/quadcopter.toml) limit=10 ;;  # differences of four thrusts
      parts/pi_controller.toml) limit=5 ;;
      mechanics/slack_rope.toml) limit=9 beside_largest=1 ;;  # energies that cancel; a force that is zero where the rope is slack
      mechanics/rolling_disc.toml) limit=10 ;;  # what the contact bears is solved for with M, whose condition is that of rates only
      mechanics/cylindrical_coordinates.toml | mechanics/polar_coordinates.toml | mechanics/spherical_coordinates.toml) beside_largest=1 ;;  # accelerations that are zero: rounding is all there is
      mechanics/rocket.toml) limit=9 beside_largest=1 ;;  # what is felt in free fall: 1 - 1
    esac
    same "${model%.toml}" double -- --without "$passes"
    same "${model%.toml}" double -- --together
  done < <(machines_and_parts | sed "s|^$SOURCE/systems/||")
  [ -z "$only" ] || exit "$failed"
  limit=4 beside_largest=
  for model in mechanics/stick_slip mechanics/slack_rope hydraulics/hydraulic_cylinder heat/fin; do same $model double -- --together; done
  same mechanics/n_pendulum double --size N=12 -- --together
  same mechanics/arm_6r double --scene plain -- --together
  same mechanics/n_pendulum double --size N=12 --without chain -- --without loops
  for model in mechanics/slider_crank mechanics/four_bar pneumatics/pneumatic_cylinder heat/fin; do
    same $model double -- --fix parameters
    same $model double -- --without constants,factoring
  done
  same hydraulics/valve_cylinder double -- --fix parameters
  same hydraulics/torricelli double -- --fix parameters
  same hydraulics/hydraulic_cylinder double -- --without constants,factoring
  same mechanics/n_pendulum double --size N=12 -- --without constants
  for option in '--fix parameters' '--without constants' '--without factoring' '--without nesting' '--without angles' '--without reciprocals'; do
    same mechanics/arm_6r double --scene plain -- $option
  done
  limit=5 same mechanics/arm_6r double --scene plain -- --without chain
  for option in '--without constants' '--without factoring' '--without angles' '--without nesting' '--without reciprocals'; do
    same mechanics/cart_pendulum double -- $option
  done
  same mechanics/n_pendulum float --size N=5 -- --trig combined
  same mechanics/arm_6r float --scene plain -- --trig combined --fix parameters
  exit $failed
fi

same mechanics/slider_crank double -- --together
same mechanics/n_pendulum double --size N=6 -- --fix g
same mechanics/n_pendulum double --size N=6 -- --without chain
same mechanics/cart_pendulum double -- --fix parameters
same mechanics/spherical_pendulum double -- --without rewriting
same mechanics/spherical_pendulum float -- --trig combined

# A value of one's own, and what the header then has.
"$PROGRAM" generate "$SOURCE/systems/mechanics/cart_pendulum.toml" --fix 'g=9.81,l_S=600 mm,m_W' -o "$here" >/dev/null
header=$here/cart_pendulum_lab.hpp
for line in 'parameter_count = 6;' "^// Fixed: m_W = 1 kg, l_S = 0.6 m, g = 9.81 m/s^2$" "generate cart_pendulum.toml --scene lab --fix 'g=9.81,l_S=600 mm,m_W'$"; do
  grep -q "$line" "$header" || { echo "FAILED: the header has no '$line'"; exit 1; }
done
"$PROGRAM" generate "$SOURCE/systems/mechanics/cart_pendulum.toml" --fix parameters -o "$here" >/dev/null
! grep -q 'c_\.' "$header" || { echo "FAILED: what depends on fixed parameters alone is computed at run time"; exit 1; }
exit $failed

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers of this version compile with the runtime; those of an older or newer version stop the compiler, with a sentence that tells the way out.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
headers=$SOURCE/generated/mechanics
version=$(sed -n 's/^inline constexpr int api_version = \([0-9]*\);$/\1/p' "$headers/pendulum_full.hpp")
cat >"$here/run.cpp" <<'TEXT'
#include "bouncing_ball_full.hpp"
#include "dalembert/simulate_switching.hpp"
#include "pendulum_full.hpp"
using Smooth = pendulum::full::System<double>;
auto run(const Smooth& system, Smooth::State& x) {
    return dalembert::simulate(system, dalembert::ZeroInputs<Smooth>(), x, 0.0, 1.0, dalembert::SimulationOptions<Smooth>(), [](const auto&) {});
}
using Switching = bouncing_ball::full::System<double>;
auto run(const Switching& system, Switching::State& x) {
    return dalembert::simulate_switching(system, dalembert::ZeroInputs<Switching>(), x, 0.0, 1.0,
                                         dalembert::SwitchingSimulationOptions<Switching>(), [](const auto&) {}, [](auto&&...) {});
}
TEXT

# said API: what the compiler says about runs of headers of this version.
said() {
  for name in pendulum_full bouncing_ball_full; do
    sed "s/^inline constexpr int api_version = .*/inline constexpr int api_version = $1;/" "$headers/$name.hpp" >"$here/$name.hpp"
  done
  g++ -std=c++17 -fsyntax-only -I "$SOURCE/runtime" "$here/run.cpp" 2>&1 || true
}
# expect API SENTENCE: for both headers.
expect() {
  local errors
  errors=$(said "$1")
  [ "$(grep -c "error: static assertion failed: $2" <<<"$errors")" -eq 2 ] || { echo "version $1: not '$2' of both headers: $errors"; exit 1; }
}
errors=$(said "$version")
[ -z "$errors" ] || { echo "version $version should fit: $errors"; exit 1; }
expect $((version - 1)) 'the generated header is older than this dalembert runtime: generate the header again'
expect $((version + 1)) 'the generated header is newer than this dalembert runtime: take the runtime of the program'
echo "headers of another version are refused with a sentence"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An installed copy works through find_package in a project of its own, and generates again when the model changes.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cmake --install "$BUILD" --prefix "$here/installed" >/dev/null
cp -r "$SOURCE/tests/consumer/project" "$here/project"
cp "$SOURCE/systems/mechanics/cart_pendulum.toml" "$here/project/"
cmake -S "$here/project" -B "$here/build" -G Ninja -DCMAKE_PREFIX_PATH="$here/installed" >/dev/null
cmake --build "$here/build" >/dev/null
"$here/build/consumer" | tee "$here/first"
grep -q 'm_W = 1.000' "$here/first"
"$here/build/controller" | tee "$here/fixed"
grep -q '^7 parameters are left' "$here/fixed"
"$here/build/c_controller" | tee "$here/in_c"
grep -q '^in C: phi = 0.29' "$here/in_c"
grep -q 'combined_sin_and_cos' "$here/build/fixed_cart.generated/fixed_cart.hpp"
test -s "$(cat "$here/build/exports.txt")/cart_pendulum_lab_plant.c"

# Nothing to do while nothing changed; generated again after a change.
cmake --build "$here/build" | grep -q 'no work to do'
sed -i 's/value = 1.0,  unit = "kg"/value = 1.5,  unit = "kg"/' "$here/project/cart_pendulum.toml"
cmake --build "$here/build" >/dev/null
"$here/build/consumer" | grep -q 'm_W = 1.500'

# The installed program finds its runtime and simulates.
"$here/installed/bin/dalembert" simulate "$here/project/cart_pendulum.toml" --until 0.1 --no-plot -o "$here/out" >/dev/null
test -s "$here/out/cart_pendulum_lab.csv"
echo "the installed copy works"

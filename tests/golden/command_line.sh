#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Exit codes and messages of the program, called as a user calls it.
set -uo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
model=$SOURCE/systems/mechanics/cart_pendulum.toml
failures=0
# expect CODE PATTERN COMMAND...: exit code, and what must be printed
expect() {
  local code=$1 pattern=$2 output got
  shift 2
  output=$("$@" 2>&1)
  got=$?
  if [ "$got" -ne "$code" ] || ! grep -qe "$pattern" <<<"$output"; then
    echo "FAILED: $* gives $got instead of $code, or not '$pattern':"
    echo "$output"
    failures=$((failures + 1))
  fi
}
expect 0 'Examples:' "$PROGRAM" --help
expect 0 'dalembert 0' "$PROGRAM" --version
expect 2 'the verbs are' "$PROGRAM"
expect 2 'the verbs are' "$PROGRAM" conjure
expect 2 'MODEL is required' "$PROGRAM" derive
expect 2 "no model 'nowhere'\|there is no file" "$PROGRAM" derive nowhere.toml
expect 2 "no scene 'lap'; its scenes are 'lab' and 'ideal'" "$PROGRAM" derive "$model" --scene lap
expect 2 'is not a file name' "$PROGRAM" generate "$model" --header ../x.hpp -o "$here/none"
expect 2 "there is no verb 'simulat'; did you mean 'simulate'" "$PROGRAM" simulat "$model"
expect 2 "'simulate' has no option '--tol'; did you mean '--tolerance'" "$PROGRAM" simulate "$model" --tol 1e-6 -o "$here/none"
expect 2 "^--scene:1:1: error.unknown-scene" "$PROGRAM" derive "$model" --scene lap
expect 2 "^--run:1:1: error.unknown-run" "$PROGRAM" simulate "$model" --run nowhere -o "$here/none"
expect 0 'degC .*degree Celsius' "$PROGRAM" help units
expect 0 'number of intervals' "$PROGRAM" help simulate
expect 2 'NAME=WHOLE_NUMBER' "$PROGRAM" derive "$model" --size N
expect 2 'no size' "$PROGRAM" derive "$model" --size N=3
expect 2 "did you mean 'bodies'" "$PROGRAM" help bodeis
# A word without an entry shows the entries that mention it.
expect 0 "no entry 'frequency'.*these entries mention it" "$PROGRAM" help frequency
expect 0 '^modal' "$PROGRAM" help frequency
expect 0 'ddot(s) .* m/s^2' "$PROGRAM" evaluate "$model"
expect 2 "'q' is not a parameter of scene 'lab'" "$PROGRAM" generate "$model" --fix q -o "$here/none"
expect 2 "did you mean 'm_W'" "$PROGRAM" generate "$model" --fix m_w -o "$here/none"
expect 2 "'g' is fixed twice" "$PROGRAM" generate "$model" --fix g,g=9.8 -o "$here/none"
expect 2 'is 50 m, but its range ends at 5 m' "$PROGRAM" generate "$model" --fix l_S=50 -o "$here/none"
expect 2 "the value of 'g' must be in 'm/s^2', but '1kg' is in 'kg'" "$PROGRAM" generate "$model" --fix g=1kg -o "$here/none"
expect 2 "must not depend on 's'" "$PROGRAM" generate "$model" --fix g=s -o "$here/none"
expect 2 'singular-mass' "$PROGRAM" generate "$SOURCE/tests/golden/two_masses_without.toml" --fix m_2=0 -o "$here/none"
expect 2 "'fin' has rods with cells in loops" "$PROGRAM" generate "$SOURCE/systems/heat/fin.toml" --size N=500 --together -o "$here/none"
expect 2 "'quick' is not one of 'library' and 'combined'" "$PROGRAM" generate "$model" --trig quick -o "$here/none"
expect 0 'ddot(s)' "$PROGRAM" evaluate "$model"
expect 2 'unit-mismatch' "$PROGRAM" evaluate "$model" --parameter m_W=2m
expect 2 'value-out-of-range' "$PROGRAM" evaluate "$model" --parameter m_W=-1
expect 2 'unknown-name' "$PROGRAM" evaluate "$model" --state q=1
expect 2 'not of the form NAME=VALUE' "$PROGRAM" evaluate "$model" --state q
expect 2 "must not depend on 's'" "$PROGRAM" evaluate "$model" --parameter m_W=s
expect 2 'number-too-large' "$PROGRAM" evaluate "$model" --state 's=1e308*10'
expect 2 'begins at t = 0' "$PROGRAM" simulate "$model" --until 0 -o "$here/none"
expect 2 "must not depend on 'ddot(s)'" "$PROGRAM" simulate "$model" --until 1 --input 'f_e=ddot(s)' -o "$here/none"
expect 2 'unit-mismatch' "$PROGRAM" simulate "$model" --until 1 --input f_e=1m -o "$here/none"
expect 2 'finite numbers' "$PROGRAM" simulate "$model" --tolerance nan -o "$here/none"
expect 3 'cannot be written: Not a directory' "$PROGRAM" generate "$model" -o /dev/null
expect 3 'output cannot be written' bash -c '"$0" derive "$1" >/dev/full' "$PROGRAM" "$model"
expect 1 'not all as expected' "$PROGRAM" check "$SOURCE/tests/golden/wrong_equation.toml"
expect 3 'cannot be started' env CXX=no-such-compiler "$PROGRAM" simulate "$model" --until 1 -o "$here/none"
[ ! -e "$here/none" ] || { echo "FAILED: something was left behind"; failures=$((failures + 1)); }
expect 0 'energy error' "$PROGRAM" simulate "$model" --until 1 --input 'f_e=sin(2*pi*t) + cos(2*pi*t)*min(1, t)' -o "$here/out"
for ending in hpp csv svg png; do
  [ -s "$here/out/cart_pendulum_lab.$ending" ] || { echo "FAILED: no $ending"; failures=$((failures + 1)); }
done
head -1 "$here/out/cart_pendulum_lab.csv" | grep -q '^t \[s\],s \[m\],phi \[rad\],dot(s) \[m/s\],dot(phi) \[rad/s\],tip \[m\],f_e \[N\],' ||
  { echo "FAILED: CSV header"; failures=$((failures + 1)); }
# A run that leaves where its equations have values ends with code 4, names the state, and keeps what was computed.
expect 4 "not finite; state 'dot(x)'" "$PROGRAM" simulate "$SOURCE/tests/golden/blow_up.toml" --until 10 --no-plot -o "$here/blow_up"
[ -s "$here/blow_up/blow_up_full.csv" ] || { echo "FAILED: what was computed before the stop is not kept"; failures=$((failures + 1)); }
expect 2 'value-out-of-range' "$PROGRAM" simulate "$SOURCE/systems/mechanics/spherical_pendulum.toml" --scene free --state theta=4 \
  --until 1 --no-plot -o "$here/pole"
# What takes long to compile.
if [ -n "${DALEMBERT_FULL:-}" ]; then
  expect 0 'isolated' "$PROGRAM" equilibrium "$model"
  expect 0 '^  tip  *[-0-9.e]* m$' "$PROGRAM" equilibrium "$model"
  expect 0 'd/dt dot(s)  *-36.099 ' "$PROGRAM" equilibrium "$model"
  # A linear system, one that is not and is linearised, and one of whose modes only some are free.
  expect 0 'coupled, block 1' "$PROGRAM" modal "$SOURCE/systems/mechanics/drive_train.toml"
  expect 0 "stiffness_matrix\[s, phi\] depends\|depends on 'phi'" "$PROGRAM" modal "$model" --state phi=0
  expect 4 'constraints hold every motion' "$PROGRAM" modal "$SOURCE/systems/mechanics/stick_slip.toml" --mode floor_sticks
  expect 0 'mode floor_slides_forwards: linear' "$PROGRAM" modal "$SOURCE/systems/mechanics/stick_slip.toml" --mode floor_slides_forwards
  # A stop holds the piston at its stroke, wherever it starts.
  expect 0 's_k *0\.1 m' "$PROGRAM" equilibrium "$SOURCE/systems/hydraulics/cylinder_stops.toml" --mode inner_open_and_outer_closed
fi
cat >"$here/bumper.toml" <<'MODEL'
[model]
format = 1
name   = "bumper"
[parameters]
m = { value = 1, unit = "kg" }
[coordinates]
x = { unit = "m" }
y = { unit = "m" }
[bodies]
a = { mass = "m", position = ["x", 0, 0] }
b = { mass = "m", position = ["y", 0, 0] }
[stops.bumper]
gap = "y - x"
MODEL
expect 2 'contains several coordinates' "$PROGRAM" equilibrium "$here/bumper.toml" --mode bumper_closed
exit "$((failures > 0))"

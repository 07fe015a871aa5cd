# SPDX-License-Identifier: GPL-3.0-or-later
# Runs with fixed steps went on without a word from a singular position that no step leads over: they keep the energy, or stop there by name.
for method in "dop853" "rk4 --step 0.001"; do
  echo "> dalembert simulate $model --method $method"
  code=0
  # shellcheck disable=SC2086
  timeout "${limit:-120}" "$PROGRAM" simulate "$model" --method $method --no-plot -o out >printed 2>&1 || code=$?
  case $code in
    0) near "energy error by $method" "$(number 'energy error: .* = ')" 0 1e-7 ;;
    4) prints "stopped at t = .* singular position; constraint 'rod' depends on the others there" ;;
    *) fail "exit code $code" ;;
  esac
done

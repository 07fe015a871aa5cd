# SPDX-License-Identifier: GPL-3.0-or-later
# Edges of the servo axis had another order in some modes, and another one in the next run: GiNaC turns sums round by an order of its own.
axis=$(dirname "$model")/servo_axis.toml
dalembert 0 generate "$axis" -o first
for run in 1 2 3 4 5; do
  dalembert 0 generate "$axis" -o again
  cmp first/servo_axis_full.hpp again/servo_axis_full.hpp || fail "run $run made another header"
done

# SPDX-License-Identifier: GPL-3.0-or-later
# Runs with fixed steps went on through a singular position that no step leads over.
for method in "--method dop853" "--method rk4 --step 0.001" "--method dopri5 --step 0.01"; do
  # shellcheck disable=SC2086
  dalembert 4 simulate "$model" $method --no-plot -o out
  prints "stopped at t = 0\\.7.*singular position; constraint 'rod' depends on the others there"
done

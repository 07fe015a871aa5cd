# SPDX-License-Identifier: GPL-3.0-or-later
# A link without mass whose motion constraints determine was refused: its row of the mass matrix is zero, although the equations are regular.
dalembert 0 check "$model"
prints "forces of constraints do no virtual work +1 proven"
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 -o .
csv=massless_rod_full.csv
for t in 0.5 1.3 3; do
  near "speed at $t s" "$(column $csv 'dot(phi)' $t)" "$(column $csv by_energy $t)" 1e-7
  near "force at $t s" "$(column $csv along $t)" "$(column $csv inertial $t)" 1e-7
  near "force across the rod at $t s" "$(column $csv across $t)" 0 1e-7
done

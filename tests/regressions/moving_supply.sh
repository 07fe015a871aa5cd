# SPDX-License-Identifier: GPL-3.0-or-later
# The valve opened again as soon as it shut, and the run stopped: "accumulation". Both modes are linear in p; the number is that of their
# closed solutions, one after the other, with the times of events as their zeros.
for method in dopri5 rodas5p dop853 taylor; do
  dalembert 0 simulate "$model" --no-plot -o . --method $method --tolerance 1e-11
  prints "13 events passed"
  near "pressure at the end with $method" "$(last moving_supply_full.csv p)" 575577.750038977 1e-6
done

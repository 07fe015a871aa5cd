# SPDX-License-Identifier: GPL-3.0-or-later
# A run whose inputs call a curve did not compile, and the value of a curve at a bare number was taken for a number without a unit.
dalembert 0 simulate "$model" --no-plot -o .
csv=curve_of_time_full.csv
near "speed" "$(column $csv 'dot(x)' 2)" 5 1e-9
near "angle" "$(column $csv phi 2)" 0.78539816339744831 1e-14

# SPDX-License-Identifier: GPL-3.0-or-later
# Valves that switch multiplied: more than six of them were refused. The value at 2 ms is from a Runge-Kutta method of fourth order.
dalembert 0 check "$model"
prints "'v_1', .*'v_12' bring no modes"
dalembert 0 simulate "$model" --no-plot
csv=twelve_valves_full.csv
near 'pressure at 2 ms' "$(column $csv over 0.002)" 1029597.2476 0.01
expected=$(awk 'BEGIN { d = 10; for (i = 0; i < 50; ++i) d = (55 + 50*exp(-d/14000))/10; printf "%.15g", d*1e5 }')
near 'pressure in the end' "$(last $csv over)" "$expected" 0.01
# A mode that is named keeps its group: the others bring none.
sed 's/^\[outputs\]/&\nis_open = { value = "v_3_open" }/' "$model" >named.toml
dalembert 0 simulate named.toml --no-plot
prints_not "'v_3'"
near 'valve 3 is open' "$(last $csv is_open)" 1 0
near 'pressure in the end' "$(last $csv over)" "$expected" 0.01

# SPDX-License-Identifier: GPL-3.0-or-later
# Of machines that switch, starts were not found from constraints, and runs stopped: "no mode accepts the start values".
for a in 50 40; do
    dalembert 0 simulate "$model" --no-plot --parameter a=${a}mm -o out
    start=$(column out/start_where_friction_sticks_full.csv s 0)
    near "s(0)" "$start" "$(awk "BEGIN { a = $a/1000; l = 0.15; y = a*sin(0.5); printf \"%.15f\", a*cos(0.5) + sqrt(l*l - y*y) }")" 1e-11
done
# Of friction with a state in place of modes no mode holds the constraint: its start_rate counts.
dalembert 0 derive "$(dirname "$model")/five_blocks.toml"

# SPDX-License-Identifier: GPL-3.0-or-later
# A servo axis was refused for its 72 combinations of modes; with more allowed, deriving and proving them took more than a minute.
TIMEFORMAT=%U
{ time dalembert 0 generate "$model" -o . >generated.txt; } 2>seconds
prints "'u', 'relief' bring no modes"
prints_not "only numerically equal"
near 'processor time of generate' "$(cat seconds)" 0 5
dalembert 0 simulate "$model" --no-plot
csv=servo_axis_full.csv
near 'breaks away' "$(awk -F, '/guide_dry_breaks_backwards/ {print $1; exit}' servo_axis_full_events.csv)" 0.002505045 1e-8
near 'turns round' "$(awk -F, '/guide_dry_stops_backwards/ {print $1; exit}' servo_axis_full_events.csv)" 0.100293869 1e-8
near 'x(0.5 s)' "$(column $csv x 0.5)" 0.17446225626 1e-10
near 'p_1(0.5 s)' "$(column $csv p_1 0.5)" 8617062.0974 0.01
near 'x(2 s)' "$(column $csv x 2)" 0.199491504786 1e-10
near 'p_1(2 s)' "$(column $csv p_1 2)" 8765133.45619 0.01

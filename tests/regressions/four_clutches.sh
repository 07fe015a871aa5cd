# SPDX-License-Identifier: GPL-3.0-or-later
# Four clutches were refused: 81 modes.
dalembert 0 simulate "$model" --no-plot
events=four_clutches_full_events.csv
takes_hold() { near "clutch $1 takes hold" "$(awk -F, -v e="$1_stops_forwards" '$2 == e { print $1; exit }' $events)" "$2" 1e-9; }
takes_hold a 0.3076923076923077
takes_hold b 2.8333333333333333
takes_hold d 5.7142857142857143
takes_hold c 8.05
for i in 1 2 3 4 5; do near "rate of disc $i" "$(last four_clutches_full.csv "dot(phi_$i)")" 0.4666666666666667 1e-12; done

# SPDX-License-Identifier: GPL-3.0-or-later
# CoupledClutches of the Modelica Standard Library; numbers of oracles/coupled_clutches.py, closed forms in each phase, with 30 digits.
dalembert 0 simulate "$model" --no-plot
csv=coupled_clutches_full.csv
events=coupled_clutches_full_events.csv
# time_of EVENT COUNT: the time at which an event happens for the COUNT-th time
time_of() { grep ",$1," $events | sed -n "$2p" | cut -d, -f1; }
digits "second clutch holds, s" "$(time_of clutch_2_lining_stops_forwards 1)" 0.70962147469374658116 8
digits "first clutch holds, s" "$(time_of clutch_1_lining_stops_forwards 1)" 0.79166235915481619863 8
digits "first clutch slips, s" "$(time_of clutch_1_lining_breaks_forwards 1)" 0.8311085061376532161 8
digits "first clutch holds again, s" "$(time_of clutch_1_lining_stops_forwards 2)" 0.90685019279787983419 8
digits "first clutch slips again, s" "$(time_of clutch_1_lining_breaks_forwards 2)" 1.0002958598946386507 8
digits "third clutch holds, s" "$(time_of clutch_3_lining_stops_forwards 1)" 1.143967492473165945 8
digits "w_1(1.2 s)" "$(last $csv 'dot(J_1_phi)')" 2.6261412962863791367 8
digits "w_4(1.2 s)" "$(last $csv 'dot(J_4_phi)')" 2.4579529012378736211 8

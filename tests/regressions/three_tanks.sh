# SPDX-License-Identifier: GPL-3.0-or-later
# The run ended without the cause, after a long time; it has to name the flows and the remedy, which has to work.
# tier: full
dalembert 0 check "$model"
prints "warning.*'junction' stores.*'pipe1', 'pipe2' and 'pipe3'.*width"
dalembert 4 simulate "$model" --no-plot
prints "infinite where.*'pipe1', 'pipe2', 'pipe3'.*width"
sed 's/coefficient = "1\/sqrt(zeta)"/&, width = "1 Pa"/' "$model" >smooth.toml
dalembert 0 simulate smooth.toml --no-plot
prints_not "far less than"
csv=three_tanks_c_full.csv
near "h_1(200 s)" "$(last $csv h_1)" 3.6666667 1e-3
near "h_2(200 s)" "$(last $csv h_2)" 3.6666667 1e-3
near "h_3(200 s)" "$(last $csv h_3)" 6.6666667 1e-3

# SPDX-License-Identifier: GPL-3.0-or-later
# A stiff volume where three pipes meet ended the run at balance; a junction stores nothing. h(30 s) is by extrapolation in 40 digits, the junction by bisection.
dalembert 0 simulate "$model" --no-plot
csv=three_tanks_junction_full.csv
near "h_1(30 s)" "$(column $csv h_1 30)" 6.5327808602463078 1e-12
near "h_2(30 s)" "$(column $csv h_2 30)" 3.2671963244372496 1e-12
near "h_3(30 s)" "$(column $csv h_3 30)" 4.2000228153164426 1e-12
near "h_1(200 s)" "$(last $csv h_1)" 3.6666666666666667 1e-12
near "h_2(200 s)" "$(last $csv h_2)" 3.6666666666666667 1e-12
near "h_3(200 s)" "$(last $csv h_3)" 6.6666666666666667 1e-12
dalembert 2 generate "$model" --taylor
prints "junction_root.*no Taylor series"

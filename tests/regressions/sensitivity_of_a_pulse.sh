# SPDX-License-Identifier: GPL-3.0-or-later
# Where the guard of an event jumps over its zero, at a time that a parameter moves, sensitivities took its slope before the jump: they were
# wrong without a word. Each edge of the pulse at t_e, up or down, adds U/L*exp(-R/L*(t - t_e)) times the rate of t_e.
dalembert 0 simulate "$model" --sensitivities T_p,D --tolerance 1e-12 --no-plot -o out
file=out/sensitivity_of_a_pulse_full_sensitivities.csv
near "di/dT_p" "$(last $file 'd(i)/d(T_p)')" 5186.846367783 2e-4
near "di/dD" "$(last $file 'd(i)/d(D)')" 1.0719120826968 1e-8
# A pulse that is shorter than a step is not passed over: 400 edges where nothing else asks for short steps.
dalembert 0 simulate "$model" --until 0.02 --samples 1 --tolerance 1e-3 --no-plot -o out
prints "(399|400) events passed"

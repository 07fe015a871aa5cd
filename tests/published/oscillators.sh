# SPDX-License-Identifier: GPL-3.0-or-later
# Translational.Examples.Oscillator of the Modelica Standard Library; numbers of oracles/oscillators.py, matrix exponentials with 30 digits.
# tier: full
dalembert 0 simulate "$model" --no-plot
csv=oscillators_full.csv
digits "s(1 s), free" "$(last $csv free_s)" -0.50433695713175710237 8
digits "v(1 s), free" "$(last $csv 'dot(free_s)')" -0.25317515740586293988 8
digits "s(1 s), damped" "$(last $csv damped_s)" -0.50085719960912051437 8
digits "v(1 s), damped" "$(last $csv 'dot(damped_s)')" -0.050222573425572374483 8

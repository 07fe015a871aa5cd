# SPDX-License-Identifier: GPL-3.0-or-later
# DCPM_Start of the Modelica Standard Library; numbers of oracles/dcpm_start.py, matrix exponentials with 30 digits.
dalembert 0 simulate "$model" --no-plot
csv=dcpm_start_full.csv
digits "i_a(1 s)" "$(column $csv motor_i 1)" 92.527385535512556552 8
digits "w(1 s)" "$(column $csv 'dot(load_phi)' 1)" 149.8125373656741147 8
digits "i_a(2 s)" "$(last $csv motor_i)" 99.974363430949056236 8
digits "w(2 s)" "$(last $csv 'dot(load_phi)')" 149.22784374991325063 8
digits "phi(2 s)" "$(last $csv load_phi)" 210.22598366802853782 8

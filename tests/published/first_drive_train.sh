# SPDX-License-Identifier: GPL-3.0-or-later
# Rotational.Examples.First of the Modelica Standard Library; numbers of oracles/first_drive_train.py, a matrix exponential with 30 digits.
# tier: full
dalembert 0 simulate "$model" --no-plot
csv=first_drive_train_full.csv
digits "phi_2(1 s)" "$(last $csv phi_2)" 0.16232822702741040047 8
digits "phi_3(1 s)" "$(last $csv load_phi)" 0.16286164287996858501 8
digits "w_2(1 s)" "$(last $csv 'dot(phi_2)')" -0.11224930920312144882 8
digits "w_3(1 s)" "$(last $csv 'dot(load_phi)')" -0.13814527991832330942 8

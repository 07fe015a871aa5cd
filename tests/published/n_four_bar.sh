# SPDX-License-Identifier: GPL-3.0-or-later
# N-four-bar mechanism, IFToMM benchmark A02; numbers of oracles/n_four_bar.py: the parallelograms move as a pendulum, in closed form.
dalembert 0 simulate "$model" --no-plot
csv=n_four_bar_N1_full.csv
digits "phi_0(5 s)" "$(column $csv phi_0 5)" -15.374480941420129 8
digits "phi_0(10 s)" "$(last $csv phi_0)" -30.343944970943128 8
digits "phi[1](10 s)" "$(last $csv 'phi[1]')" -30.343944970943128 8
digits "dot(phi_0)(10 s)" "$(last $csv 'dot(phi_0)')" -1.9669347194403195 8

# SPDX-License-Identifier: GPL-3.0-or-later
# N-four-bar mechanism, IFToMM benchmark A02; numbers of oracles/n_four_bar.py: the parallelograms move as a pendulum, in closed form.
# tier: full
dalembert 0 simulate "$model" --no-plot
csv=n_four_bar_N10_full.csv
digits "phi_0(5 s)" "$(column $csv phi_0 5)" -14.775111170259437 8
digits "phi_0(10 s)" "$(last $csv phi_0)" -30.050933495986976 8
digits "phi[10](10 s)" "$(last $csv 'phi[10]')" -30.050933495986976 8
digits "dot(phi_0)(10 s)" "$(last $csv 'dot(phi_0)')" -1.2122622165278673 8

# SPDX-License-Identifier: GPL-3.0-or-later
# Andrews' squeezer mechanism: IVP test set, reference of 14 digits computed there with PSIDE at a tolerance of 1e-14.
dalembert 0 simulate "$model" --no-plot
csv=andrews_squeezer_full.csv
digits "beta(0.03 s)" "$(last $csv beta)" 15.81077119629904 8
digits "Theta(0.03 s)" "$(last $csv Theta)" -15.75637105984298 8
digits "gamma(0.03 s)" "$(last $csv gamma)" 0.04082224013073101 8
digits "Phi(0.03 s)" "$(last $csv Phi)" -0.5347301163226948 8
digits "delta(0.03 s)" "$(last $csv delta)" 0.5244099658805304 8
digits "Omega(0.03 s)" "$(last $csv Omega)" 0.5347301163226948 8
digits "epsilon(0.03 s)" "$(last $csv epsilon)" 1.048080741042263 8

# SPDX-License-Identifier: GPL-3.0-or-later
# A machine of 40 loops took the compiler more than 20 minutes.
# tier: full
limit=600
dalembert 0 simulate "$model" --no-plot -o out
near "phi_0(10 s)" "$(last out/four_bars_N40_full.csv phi_0)" -30.02663741719 1e-6
near "phi[40](10 s)" "$(last out/four_bars_N40_full.csv 'phi[40]')" -30.02663741719 1e-6
near "energy error" "$(number 'energy error: .* = ')" 0 1e-8

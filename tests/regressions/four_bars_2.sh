# SPDX-License-Identifier: GPL-3.0-or-later
# Several loops that become singular together lost a third of the energy.
dalembert 0 simulate "$model" --no-plot -o out
near "phi_0(10 s)" "$(last out/four_bars_N2_full.csv phi_0)" -30.17980086019 1e-6
near "phi[2](10 s)" "$(last out/four_bars_N2_full.csv 'phi[2]')" -30.17980086019 1e-6
near "energy error" "$(number 'energy error: .* = ')" 0 1e-8

# SPDX-License-Identifier: GPL-3.0-or-later
# Methods lost energy at singular positions, or stopped there.
# tier: full
limit=300
for method in "dop853 --tolerance 1e-10" "fehlberg78 --tolerance 1e-10" "bulirsch_stoer --tolerance 1e-10" "rodas5p --tolerance 1e-10" "taylor --tolerance 1e-10" "rk4 --step 0.002"; do
  # shellcheck disable=SC2086
  dalembert 0 simulate "$model" --method $method --no-plot -o out
  near "phi_0(10 s), $method" "$(last out/four_bars_N20_full.csv phi_0)" -30.034753133474 1e-6
  near "phi[20](10 s), $method" "$(last out/four_bars_N20_full.csv 'phi[20]')" -30.034753133474 1e-6
  near "energy error, $method" "$(number 'energy error: .* = ')" 0 1e-8
done

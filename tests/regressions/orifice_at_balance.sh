# SPDX-License-Identifier: GPL-3.0-or-later
# A flow like a root that reverses stopped the run, or was taken for none over long steps: the implicit method saw the infinite slope.
csv=orifice_at_balance_full.csv
for method in automatic rodas5p; do
  dalembert 0 simulate "$model" --no-plot --method $method
  # by the balance of mass alone, Runge-Kutta with 1e-6 s and 5e-7 s
  near "p(2 s), $method" "$(last $csv p)" 795046.454797985 1e-4
  near "flow(2 s), $method" "$(last $csv flow)" 4.77848580749991e-5 1e-13
done

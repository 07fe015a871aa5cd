# SPDX-License-Identifier: GPL-3.0-or-later
# Runs that came near the flat position lost 2 % of the energy there without a word, or stopped.
# tier: full
for tolerance in 1e-8 1e-9 1e-12; do
  dalembert 0 simulate "$model" --tolerance $tolerance --no-plot -o out
  prints_not "singular|stopped"
  near "a(10 s) at $tolerance" "$(last out/parallelogram_full.csv a)" -29.582311436196 1e-7
  near "c(10 s) at $tolerance" "$(last out/parallelogram_full.csv c)" -29.582311436196 1e-7
  near "energy error at $tolerance" "$(number 'energy error: .* = ')" 0 1e-8
done
for method in bulirsch_stoer rodas5p taylor rk4; do
  step=""
  [ $method = rk4 ] && step="--step 0.001"
  # shellcheck disable=SC2086
  dalembert 0 simulate "$model" --method $method $step --no-plot -o out
  near "a(10 s) by $method" "$(last out/parallelogram_full.csv a)" -29.582311436196 1e-6
  near "energy error by $method" "$(number 'energy error: .* = ')" 0 1e-8
done

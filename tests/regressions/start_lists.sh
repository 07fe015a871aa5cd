# SPDX-License-Identifier: GPL-3.0-or-later
# Families start with a list, one value for each member, in the model and in runs; a start of one member behind it counts.
ends() {
  dalembert 0 simulate "$model" --run "$1" -o out --no-plot
  for k in 1 2 3; do near "x[$k] of run $1" "$(last out/flight_N3_full.csv "x[$k]")" "$(eval echo "\${$((k + 1))}")" 1e-12; done
}
ends reference 0.102 0.2 -3.5
near 'momentum of the list' "$(last out/flight_N3_full.csv momentum)" -5.999 1e-12
ends other 1 6.02 7
near 'momentum of the list of the run' "$(last out/flight_N3_full.csv momentum)" 1.5 1e-12
ends all 1.002 1 -3

# SPDX-License-Identifier: GPL-3.0-or-later
# A spring and a pump by maps: what is stored, dissipated and given to the tank is the same at the end as at the start.
dalembert 0 check "$model"
prints "force = -d.energy./dq +1 proven"
prints "dissipated power not negative +1 proven"
prints "supplied - dissipated \\+ exchanged +1 proven"
dalembert 0 simulate "$model" --no-plot -o .
error=$(sed -n 's/^energy error: .* = \([0-9.e+-]*\)$/\1/p' printed)
awk -v e="$error" 'BEGIN { exit !(e != "" && e < 1e-10) }' || fail "energy error '$error'"
# By series, whose coefficients follow from derivatives of the maps, the wheel gets to the same place. At a knot a series must be one of
# the side to which the wheel goes, though speed and knot are one number there to the last digit.
dalembert 0 simulate "$model" --no-plot -o . --tolerance 1e-13
expected=$(last map_energy_full.csv phi)
dalembert 0 simulate "$model" --no-plot -o . --tolerance 1e-13 --method taylor
near "angle at the end by series" "$(last map_energy_full.csv phi)" "$expected" 1e-11
dalembert 0 simulate "$model" --no-plot -o . --tolerance 1e-9 --method taylor
near "angle at the end by short series" "$(last map_energy_full.csv phi)" "$expected" 1e-9

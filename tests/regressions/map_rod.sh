# SPDX-License-Identifier: GPL-3.0-or-later
# A rod with a conductivity of temperature and moisture warms as one with the curve at this moisture: heat flows are integrals of both.
for scene in map curve; do
    dalembert 0 check "$model" --scene "$scene"
    dalembert 0 simulate "$model" --scene "$scene" --no-plot -o .
done
near "temperature in the middle" "$(last map_rod_N6_map.csv "T[3]")" "$(last map_rod_N6_curve.csv "T[3]")" 1e-13
# At another moisture it is warmer, so the comparison sees the second variable.
dalembert 0 simulate "$model" --scene map --no-plot -o . --parameter w=25
moist=$(last map_rod_N6_map.csv "T[3]")
dry=$(last map_rod_N6_curve.csv "T[3]")
awk -v a="$moist" -v b="$dry" 'BEGIN { exit !(a - b > 0.01 || b - a > 0.01) }' || fail "the moisture changes nothing"

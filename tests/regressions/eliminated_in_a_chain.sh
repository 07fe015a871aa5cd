# SPDX-License-Identifier: GPL-3.0-or-later
# The factor of one constraint changes with a coordinate that another one eliminates: the program said that its power balance does not hold.
# (J + J/i^2 + m r^2 cos(p_1)^2) w^2 is constant, which is (0.1 + 0.1/9 + 0.02)*4 at the start.
dalembert 0 check "$model"
dalembert 0 simulate "$model" --no-plot
csv=eliminated_in_a_chain_full.csv
energy=$(awk -v p="$(last $csv p_1)" -v w="$(last $csv 'dot(p_1)')" 'BEGIN { printf "%.15g", (0.1 + 0.1 / 9 + 0.02 * cos(p) ^ 2) * w * w }')
digits "energy of the motion" "$energy" 0.524444444444444444 10

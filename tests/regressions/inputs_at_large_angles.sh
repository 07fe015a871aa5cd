# SPDX-License-Identifier: GPL-3.0-or-later
# Slopes of an input by the angle that it follows were differences over whole turns, and derivatives of the run up to a hundred times too large.
for turns in 0 20000; do
    start=$(awk "BEGIN { printf \"%.12f\", 0.7 + $turns*2*3.14159265358979324 }")
    dalembert 0 simulate "$model" --no-plot --parameter phi_0=$start --sensitivities w_0 -o out
    near "d(phi)/d(w_0)" "$(last out/inputs_at_large_angles_full_sensitivities.csv 'd(phi)/d(w_0)')" 0.126307710786 1e-7
done

# SPDX-License-Identifier: GPL-3.0-or-later
# A start at rest on a knot of a curve, or on the kink of a ramp, that is left at once: sensitivities ended as an event storm at 0 s.
# A body at 5 mm is drawn back by 1600 N/m, beyond 5 mm by more: x = 5 mm * cos(w t) on this side, and dx/dm = 5 mm * t w sin(w t)/(2 m).
dalembert 0 simulate "$model" --sensitivities m --until 0.05 --samples 5 --no-plot -o .
prints_not "event storm"
csv=kink_left_at_rest_full_sensitivities.csv
expected=$(awk 'BEGIN { w = sqrt(800); t = 0.05; printf "%.15g", 0.005 * t * w * sin(w * t) / 4 }')
near "dx/dm" "$(column $csv 'd(x)/d(m)' 5)" "$expected" 1e-9
sed 's/^force = .*/force = ["-curve(x)", 0, 0]/' "$model" >by_curve.toml
dalembert 0 simulate by_curve.toml --sensitivities m --until 0.05 --samples 5 --no-plot -o .
prints_not "event storm"
near "dx/dm by a curve" "$(column $csv 'd(x)/d(m)' 5)" "$expected" 1e-9

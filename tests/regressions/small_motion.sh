# SPDX-License-Identifier: GPL-3.0-or-later
# Errors of dot(y) were measured against 3e-9 m/s, of which rounding leaves no nine digits: 134,915 steps.
dalembert 0 simulate "$model" --no-plot -o .
near x "$(last small_motion_full.csv x)" -3.028779091637541e-06 1e-13
steps=$(grep -oE '^[0-9]+ steps' printed | grep -oE '[0-9]+')
[ "$steps" -lt 1500 ] || fail "$steps steps"
dalembert 0 simulate "$model" --tolerance 1e-12 --no-plot -o .
near "x at 1e-12" "$(last small_motion_full.csv x)" -3.028779091637541e-06 1e-13
steps=$(grep -oE '^[0-9]+ steps' printed | grep -oE '[0-9]+')
[ "$steps" -lt 5000 ] || fail "$steps steps at 1e-12"

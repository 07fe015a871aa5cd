# SPDX-License-Identifier: GPL-3.0-or-later
# Constraints and cuts could not be families: `for` was an unknown key.
dalembert 0 check "$model"
prints "forces of constraints do no virtual work +3 proven"
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 -o .
csv=families_N3_full.csv
for k in 1 2 3; do
  near "pull[$k]" "$(last $csv "pull[$k]")" "$(last $csv "energy[$k]")" 1e-7
  near "borne[$k]" "$(last $csv "borne[$k]")" "$(last $csv "energy[$k]")" 1e-7
done
# d*cos(w*t) at 2 s, w = sqrt(100*k)
near "elongation 1" "$(awk -v a="$(last $csv 'p[1]')" -v b="$(last $csv 'q[1]')" 'BEGIN { print a - b }')" 0.0408082062 1e-7
near "elongation 3" "$(awk -v a="$(last $csv 'p[3]')" -v b="$(last $csv 'q[3]')" 'BEGIN { print a - b }')" -0.0996516153 1e-7

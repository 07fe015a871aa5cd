# SPDX-License-Identifier: GPL-3.0-or-later
# Each sample cost a step at least, because steps were no longer than the time between samples. Where the time acts they still are, so that no short bump is stepped over.
dalembert 0 simulate "$model" --no-plot -o .
steps=$(grep -oE '^[0-9]+ steps' printed | grep -oE '[0-9]+')
[ "$steps" -lt 200 ] || fail "$steps steps for 4000 samples"
csv=samples_full.csv
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^x /) at = i; next } { d = $at - cos(2*$1); if (d < 0) d = -d; if (d > worst) worst = d; rows++ } END { exit !(rows == 4001 && worst < 1e-7) }' $csv || fail "samples are off"
dalembert 0 simulate "$model" --run pulled --no-plot -o .
steps=$(grep -oE '^[0-9]+ steps' printed | grep -oE '[0-9]+')
[ "$steps" -ge 400 ] || fail "$steps steps, longer than the samples"

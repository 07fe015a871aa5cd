# SPDX-License-Identifier: GPL-3.0-or-later
# Small inputs took hours, or memory without end; now they have a result in seconds, or a sentence with the limit.
limit=60
dalembert 0 generate "$model" -o .
# What computers have no number for, beside a value of 1/11!.
dalembert 0 evaluate "$model"
near "1/11!" "$(number 'decay ')" 2.505210838544172e-08 1e-20
# A chain of definitions in any order: d1 = x, d2 = d1 + x, ...
{ cat "$model"; echo '[definitions]'; echo 'd1 = "x"'; for i in $(seq 2 1600); do echo "d$i = \"d$((i - 1)) + x\""; done; } | sed 's/^growth.*/y = "d1600"/' >chain.toml
dalembert 0 evaluate chain.toml
near "1600 x" "$(number '  y ')" 1600 1e-9
# Sums and products of thousands of terms.
for sign in + ' '; do
  count=1500
  [ "$sign" = ' ' ] && count=500
  { printf '[catalogue]\nformat = 1\nsource = "s"\n[positive]\na = "1"\n[letters]\nx = "1"\n[entries."1"]\nlatex = '"'''x = a"; for _ in $(seq 2 $count); do printf '%sa' "$sign"; done; printf "'''\n"; } >terms.toml
  dalembert 1 check terms.toml
  prints '1 wrong'
done

# SPDX-License-Identifier: GPL-3.0-or-later
# A run that lost its energy ended with exit code 0, without a word.
dalembert 1 simulate "$model" --method rk4 --step 1 --no-plot -o .
near "the energy error" "$(number 'max\(T \+ \|V\|\) = ')" 0.70557 1e-3
prints "warning: the energy error of 0.71 is above the limit of 0.05.*steps of 1 s are probably too long"
dalembert 1 simulate "$model" --method rk4 --step 1 --no-plot --format json -o .
prints '"energy_limit": 0.05'
dalembert 0 simulate "$model" --no-plot -o .
prints_not warning

# SPDX-License-Identifier: GPL-3.0-or-later
# Of two constraints that say the same, the one whose gradient vanishes on the way was kept.
dalembert 0 simulate "$model" --no-plot -o out
near "x(10 s)" "$(last out/redundant_full.csv x)" -0.83907152907645 1e-7
near "y(10 s)" "$(last out/redundant_full.csv y)" -0.83907152907645 1e-7
near "energy error" "$(number 'energy error: .* = ')" 0 1e-8

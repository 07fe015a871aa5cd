# SPDX-License-Identifier: GPL-3.0-or-later
# A bead that came to the crossing of two wires left it on the wrong one, or stopped there.
dalembert 0 simulate "$model" --no-plot -o out
near "x(2 s)" "$(last out/cross_full.csv x)" -1 1e-12
near "y(2 s)" "$(last out/cross_full.csv y)" -1 1e-12
near "x(1 s)" "$(column out/cross_full.csv x 1)" 0 1e-12

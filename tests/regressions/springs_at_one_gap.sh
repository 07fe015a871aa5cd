# SPDX-License-Identifier: GPL-3.0-or-later
# Two springs that meet a body at one position: no mode was found between the two events, and the run stopped.
dalembert 0 simulate "$model" --no-plot
near "x(10 s)" "$(last springs_at_one_gap_full.csv x)" -0.05575191894877521 1e-7

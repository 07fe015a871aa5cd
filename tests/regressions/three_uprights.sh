# SPDX-License-Identifier: GPL-3.0-or-later
# Constraints that follow from others all along the way were not told where points near the start lie on singular positions.
dalembert 0 simulate "$model" --no-plot -o out
prints "constraint 'y_3' follows from the others"
near "phi_1(10 s)" "$(last out/three_uprights_full.csv phi_1)" -30.68420136449158 1e-8
near "phi_3(10 s)" "$(last out/three_uprights_full.csv phi_3)" -30.68420136449158 1e-8
near "energy error" "$(number 'energy error: .* = ')" 0 1e-11

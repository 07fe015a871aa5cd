# SPDX-License-Identifier: GPL-3.0-or-later
# Derivatives were brought back to the constraint across a point of its curve, with the slopes of neither side: four per mille were wrong.
dalembert 0 simulate "$model" --no-plot --tolerance 1e-12 --sensitivities J -o out
derivatives=out/cam_follower_full_sensitivities.csv
near "d(phi)/d(J)" "$(last $derivatives 'd(phi)/d(J)')" 92.2864015047 1e-8  # as extrapolated differences of runs
near "d(dot(phi))/d(J)" "$(last $derivatives 'd(dot(phi))/d(J)')" 447.436150765 1e-8
near "energy error" "$(number 'energy error: .* = ')" 0 1e-12

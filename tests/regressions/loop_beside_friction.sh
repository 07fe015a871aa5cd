# SPDX-License-Identifier: GPL-3.0-or-later
# Runs of machines that switch were not brought back to their constraints, which were missed by more and more, as the square of time.
dalembert 0 simulate "$model" --no-plot -o out
near "pin_y" "$(last out/loop_beside_friction_full.csv r)" 0 1e-15

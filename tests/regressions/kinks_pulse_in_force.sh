# SPDX-License-Identifier: GPL-3.0-or-later
# A pulse of time in a force of the model was stepped over: the block stayed at rest, and the run ended as a success.
dalembert 0 simulate "$model" --no-plot
near "velocity behind the pulse" "$(last kinks_pulse_in_force_full.csv 'dot(x)')" 1 1e-8
near "path behind the pulse" "$(last kinks_pulse_in_force_full.csv x)" 4.989 1e-7

# SPDX-License-Identifier: GPL-3.0-or-later
# A blow of 1 ms in a force of the model was stepped over, in a machine with modes: friction held the block, as if nothing had struck it.
dalembert 0 simulate "$model" --no-plot
near "path" "$(last kinks_blow_and_friction_full.csv x)" 0.4995 1e-9
near "velocity at rest" "$(last kinks_blow_and_friction_full.csv 'dot(x)')" 0 0
grep -q "^6.01[01].*floor_stops_forwards" kinks_blow_and_friction_full_events.csv || fail "no stop at 6.011 s"

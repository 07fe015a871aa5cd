# SPDX-License-Identifier: GPL-3.0-or-later
# At its first dead centre the crank stood still without a word, and its energy was lost. Expected: an integration that starts anew behind each.
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 -o out
prints "37 events passed"
prints "energy lost at events: 0 J"
near "phi(3 s)" "$(last out/friction_at_dead_centres_full.csv phi)" 118.43451316 1e-8
near "dot(phi)(3 s)" "$(last out/friction_at_dead_centres_full.csv 'dot(phi)')" 30.85453131 1e-7

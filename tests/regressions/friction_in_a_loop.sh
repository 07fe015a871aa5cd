# SPDX-License-Identifier: GPL-3.0-or-later
# Friction within a loop: the run stopped at the first dead centre, "no mode can go on". Expected: integrations of one degree of freedom
# that start anew behind each dead centre.
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 -o out
near "energy lost" "$(number "energy lost at events: ")" 0 1e-12
near "phi(3 s)" "$(last out/friction_in_a_loop_full.csv phi)" 57.38801262 1e-8
near "dot(phi)(3 s)" "$(last out/friction_in_a_loop_full.csv 'dot(phi)')" 8.16586485 1e-7
# It comes to rest, and sticks.
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 --parameter f_N=20N --parameter f_p=200N -o out
prints "mode at the end: guide_.*sticks"
near "phi at rest" "$(last out/friction_in_a_loop_full.csv phi)" 6.79953232 1e-8
# Steps with larger errors miss constraints by more than a mode takes.
dalembert 0 simulate "$model" --no-plot --tolerance 1e-4 -o out
near "phi(3 s)" "$(last out/friction_in_a_loop_full.csv phi)" 57.388 1e-2

# SPDX-License-Identifier: GPL-3.0-or-later
# Bounces with friction stopped the run with "accumulation": the friction that turned round at the top of each had nothing that follows.
dalembert 0 simulate "$model" -o out --no-plot
expected=$(awk 'BEGIN { t = sqrt(0.125); v = 4*t; q = 0.5*sqrt(8/12); printf "%.15g", t + v*(1/12 + 1/sqrt(96))/(1 - q) }')
near 'closed form' "$expected" 0.7966255326 1e-10
near 'time of rest' "$(awk -F, 'END { print $1 }' out/bounce_with_friction_full_events.csv)" "$expected" 1e-10
near 'place' "$(last out/bounce_with_friction_full.csv x)" 0 0
near 'velocity' "$(last out/bounce_with_friction_full.csv "dot(x)")" 0 0
near 'force of the wall' "$(last out/bounce_with_friction_full.csv f_wall)" 10 1e-12

# SPDX-License-Identifier: GPL-3.0-or-later
# A profile as the normal force of friction was refused; a force that a profile switches on found no mode in which what had stuck slides.
dalembert 0 simulate "$model" -o out --no-plot
near 'time of rest' "$(awk -F, '/brake_sticks/ && !seen { print $1; seen = 1 }' out/brake_full_events.csv)" 1.4 1e-12
near 'angle at rest' "$(column out/brake_full.csv phi 1.9)" 9 1e-12
near 'rate at rest' "$(column out/brake_full.csv "dot(phi)" 1.9)" 0 0
near 'rate at the end' "$(last out/brake_full.csv "dot(phi)")" 5 1e-12

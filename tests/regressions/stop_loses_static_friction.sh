# SPDX-License-Identifier: GPL-3.0-or-later
# A block at a stop let go at sliding friction, and the stop bore friction too: modes whose constraints repeat each other were left out.
dalembert 0 simulate "$model" -o out --no-plot
prints "the force of each is not determined. 'floor' gets the part that 'wall' cannot carry"
near 'force of the wall at first' "$(column out/off_the_stop_full.csv f_wall 0)" 10 1e-12
near 'friction at first' "$(column out/off_the_stop_full.csv f_friction 0)" 0 1e-12
near 'force of the wall at 2.2 s' "$(column out/off_the_stop_full.csv f_wall 2.201)" 0 1e-12
near 'friction at 2.2 s' "$(column out/off_the_stop_full.csv f_friction 2.201)" -1 1e-9
near 'place at 2.39 s' "$(column out/off_the_stop_full.csv x 2.391)" 0 0
near 'time at which it slides' "$(awk -F, 'END { print $1 }' out/off_the_stop_full_events.csv)" 2.4 1e-12
near 'events' "$(awk 'END { print NR - 1 }' out/off_the_stop_full_events.csv)" 1 0
near 'place at 3 s' "$(last out/off_the_stop_full.csv x)" 0.36 1e-12

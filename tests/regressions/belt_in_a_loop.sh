# SPDX-License-Identifier: GPL-3.0-or-later
# Where the crank turns back, or the slider passes the belt, projection leaves a rounding of the rate, on the wrong side. The run stopped
# there at some tolerances: "accumulation". Expected: an integration of the crank's one degree of freedom (DOP853, 1e-13).
for tolerance in 1e-6 1e-7 1e-8 1e-9 1e-10 1e-11; do
    dalembert 0 simulate "$model" --no-plot --tolerance $tolerance -o out
    prints "mode at the end: bearing_sticks_and_belt_slides_backwards"
    near "phi at the end, tolerance $tolerance" "$(last out/belt_in_a_loop_full.csv phi)" 1.3248862983291598 1e-8
done
events=out/belt_in_a_loop_full_events.csv
at() { awk -F, -v name="$1" -v n="$2" '$2 ~ name && $1 > last + 1e-9 { last = $1; if (++k == n) print $1 }' $events; }
near "turns back" "$(at bearing_stops 1)" 0.391011676696 1e-9
near "reaches the belt" "$(at belt_stops 1)" 0.407610698027 1e-9
near "falls behind it" "$(at belt_stops 2)" 0.715601084637 1e-9
near "turns back again" "$(at bearing_stops 3)" 1.054701943509 1e-9
near "is carried along" "$(at belt_stops 3)" 1.114982864011 1e-9
near "breaks away" "$(at belt_breaks 1)" 1.292919926054 1e-9
near "comes to rest" "$(at bearing_stops 4)" 1.426259595409 1e-9

# SPDX-License-Identifier: GPL-3.0-or-later
# A normal force that falls to zero until its phase ends was taken for one that becomes negative: the run stopped there.
dalembert 0 simulate "$model" -o out --no-plot
near 'time of slip' "$(awk -F, '/clutch_breaks_forwards/ { print $1 }' out/clutch_full_events.csv)" 1.6666666666666667 1e-12
near 'rate where it is open' "$(column out/clutch_full.csv "dot(phi)" 2)" 0.7777777777777778 1e-12
near 'rate at the end' "$(last out/clutch_full.csv "dot(phi)")" 4.777777777777778 1e-11
near 'angle at the end' "$(last out/clutch_full.csv phi)" 2.876543209876543 1e-11
# One that goes on falling does become negative, and still stops the run.
sed 's#value = "2 - t/(1 s)", until = "2 s"#value = "2 - t/(1 s)", until = "2.5 s"#' "$model" >negative.toml
dalembert 4 simulate negative.toml -o out --no-plot
prints 'stopped at t = 2 s: the surfaces of friction .clutch. are pulled apart'

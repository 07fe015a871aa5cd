# SPDX-License-Identifier: GPL-3.0-or-later
# Six and more frictions were refused: each combination of their modes had code of its own, and there are 3^12 here.
TIMEFORMAT=%U
{ time dalembert 0 generate "$model" -o . >generated.txt; } 2>seconds
near 'processor time of generate' "$(cat seconds)" 0 10
prints 'everything proven'
[ "$(wc -c <twelve_blocks_full.hpp)" -lt 500000 ] || fail 'the header is longer than 500 kB'
dalembert 0 simulate "$model" --no-plot
csv=twelve_blocks_full.csv
for stays in 1:0.1 2:0.06 3:-0.04 4:-0.12 5:-0.02 6:0.08 7:0.08 8:-0.02 9:-0.12 10:-0.04 11:0.06; do
  near "block ${stays%:*} stays" "$(last $csv "x_${stays%:*}")" "${stays#*:}" 1e-12
  near "block ${stays%:*} sticks" "$(last $csv "dry_${stays%:*}_direction")" 0 0
done
near 'friction that holds block 1' "$(last $csv f_1)" 0.1 1e-12
# Block 12 has made four half swings, to 0.16 m, and makes its fifth about 0.13 m.
near 'block 12' "$(last $csv x_12)" "$(awk 'BEGIN { pi = atan2(0, -1); r = sqrt(12); printf "%.16g", 0.13 + 0.03*cos((50 - 4*pi*r)/r) }')" 1e-12
times=$(awk -F, '$2 == "dry_4_stops_backwards" { print $1; exit }' twelve_blocks_full_events.csv)
near 'block 4 stops first' "$times" 6.283185307179586 1e-9

# SPDX-License-Identifier: GPL-3.0-or-later
# Steady heat without sources was not exact in bars of varying area, though it is promised of rods.
dalembert 0 evaluate "$model"
near "wedge, first" "$(number '^  wedge_first +')" 2.16404256133345 1e-13
near "wedge, last" "$(number '^  wedge_last +')" 2.16404256133345 1e-13
for place in cone_first cone_last cells_first cells_last; do
  near "$place" "$(number "^  $place +")" 2 1e-13
done
near "dot(T[2])" "$(number '^  rest +')" 0 1e-15
dalembert 0 check "$model" --size N=3
prints '^  emitted code = derivation +[0-9]+ proven$'

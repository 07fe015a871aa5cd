# SPDX-License-Identifier: GPL-3.0-or-later
# tier: full
# Frictions with a state in place of modes, beside a contact and a saturation: the first row of a run had what holds a block that cannot be held.
dalembert 0 simulate "$model" --no-plot
near 'energy error' "$(number 'energy error: .* = ')" 0 1e-12
near 'friction of the block that is let go' "$(column five_blocks_full.csv F_2 0)" 1.962 1e-12
for k in 2 3; do
  # The block alone has modes.
  awk -v k=$k '{ name = $1 } name ~ /_[1-5]$/ && name !~ "_" k "$" { next } { sub(/"five_blocks"/, "\"alone_" k "\""); print }' "$model" >alone.toml
  dalembert 0 simulate alone.toml --no-plot
  prints 'mode at the end'
  for t in 0 0.5 1.3 2.2 3.1 5; do
    for quantity in "x_$k" "dot(x_$k)" "F_$k"; do near "$quantity at $t s" "$(column five_blocks_full.csv "$quantity" $t)" "$(column alone_${k}_full.csv "$quantity" $t)" 1e-11; done
  done
done

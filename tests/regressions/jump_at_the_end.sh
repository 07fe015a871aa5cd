# SPDX-License-Identifier: GPL-3.0-or-later
# An input that jumps at the end of the run: the last step had a stage behind the jump, and the state lost six digits.
# x = exp(-t/T) + T*(1 - exp(-150 s/T))*(1 + exp(-300 s/T)) for both spans of 150 s, the last of which ends with the run.
dalembert 0 simulate "$model" --no-plot
expected=$(awk 'BEGIN { printf "%.15g", exp(-1) + 600 * (1 - exp(-0.25)) * (1 + exp(-0.5)) }')
digits "x(600 s)" "$(last jump_at_the_end_full.csv x)" "$expected" 12

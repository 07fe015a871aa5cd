# SPDX-License-Identifier: GPL-3.0-or-later
# With a radiosity as an output, code was not made within minutes: its slopes by parameters, which no code asks for, were written out.
dalembert 0 evaluate "$model"
near "J_1" "$(number '^  J_1 +')" 1027.1337438908 1e-9
near "J_3" "$(number '^  J_3 +')" 616.103195976261 1e-9
near "G_2" "$(number "^  G_2 +")" 726.979567275 1e-8
limit=60 dalembert 0 generate "$model" -o out
prints 'everything proven'

# SPDX-License-Identifier: GPL-3.0-or-later
# Where no diode takes the current of an inductor over, the run stops; it did not say which current that is.
dalembert 4 simulate "$model" --no-plot -o out
prints "no mode at t = 0.001000 s: no mode can go on after event 'S_opens' in mode 'S_closed_and_D_blocks'; in mode 'S_open_and_D_blocks' the current of inductor 'L_1' has no path"
# A current that is not zero is not one of this mode.
dalembert 0 evaluate "$model" --state i=0.5 --mode S_open_and_D_blocks --time 2e-3
prints "warning: the state is not in mode 'S_open_and_D_blocks': the current of 'L_1' is 0.5 A and has no path"
# `mod` was missing in C: models with it could not be exported.
dalembert 0 export "$model" --to c -o out

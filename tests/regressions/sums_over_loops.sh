# SPDX-License-Identifier: GPL-3.0-or-later
# Outputs of a rod whose cells are computed in loops could not name sums over them: the mean temperature, internal_energy, exchanged_power.
# Without heat through the ends the mean rises by q*t/(rho*c_p), from 300 K + 10001/200 K; the energy counts from 0 K.
dalembert 0 simulate "$model" -o .
near "the mean" "$(last big_full.csv mean)" 352.7153943623797 1e-8
near "the energy" "$(last big_full.csv E)" 130134.34475 1e-5
near "the power" "$(last big_full.csv P)" 10 1e-10

# SPDX-License-Identifier: GPL-3.0-or-later
# Orifices that switch multiplied: more than three of them were refused.
dalembert 0 simulate "$model" --no-plot
prints "'o_1', .*'o_12' bring no modes"
tau=$(awk 'BEGIN { k = 1.4; psi = sqrt(k/(k + 1))*(2/(k + 1))^(1/(k - 1)); printf "%.15g", 0.04/(12*0.8*1e-6*sqrt(2*287*293.15)*psi) }')
near 'pressure after 10 s' "$(column twelve_orifices_full.csv p 10)" "$(awk -v tau="$tau" 'BEGIN { printf "%.15g", 1e6*exp(-10/tau) }')" 0.1
near 'pressure after 20 s' "$(last twelve_orifices_full.csv p)" "$(awk -v tau="$tau" 'BEGIN { printf "%.15g", 1e6*exp(-20/tau) }')" 0.1

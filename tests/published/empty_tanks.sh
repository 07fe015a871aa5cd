# SPDX-License-Identifier: GPL-3.0-or-later
# EmptyTanks of Modelica.Fluid, with the pipe as an orifice; numbers of oracles/empty_tanks.py, closed forms.
dalembert 0 simulate "$model" --no-plot
csv=empty_tanks_full.csv
digits "h(10 s) of the upper tank" "$(column $csv upper_h 10)" 0.622352069647554724 8
digits "h(20 s) of the upper tank" "$(column $csv upper_h 20)" 0.29329742473911760259 8
digits "h(25 s) of the upper tank" "$(column $csv upper_h 25)" 0.15703158269963645854 8
digits "upper tank empty, s" "$(tail -1 empty_tanks_full_events.csv | cut -d, -f1)" 31.96239407538260568 8
digits "h(50 s) of the lower tank" "$(last $csv lower_h)" 1 8

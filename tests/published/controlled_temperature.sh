# SPDX-License-Identifier: GPL-3.0-or-later
# ControlledTemperature of the Modelica Standard Library; numbers of oracles/controlled_temperature.py, integrated with 25 digits.
dalembert 0 simulate "$model" --no-plot
events=controlled_temperature_full_events.csv
at() { sed -n "$(($1 + 1))p" $events | cut -d, -f1; }
digits "first switching off, s" "$(at 1)" 0.6264240706972657 8
digits "first switching on, s" "$(at 2)" 2.262649876272635 8
digits "tenth switching, s" "$(at 10)" 5.669729027171027 8
digits "last switching on, s" "$(at 18)" 9.955832934299127 8
digits "T(10 s)" "$(last controlled_temperature_full.csv resistor_T)" 322.4177072555591 8
[ "$(wc -l <$events)" -eq 19 ] || fail "there are not 18 switchings"

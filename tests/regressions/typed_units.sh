# SPDX-License-Identifier: GPL-3.0-or-later
# Numbers in [runs] and on the command line counted in SI: T_out = 5 in degC was 5 K, p_s = 150 in bar was 150 Pa.
# tier: full
dalembert 0 simulate "$model" --run reference --no-plot -o si
near "T in K" "$(last si/typed_units_full.csv T)" 283.668191617571635 1e-6
near "push in N" "$(last si/typed_units_full.csv push)" 1500 1e-9
dalembert 0 simulate "$model" --run units --no-plot --units declared -o declared
near "T in degC" "$(last declared/typed_units_full.csv T)" 10.518191617571635 1e-6
near "push in kN" "$(last declared/typed_units_full.csv push)" 1.5 1e-12
head -1 declared/typed_units_full.csv | grep -q 'T \[degC\],.*push \[kN\]' || fail "the heading does not name declared units"

# value NAME: what evaluate printed for it
value() { awk -v name="$1" '$1 == name { print $2 }' printed; }
dalembert 0 evaluate "$model" --parameter p_s=150 --input T_out=5 --state T=25
near "push" "$(value push)" 1500 1e-9
near "T_out" "$(value T_out)" 278.15 1e-9
near "T" "$(value T)" 298.15 1e-9
dalembert 0 evaluate "$model" --parameter 'p_s=2*75,alpha=1.5 rad' --input 'T_out=-5 degC' --state 'T=300 K'
near "push of 2*75 bar" "$(value push)" 1500 1e-9
near "T_out of -5 degC" "$(value T_out)" 268.15 1e-9
near "T of 300 K" "$(value T)" 300 1e-9
dalembert 0 evaluate "$model" --parameter 'p_s=100 + 50*cos(0),alpha=asin(1/2)' --input T_out=0
near "push of a sum" "$(value push)" 1500 1e-9
near "lift at an angle of arcsin" "$(value lift)" 0.5 1e-12
near "T_out of 0 degC" "$(value T_out)" 273.15 1e-9
dalembert 0 generate "$model" --fix p_s=150 -o fixed
grep -q 'Fixed: p_s = 15000000 kg/(m\*s^2)\|Fixed: p_s = 15000000 Pa' fixed/typed_units_full.hpp || fail "--fix p_s=150 is not 150 bar"

# Both sides of what disagrees are named.
dalembert 2 evaluate "$model" --input T_out=5 --parameter 'p_s=150 N'
prints "the value of 'p_s' must be in .*Pa.*, but '150 N' is in"
dalembert 2 evaluate "$model" --input T_out=5 --parameter 'p_s=3*(2 s)'
prints "the value of 'p_s' must be in .*Pa.*, but '3\*\(2 s\)' is in 's'"
# What is left out is not 0 K.
dalembert 2 evaluate "$model"
prints "the input 'T_out' has no value"
dalembert 2 simulate "$model" --run none
prints "the model has no run 'none'"

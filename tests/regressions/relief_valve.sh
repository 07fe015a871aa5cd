# SPDX-License-Identifier: GPL-3.0-or-later
# A relief valve is shut up to the cracking pressure, opens linearly over the override, and is an orifice beyond.
dalembert 0 check "$model"
prints 'shut +(proven|numerically equal)'
prints 'partly open +(proven|numerically equal)'
prints '^ *open +(proven|numerically equal)'
prints_not 'wrong'
dalembert 0 simulate "$model" --no-plot
csv=relief_valve_full.csv
# where 0.6*20e-6*x/20e5*sqrt(2*(200e5 + x)*rho) is rho_0*Q with rho = rho_0*exp((200e5 + x)/1.5e9), by bisection
near 'pressure at rest' "$(last $csv p)" 20602436.505 20
near 'mass flow at rest' "$(last $csv m_v)" 0.566666667 1e-6
# the motion meets both edges of the law: more than the open valve takes drives it beyond
dalembert 0 simulate "$model" --no-plot --parameter 'Q=200 l/min' --until 2
sed 's/^override_pressure = "p_o"/override_pressure = "p_c - (210 bar)"/' "$model" >wrong.toml
dalembert 2 generate wrong.toml -o out
prints "the override pressure of flow 'valve' is -1e\\+06 Pa at the start, but must be above zero"

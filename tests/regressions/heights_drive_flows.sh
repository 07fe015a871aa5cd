# SPDX-License-Identifier: GPL-3.0-or-later
# The potential of a volume drove the flow in a pipe, but not that of orifices, laminar flows and check valves.
output() { near "$1" "$(number "^  $1 +")" "$2" "$3"; }

dalembert 0 evaluate "$model" --mode gate_shut
output q_orifice 0.0626418390534633 1e-15
output q_smooth 0.0626418390534633 1e-9
output q_laminar 0.01962 1e-15
output q_valve 0.0626418390534633 1e-15
output q_sprung 0.01 1e-15
output q_back 0 0
output q_down 0.01962 1e-15
output 'dot\(v\)' 9.81 1e-14
# What falls 2 m through what resists becomes heat: rho*g*z times the sum of the flows, the spring of the valve with them.
output exchanged_power -4845.65964588866 1e-8
dalembert 0 evaluate "$model" --mode gate_open
output 'dot\(h\[2\]\)' 0.237165517119708 1e-14
dalembert 0 derive "$model"
prints '^  gate_opens: -z\*rho\*g - rho\*g\*h\[1\] \+ rho\*g\*h\[2\]'

dalembert 0 check "$model"
prints '^  balances of mass and energy +10 proven'
prints '^  d\(T \+ V \+ E\)/dt = supplied - dissipated \+ exchanged +1 proven'

# SPDX-License-Identifier: GPL-3.0-or-later
# Places without volume had to be stiff volumes; as junctions their pressures and flows are those of closed forms.
dalembert 0 check "$model"
prints "balances of mass and energy +29 proven"
prints_not "wrong"
dalembert 0 simulate "$model" --no-plot
csv=junctions_full.csv
expect() { near "$1" "$(last $csv "$1")" "$2" "$3"; }
expect p_left 210000 1e-5
expect p_right 230000 1e-5
expect m_bridge -0.08 1e-12
expect p_series 180000 1e-5
expect m_series 0.0678822509939085636 1e-12
expect p_mixed 250000 1e-5
expect m_mixed 0.2 1e-12
expect p_star 100000 1e-5
expect m_one 0.12 1e-12
expect m_two -0.08 1e-12
expect m_three 0.04 1e-12
expect p_pumped 100000 1e-5
expect P_pump 10 1e-9
expect p_inertial 500000 1e-3
expect v 3.53553390593273762 1e-9
expect p_siphon -78480 1e-5
expect "p_chain[1]" 200000 1e-5
expect "p_chain[2]" 100000 1e-5
expect p_before 120000 1e-5
expect p_fork 80000 1e-5
expect m_fork 0 1e-12

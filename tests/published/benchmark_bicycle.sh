# SPDX-License-Identifier: GPL-3.0-or-later
# Benchmark bicycle, eigenvalues of steady motion: Table 2 of Meijaard et al. 2007 at 5 m/s, numbers of oracles/benchmark_bicycle.py at 8 m/s.
# tier: full
limit=900
eigenvalues() { awk -F'[:,]' '/"eigenvalue": \{/ { wanted = 1 } /"eigenvalues": \[/ { wanted = 99 } /"real"/ { re = $2 } /"imaginary"/ && wanted > 0 { print re + 0 == 0 ? 0 : re, $2; --wanted }' printed >eigenvalues; }
value() { awk -v least="$1" -v most="$2" -v of="$3" '$1 > least && $1 < most && $2 >= 0 { print $of; exit }' eigenvalues; }
dalembert 0 modal "$model" --format json
eigenvalues
digits "capsize at 5 m/s" "$(value -0.5 -0.1 1)" -0.32286642900 9
digits "weave at 5 m/s" "$(value -1 -0.6 1)" -0.77534188220 9
digits "frequency of weave at 5 m/s" "$(value -1 -0.6 2)" 4.46486771379 9
digits "castering at 5 m/s" "$(value -20 -10 1)" -14.0783896928 9
dalembert 0 equilibrium "$model" --parameter v=8 --moving x,theta_R,theta_F --format json
eigenvalues
digits "capsize at 8 m/s" "$(value 0.1 0.2 1)" 0.14327879765712949831 9
digits "weave at 8 m/s" "$(value -3 -2 1)" -2.6934868358109477186 9
digits "frequency of weave at 8 m/s" "$(value -3 -2 2)" 8.4603797139693359008 9
digits "castering at 8 m/s" "$(value -30 -10 1)" -20.279408943945662988 9

# SPDX-License-Identifier: GPL-3.0-or-later
# A steady motion on constraints, holonomic and not, had no linearisation: this is the benchmark of bicycles.
# tier: full
limit=600
dalembert 0 equilibrium "$model" --moving x,theta_R,theta_F --format json
sed -n '/"eigenvalues"/,$p' printed | awk -F'[:,]' '/"real"/ { re = $2 } /"imaginary"/ { im = $2 } re != "" && im != "" { print re + 0 == 0 ? 0 : re, im; re = im = "" }' >eigenvalues
value() { awk -v least="$1" -v most="$2" -v of="$3" '$1 > least && $1 < most && $2 >= 0 { print $of; exit }' eigenvalues; }
near "capsize" "$(value -0.5 -0.1 1)" -0.32286642900 1e-9
near "weave" "$(value -1 -0.6 1)" -0.77534188220 1e-9
near "frequency of weave" "$(value -1 -0.6 2)" 4.46486771379 1e-9
near "castering" "$(value -20 -10 1)" -14.0783896928 1e-8

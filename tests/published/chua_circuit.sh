# SPDX-License-Identifier: GPL-3.0-or-later
# ChuaCircuit of the Modelica Standard Library; numbers of oracles/chua_circuit.py, matrix exponentials from kink to kink, with 40 digits.
# tier: full
dalembert 0 simulate "$model" --no-plot
csv=chua_circuit_full.csv
digits "u_1(1000 s)" "$(last $csv u_1)" -3.6162425313937671013 8
digits "u_2(1000 s)" "$(last $csv u_2)" -0.11757233037297405391 8
digits "i(1000 s)" "$(last $csv i)" -3.2969288319372657735 8

# SPDX-License-Identifier: GPL-3.0-or-later
# TwoMasses of the Modelica Standard Library: T_a = 323.15 K + 50 K exp(-4/3 t/s), closed form.
dalembert 0 simulate "$model" --no-plot
csv=two_masses_full.csv
digits "T_a(1 s)" "$(last $csv T_a)" 336.3298569057863 10
digits "T_b(1 s)" "$(last $csv T_b)" 309.9701430942137 10

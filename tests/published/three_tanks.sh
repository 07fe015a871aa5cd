# SPDX-License-Identifier: GPL-3.0-or-later
# ThreeTanks of Modelica.Fluid, with the pipes as orifices that are smooth within 1 Pa; numbers of oracles/three_tanks.py, Radau IIA, and its closed form of rest.
dalembert 0 simulate "$model" --no-plot
csv=three_tanks_full.csv
digits "h_1(20 s)" "$(column $csv h_1 20)" 6.9877024967977395 8
digits "h_2(20 s)" "$(column $csv h_2 20)" 3.186804937749738 8
digits "h_3(20 s)" "$(column $csv h_3 20)" 3.825492499016126 8
digits "h_1(100 s)" "$(column $csv h_1 100)" 4.295763889173179 8
digits "h_2(100 s)" "$(column $csv h_2 100)" 3.6094645072605007 8
digits "h_3(100 s)" "$(column $csv h_3 100)" 6.094771471931758 8
digits "h_1(200 s), at rest" "$(last $csv h_1)" 3.6666666194983994 8
digits "h_3(200 s), at rest" "$(last $csv h_3)" 6.6666666194983994 8

# SPDX-License-Identifier: GPL-3.0-or-later
# Cart with two poles; numbers of oracles/double_cart_pole.py, closed form and an explicit method of order 8.
dalembert 0 simulate "$model" --no-plot
csv=double_cart_pole_full.csv
digits "x(3 s)" "$(last $csv x)" 0.9102263375333229 8
digits "phi_1(3 s)" "$(last $csv phi_1)" 2.405905572009234 8
digits "phi_2(3 s)" "$(last $csv phi_2)" 32.36747218434672 8
digits "dot(x)(3 s)" "$(last $csv 'dot(x)')" -1.104627905994567 8
digits "dot(phi_1)(3 s)" "$(last $csv 'dot(phi_1)')" -8.379061556245096 8
digits "dot(phi_2)(3 s)" "$(last $csv 'dot(phi_2)')" 15.121534609786373 8

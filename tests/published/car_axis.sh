# SPDX-License-Identifier: GPL-3.0-or-later
# Car axis: IVP test set, reference computed there with a tolerance near rounding.
dalembert 0 simulate "$model" --no-plot
csv=car_axis_full.csv
digits "x_l(3 s)" "$(last $csv x_l)" 0.04934557842755629 8
digits "y_l(3 s)" "$(last $csv y_l)" 0.4969894602303324 8
digits "x_r(3 s)" "$(last $csv x_r)" 1.041742524885400 8
digits "y_r(3 s)" "$(last $csv y_r)" 0.3739110272652214 8
digits "dot(x_l)(3 s)" "$(last $csv 'dot(x_l)')" -0.07705836840321485 8
digits "dot(y_l)(3 s)" "$(last $csv 'dot(y_l)')" 0.007446866596327776 8
digits "dot(x_r)(3 s)" "$(last $csv 'dot(x_r)')" 0.01755681574942899 8
digits "dot(y_r)(3 s)" "$(last $csv 'dot(y_r)')" 0.7703410437794031 8

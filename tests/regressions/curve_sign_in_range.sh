# SPDX-License-Identifier: GPL-3.0-or-later
# The sign of a conductivity by a curve was not looked at. It counts where temperatures can be: in the range of the cells and up to what
# surrounds an end.
dalembert 0 check "$model"
sed 's/80 degC/200 degC/' "$model" >hot.toml
dalembert 2 check hot.toml
prints "the conductivity of rod 'bar' is -0.2 W/.m.K. where curve 'k' is taken at T = 200 degC, but must be above zero"
sed 's/, range = .0, 100.//' "$model" >anywhere.toml
dalembert 2 check anywhere.toml
prints "is -0.4 W/.m.K. where curve 'k' is taken at T = 250 degC"
sed 's/straight/held/' anywhere.toml >held.toml
dalembert 0 check held.toml

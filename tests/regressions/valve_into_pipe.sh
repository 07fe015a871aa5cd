# SPDX-License-Identifier: GPL-3.0-or-later
# The flow through the pipe was the difference of two large numbers: no digit was left with the valve nearly shut. `surplus` had the unit J.
dalembert 0 check "$model"
prints_not "wrong"
# q = r*s with r*s + G*s^2 = G*rho*g*h and r = 0.7*A_v*y*sqrt(2/rho).
dalembert 0 evaluate "$model" --input y=1e-9 --digits 16
digits "q nearly shut" "$(number ' q ')" 1.240245136690664472e-12 14
dalembert 1 accuracy "$model" --points 200
prints "^  rhs +1 +[0-7]([.][0-9]+)? "
prints "^  output +2 +[0-7]([.][0-9]+)? "

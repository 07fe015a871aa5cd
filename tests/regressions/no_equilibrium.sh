# SPDX-License-Identifier: GPL-3.0-or-later
# "No equilibrium" did not say which state moves on, and where.
dalembert 4 equilibrium "$model"
prints "largest .dx/dt. left 9.81: 'dot\(y\)' changes by -9.81 m/s a second, where it is 0 m/s$"

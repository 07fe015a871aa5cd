# SPDX-License-Identifier: GPL-3.0-or-later
# Beyond the points of a curve with outside = "error" runs end, but equilibrium, evaluate, modal, optimise and study said nothing of it.
dalembert 0 equilibrium "$model"
prints "warning.value-out-of-range.: curve 'spring_force' is taken at u = 39.1489 mm, above its last point at 20 mm"
dalembert 0 equilibrium "$model" --parameter F=10
prints_not "warning"
dalembert 0 evaluate "$model" --state x=-30
prints "curve 'spring_force' is taken at u = -30 mm, below its first point at -20 mm"
dalembert 0 evaluate "$model"
prints_not "warning"
dalembert 0 modal "$model" --state x=26
prints "curve 'spring_force' is taken at u = 26 mm, above its last point"
dalembert 4 optimise "$model" --maximise y --over F=0:100 --points 5
prints "the run does not reach its end: the argument of curve 'spring_force' is about to rise above its last point"
dalembert 0 study "$model" --vary F=0:100:3 -o . --no-plot
prints "left the model at spring_force  *2"

# SPDX-License-Identifier: GPL-3.0-or-later
# Places and velocities of bodies could not stand in definitions, angular velocities not in constraints, places not in stops.
dalembert 0 check "$model"
dalembert 0 simulate "$model" --no-plot --tolerance 1e-11 -o .
csv=places_full.csv
near "phi(1 s)" "$(last $csv phi)" 1 1e-9
near "psi(1 s)" "$(last $csv psi)" -0.5 1e-9
near "height" "$(last $csv difference)" 0 1e-12
# 80*(0.5*sin(0.3))^2/2 + 2*9.81*0.25*sin(0.3)
near "energy of the arm" "$(last $csv energy)" 2.3228485 1e-6
near "h(0.3 s)" "$(column $csv h 0.3)" 0.55855 1e-9
near "h(1 s)" "$(last $csv h)" 0 1e-12
near "fallen" "$(last $csv fallen)" 1 1e-8

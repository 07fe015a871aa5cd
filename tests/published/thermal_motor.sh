# SPDX-License-Identifier: GPL-3.0-or-later
# HeatTransfer Motor of the Modelica Standard Library; numbers of oracles/thermal_motor.py, matrix exponentials with 30 digits.
# tier: full
dalembert 0 simulate "$model" --no-plot
csv=thermal_motor_full.csv
digits "T of the winding at 6000 s" "$(column $csv winding_T 6000)" 407.09320749162405917 8
digits "T of the core at 6000 s" "$(column $csv core_T 6000)" 332.23405476565710765 8
digits "T of the winding at 7200 s" "$(last $csv winding_T)" 407.47926145998272652 8
digits "T of the core at 7200 s" "$(last $csv core_T)" 332.4702733560368619 8

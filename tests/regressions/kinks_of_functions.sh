# SPDX-License-Identifier: GPL-3.0-or-later
# step, ramp, pulse, mod and if were no functions of the language; their kinks and jumps, of time and of states, are located.
dalembert 0 simulate "$model" --no-plot
result=kinks_of_functions_full.csv
near x "$(last $result x)" 1.75 1e-9
near teeth "$(last $result teeth)" 0.25 1e-9
near blows "$(last $result blows)" 7 1e-8
near slope "$(last $result slope)" 0.5 1e-9
near ons "$(last $result ons)" 0.75 1e-9
near late "$(last $result late)" 0.5 1e-9

# SPDX-License-Identifier: GPL-3.0-or-later
# Stiff flyball governor, IFToMM benchmark A05; numbers of oracles/flyball_governor.py, another formulation with three coordinates.
dalembert 0 simulate "$model" --no-plot
csv=flyball_governor_full.csv
digits "psi(10 s)" "$(last $csv psi)" 55.93540990910253 8
digits "s(10 s)" "$(last $csv s)" 0.6196229170613642 8
digits "alpha_1(10 s)" "$(last $csv alpha_1)" 0.3900737018446464 8
digits "dot(psi)(10 s)" "$(last $csv 'dot(psi)')" 5.548203622654931 8
digits "dot(s)(10 s)" "$(last $csv 'dot(s)')" -0.7476033541643159 8
digits "dot(alpha_1)(10 s)" "$(last $csv 'dot(alpha_1)')" 0.808467051345568 8

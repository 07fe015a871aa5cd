# SPDX-License-Identifier: GPL-3.0-or-later
# Bricard's mechanism, IFToMM benchmark A04; numbers of oracles/bricard.py, the one motion that the loop leaves, by Newton-Euler equations.
dalembert 0 simulate "$model" --no-plot
csv=bricard_full.csv
digits "q_1(5 s)" "$(column $csv q_1 5)" -0.2302151763160 8
digits "q_2(5 s)" "$(column $csv q_2 5)" -0.3001365737008 8
digits "q_1(10 s)" "$(last $csv q_1)" -0.4620106319148 8
digits "q_2(10 s)" "$(last $csv q_2)" -2.2072035133244 8
digits "q_5(10 s)" "$(last $csv q_5)" 0.4620106319148 8

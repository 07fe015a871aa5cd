# SPDX-License-Identifier: GPL-3.0-or-later
# A series about a point of a curve is that of one side. Where the motion goes to the other, the end of the step must tell, also where the
# next point cuts it.
dalembert 0 simulate "$model" --no-plot -o . --tolerance 1e-12 --method dop853
expected=$(last knot_at_start_full.csv x)
dalembert 0 simulate "$model" --no-plot -o . --tolerance 1e-12 --method taylor
near "position at the end by series" "$(last knot_at_start_full.csv x)" "$expected" 1e-11

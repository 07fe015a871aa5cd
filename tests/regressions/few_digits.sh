# SPDX-License-Identifier: GPL-3.0-or-later
# The volume of a stiff junction at rest hardly matters: the rates of its sensitivities are differences of terms that agree to all digits
# that rounding leaves. No step was so short that its error was small enough, and the run did not come to its end. In exact numbers the
# levels do not depend on it, and the volume in the junction follows it.
limit=100
dalembert 0 simulate "$folder/../published/three_tanks.toml" --sensitivities V_0 --samples 100 --no-plot
csv=three_tanks_full_sensitivities.csv
near "dV_j/dV_0" "$(last $csv 'd(V_j)/d(V_0)')" 1 1e-6
# Beside h/V_0 of 60 to 160 m/m^3.
for level in h_1 h_2 h_3; do near "d$level/dV_0" "$(last $csv "d($level)/d(V_0)")" 0 1e-3; done

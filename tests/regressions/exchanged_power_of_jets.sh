# SPDX-License-Identifier: GPL-3.0-or-later
# In an output exchanged_power was 0 of a machine with jets, while the header's function was right.
dalembert 0 evaluate "$model"
near "the output" "$(number '^  P_ex +')" -19012500 1e-6
near "the power" "$(number '^  exchanged_power +')" -19012500 1e-6

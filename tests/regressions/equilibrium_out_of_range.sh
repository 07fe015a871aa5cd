# SPDX-License-Identifier: GPL-3.0-or-later
# An equilibrium was found far below the declared range, without a warning. Within the range there is none.
dalembert 0 equilibrium "$model" --input i=5
prints_not "warning"
dalembert 0 equilibrium "$model" --input i=25
prints "warning.value-out-of-range.: the value of 'T' is -[0-9.]+ K, but its range begins at 223.15 K"
# Without a range absolute zero remains a bound.
sed 's/ range = \[-50, 250\],//' "$model" >without_range.toml
dalembert 0 equilibrium without_range.toml --input i=25
prints "warning.value-out-of-range.: node 'winding' is at -[0-9.]+ K, below absolute zero"

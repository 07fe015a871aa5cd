# SPDX-License-Identifier: GPL-3.0-or-later
# A wrong product of many sums was multiplied out, twice: no answer in minutes, where numbers decide.
limit=60
for n in 20 200; do
  { printf '[catalogue]\nformat = 1\nsource = "products"\ndimensionless = true\n[letters]\n'
    for ((i = 0; i < n; i++)); do printf 'x_%d = "1"\n' $i; done
    printf '[entries.right]\nlatex = """'
    for ((i = 0; i < n; i++)); do printf '(x_{%d} + 1) ' $i; done; printf '= '
    for ((i = n - 1; i >= 0; i--)); do printf '(1 + x_{%d}) ' $i; done
    printf '"""\n[entries.wrong]\nequation = "'
    for ((i = 0; i < n; i++)); do printf '%s(x_%d + 1)' "$([ $i -eq 0 ] || echo '*')" $i; done; printf ' = '
    for ((i = 0; i < n; i++)); do printf '%s(x_%d + 2)' "$([ $i -eq 0 ] || echo '*')" $i; done
    printf '"\n'
  } >product.toml
  dalembert 1 check product.toml
  prints '^  right +proven$'
  prints '^  wrong +wrong$'
done

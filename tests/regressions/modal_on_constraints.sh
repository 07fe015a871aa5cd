# SPDX-License-Identifier: GPL-3.0-or-later
# Modal forms of machines with constraints were refused, and eigenvalues of coordinates on a gear came with zeros that no motion has.
# tier: full
limit=600
dalembert 0 modal "$model" --scene skate
prints "^independent coordinates: 'x' and 'theta'"
prints "^also free, with the eigenvalues 0 1/s: 'y'"
prints '^  4    -1\.9355 '
dalembert 0 modal "$model" --scene wheels
near "angular frequency" "$(number '^  [0-9]+ +\+-')" 6.32456 1e-4
dalembert 0 equilibrium "$model" --scene wheels
prints "free states under the constraints"
near "angular frequency" "$(number '^ +-?0 \+')" 6.32456 1e-5

# SPDX-License-Identifier: GPL-3.0-or-later
# A start at rest was no equilibrium: accelerations that are zero but for rounding were scaled up.
# tier: full
limit=600
dalembert 0 equilibrium "$model"
prints "an isolated equilibrium"
prints "free states under the constraints: 'phi' and 'dot\(phi\)'"
near "angular frequency" "$(number '^ +-?0 \+')" 3.74357 1e-5
dalembert 0 modal "$model"
prints "independent coordinates: 'phi';"
near "angular frequency by modal" "$(number '^  1 +\+-')" 3.74357 1e-4

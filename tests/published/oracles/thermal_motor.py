# SPDX-License-Identifier: GPL-3.0-or-later
# The linear equations of thermal_motor.toml by matrix exponentials, from one change of the losses to the next; temperatures count from 293.15 K:
# 2500 dw/dt = P (1 + alpha (w - 75)) - 10 (w - c), 25000 dc/dt = 500 + 10 (w - c) - 25 c.
from mpmath import mp, mpf, matrix, expm

mp.dps = 30
alpha = mpf("3.03e-3")
x = matrix([0, 0, 1])
marks = {}
for period in range(12):
    for duration, P in ((360, 100), (240, 1000)):
        A = matrix([[(P * alpha - 10) / 2500, mpf(10) / 2500, P * (1 - 75 * alpha) / 2500],
                    [mpf(10) / 25000, mpf(-35) / 25000, mpf(500) / 25000], [0, 0, 0]])
        x = expm(A * duration) * x
        print(600 * period + (360 if P == 100 else 600), "s: winding", mp.nstr(x[0] + mpf("293.15"), 20), "core", mp.nstr(x[1] + mpf("293.15"), 20))

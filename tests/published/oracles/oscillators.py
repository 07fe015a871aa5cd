# SPDX-License-Identifier: GPL-3.0-or-later
# The linear equations of oscillators.toml by matrix exponentials, with sine and cosine of the force as states; x = s + 0.5 m, from the rest of the
# springs: d2x/dt2 = f - d dx/dt - 10000 (x + 0), whose springs are at rest where s + 0.5 m = 0.
from mpmath import mp, mpf, matrix, expm, pi

mp.dps = 30
omega = 2 * pi * mpf("15.9155")
for name, d in (("free", 0), ("damped", 10)):
    A = matrix([[0, 1, 0, 0], [-10000, -d, 1, 0], [0, 0, 0, omega], [0, 0, -omega, 0]])
    x = expm(A) * matrix([0, 0, 0, 1])
    print(name, "s, v at 1 s:", mp.nstr(x[0] - mpf("0.5"), 20), mp.nstr(x[1], 20))

# SPDX-License-Identifier: GPL-3.0-or-later
# The linear equations of first_drive_train.toml by one matrix exponential, with sine and cosine of the drive as states:
# (2 + 10^2 0.1) d2(phi_2)/dt2 = 10 M - 10 dphi_2/dt - c (phi_2 - phi_3), 2 d2(phi_3)/dt2 = c (phi_2 - phi_3).
from mpmath import mp, mpf, matrix, expm, pi

mp.dps = 30
c, omega, J = mpf(10000), 10 * pi, mpf(12)
A = matrix([[0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [-c / J, c / J, -10 / J, 0, mpf(100) / J, 0], [c / 2, -c / 2, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, omega], [0, 0, 0, 0, -omega, 0]])
x = expm(A) * matrix([0, 0, 0, 0, 0, 1])
print("phi_2, phi_3, w_2, w_3 at 1 s:", *(mp.nstr(x[k], 20) for k in range(4)))

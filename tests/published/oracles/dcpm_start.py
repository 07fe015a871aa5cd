# SPDX-License-Identifier: GPL-3.0-or-later
# The linear equations of dcpm_start.toml by matrix exponentials: L di/dt = u - R i - k w, J dw/dt = k i - M.
from mpmath import mp, mpf, matrix, expm, pi

mp.dps = 30
U, R, L, J = mpf(100), mpf("0.05"), mpf("0.0015"), mpf("0.3")
k = (U - R * 100) / (1425 * 2 * pi / 60)
# states i, w, phi; and u, du/dt, M, which are constant or grow steadily in each phase
A = matrix([[-R / L, -k / L, 0, 1 / L, 0, 0], [k / J, 0, 0, 0, 0, -1 / J], [0, 1, 0, 0, 0, 0], [0, 0, 0, 0, 1, 0], [0] * 6, [0] * 6])
x = matrix([0] * 6)
for duration, slope, load in (("0.2", 0, "0"), ("0.8", U / mpf("0.8"), "0"), ("0.5", 0, "0"), ("0.5", 0, "63.66")):
    x[4], x[5] = slope, mpf(load)
    x = expm(A * mpf(duration)) * x
    print("i, w, phi =", mp.nstr(x[0], 20), mp.nstr(x[1], 20), mp.nstr(x[2], 20))

# SPDX-License-Identifier: GPL-3.0-or-later
# Closed forms of empty_tanks.toml: the root of the height H that drives the flow falls steadily. While the jet falls freely into the lower tank,
# H = h + 1 m and dH/dt = -c sqrt(H); when its connection is under water, H = h + 1 m - (h_l - 0.5 m) and dH/dt = -2 c sqrt(H).
from mpmath import mp, mpf, pi, sqrt

mp.dps = 30
c = pi * mpf("0.1") ** 2 / 4 * sqrt(2 * mpf("9.80665") / mpf("1.54"))
H_0, H_1, H_2 = mpf("1.999"), mpf("1.5"), mpf("0.5")
t_1 = 2 * (sqrt(H_0) - sqrt(H_1)) / c
t_2 = t_1 + (sqrt(H_1) - sqrt(H_2)) / c
print("h(10 s) of the upper tank", mp.nstr((sqrt(H_0) - c * 10 / 2) ** 2 - 1, 20) if t_1 > 10 else "")
print("connection under water, s", mp.nstr(t_1, 20))
print("empty, s", mp.nstr(t_2, 20))
for t in (20, 25):
    if t_1 < t < t_2:
        H = (sqrt(H_1) - c * (t - t_1)) ** 2
        print("h of the upper tank at", t, "s", mp.nstr((H - mpf("0.5")) / 2, 20))

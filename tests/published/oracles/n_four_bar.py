# SPDX-License-Identifier: GPL-3.0-or-later
# n_four_bar.toml and n_four_bar_10.toml for N windows: equal bars move as parallelograms, so that psi = 0 and all phi are one angle, a pendulum with
# phi'' = -g/l cos(phi) ((N + 1)/2 + N)/((N + 1)/3 + N). It turns over the top: closed form by Jacobi's elliptic functions, with 40 digits.
from mpmath import mp, mpf, pi, sqrt, ellipfun, ellipk, atan2, floor

mp.dps = 40
g, l = mpf("9.81"), mpf(1)


def angle(N, t):
    w2 = g / l * (mpf(N + 1) / 2 + N) / (mpf(N + 1) / 3 + N)
    top2 = 1 + 4 * w2  # square of the rate at the bottom: 1 rad/s at the top
    m, K = 4 * w2 / top2, ellipk(4 * w2 / top2)
    x = K - sqrt(top2) * t / 2  # theta = phi + pi/2 = 2 am(x), from theta = pi at t = 0
    turns = floor((x + K) / (2 * K))  # am(x + 2 K) = am(x) + pi
    rest = x - 2 * K * turns
    theta = 2 * (atan2(ellipfun("sn", rest, m=m), ellipfun("cn", rest, m=m)) + pi * turns)
    rate = -sqrt(top2) * ellipfun("dn", rest, m=m)
    return theta - pi / 2, rate


for N in (1, 2, 10, 40):
    for t in (5, 10):
        print(N, t, *(mp.nstr(value, 17) for value in angle(N, mpf(t))))

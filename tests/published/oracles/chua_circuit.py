# SPDX-License-Identifier: GPL-3.0-or-later
# Chua's circuit is linear where |u_1| < 1 V, and on either side: matrix exponentials from one change of the side to the next, with 40 digits.
# 10 du_1/dt = 0.565 (u_2 - u_1) - i_n(u_1), 100 du_2/dt = 0.565 (u_1 - u_2) - i, 18 di/dt = u_2 - 0.0125 i.
from mpmath import mp, mpf, matrix, expm, findroot

mp.dps = 40
G, G_a, G_b = mpf("0.565"), mpf("-0.757576"), mpf("-0.409091")


def matrix_of(side):
    slope, rest = (G_a, 0) if side == 0 else (G_b, side * (G_a - G_b))
    return matrix([[-(G + slope) / 10, G / 10, 0, -rest / 10], [G / 100, -G / 100, mpf(-1) / 100, 0],
                   [0, mpf(1) / 18, mpf("-0.0125") / 18, 0], [0, 0, 0, 0]])


t, x, side, end = mpf(0), matrix([4, 0, 0, 1]), 1, mpf(1000)
while True:
    A = matrix_of(side)
    motion = lambda s: expm(A * (s - t)) * x
    marks = [1, -1] if side == 0 else [side]
    before, step, event = t + mpf(10) ** -6, mpf(1), None
    while before < end and event is None:
        after = min(before + step, end)
        for mark in marks:
            if (motion(before)[0] - mark) * (motion(after)[0] - mark) < 0:
                event = findroot(lambda s: motion(s)[0] - mark, (before, after), solver="anderson", tol=mpf(10) ** -60), mark
        before = after
    if event is None:
        break
    at, mark = event
    print("u_1 =", mark, "V at", mp.nstr(at, 20), "s")
    x, t, side = motion(at), at, 0 if side != 0 else mark
y = motion(end)
print("u_1, u_2, i at 1000 s:", *(mp.nstr(y[k], 20) for k in range(3)))

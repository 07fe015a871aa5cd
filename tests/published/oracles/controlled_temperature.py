# SPDX-License-Identifier: GPL-3.0-or-later
# Switching times and final temperature of controlled_temperature.toml to 20 digits, from the heat balance written by hand:
# on, d(theta)/dt = 10/(1 + theta/255) - theta/10; off, d(theta)/dt = -theta/10; theta = T - 293.15 K.
from mpmath import mp, mpf, odefun, findroot, exp

mp.dps = 25


def reference(t):
    return 5 + 25 * min(max((t - 2) / mpf(6), 0), 1)


def heat(t, theta):
    return [10 / (1 + theta[0] / 255) - theta[0] / 10]


t, theta, is_on, end = mpf(0), mpf(0), True, mpf(10)
while True:
    motion = odefun(heat, t, [theta]) if is_on else (lambda s, t=t, theta=theta: [theta * exp(-(s - t) / 10)])
    mark = (lambda s: motion(s)[0] - reference(s) - 1) if is_on else (lambda s: motion(s)[0] - reference(s) + 1)
    step, before = mpf(1) / 200, t + mpf(10) ** -9
    while before + step < end and mark(before) * mark(before + step) > 0:
        before += step
    if before + step >= end:
        break
    event = findroot(mark, (before, before + step), solver="anderson", tol=mpf(10) ** -40)
    print("off" if is_on else "on", event, motion(event)[0])
    t, theta, is_on = event, motion(event)[0], not is_on
print("T(10 s)", motion(end)[0] + mpf("293.15"))

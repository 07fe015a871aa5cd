# SPDX-License-Identifier: GPL-3.0-or-later
# flyball_governor.toml in three coordinates (both rods move alike) from a Lagrangian written by hand; explicit Runge-Kutta of order 8.
import numpy as np
from scipy.integrate import solve_ivp

g, Mr, Ms, m = 9.81, 0.3, 3.0, 5.0
It, Il = Mr * (1 + 1e-4) / 12, Mr * 1e-4 / 6


def rates(t, y):
    psi, s, a, w, v, r = y
    ca, sa = np.cos(a), np.sin(a)
    # moment of inertia about the shaft, and half of its slope by alpha
    I = Il + Ms * 0.01 / 6 + 2 * (Mr * (0.05 + ca / 2) ** 2 + Il * sa**2 + It * ca**2 + m * (0.05 + ca) ** 2)
    dI = 2 * (-Mr * (0.05 + ca / 2) * sa + 2 * (Il - It) * sa * ca - 2 * m * (0.05 + ca) * sa)
    Ia = 2 * (It + Mr / 4 + m)
    h = 1 - sa / 2 - s
    l = np.hypot(ca / 2, h)
    la, ls = (-ca * sa / 4 - h * ca / 2) / l, -h / l
    F = 8e5 * (l - 0.5) + 4e4 * (la * r + ls * v)
    return [w, v, r, -dI * r * w / I, -g - 2 * F * ls / Ms, (dI / 2 * w**2 + g * ca * (Mr + 2 * m) - 2 * F * la) / Ia]


solution = solve_ivp(rates, (0, 10), [0, 0.5, np.pi / 6, 2 * np.pi, 0, 0], method="DOP853", rtol=3e-14, atol=1e-14, t_eval=[1, 10])
for t, y in zip(solution.t, solution.y.T):
    print(t, *(repr(float(v)) for v in y))

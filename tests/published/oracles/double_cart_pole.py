# SPDX-License-Identifier: GPL-3.0-or-later
# double_cart_pole.toml from the equations of motion in closed form; explicit Runge-Kutta of order 8 at a tolerance near rounding.
import numpy as np
from numpy import sin, cos
from scipy.integrate import solve_ivp

m0, m1, m2, l1, l2, g, F, w = 1, 0.5, 0.25, 0.5, 0.4, 9.81, 2, 3


def rates(t, y):
    x, a, b, vx, va, vb = y
    M = np.array([[m0 + m1 + m2, (m1 + m2) * l1 * cos(a), m2 * l2 * cos(b)],
                  [(m1 + m2) * l1 * cos(a), (m1 + m2) * l1**2, m2 * l1 * l2 * cos(a - b)],
                  [m2 * l2 * cos(b), m2 * l1 * l2 * cos(a - b), m2 * l2**2]])
    r = np.array([F * sin(w * t) + (m1 + m2) * l1 * va**2 * sin(a) + m2 * l2 * vb**2 * sin(b),
                  (m1 + m2) * g * l1 * sin(a) - m2 * l1 * l2 * vb**2 * sin(a - b),
                  m2 * g * l2 * sin(b) + m2 * l1 * l2 * va**2 * sin(a - b)])
    return [vx, va, vb, *np.linalg.solve(M, r)]


solution = solve_ivp(rates, (0, 3), [0, 0.1, -0.2, 0, 0, 0], method="DOP853", rtol=3e-14, atol=1e-15, t_eval=[1, 2, 3])
for t, y in zip(solution.t, solution.y.T):
    print(t, *(repr(float(v)) for v in y))

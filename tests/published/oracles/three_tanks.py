# SPDX-License-Identifier: GPL-3.0-or-later
# three_tanks.toml: volumes of tanks and pressure of the junction, by Radau IIA of order 5 at a tolerance near rounding; the levels at rest in closed form.
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

A, rho, g, k = 1, 995.586, 9.80665, 4.7e10
C = np.pi * 0.1**2 / 4 / np.sqrt(2) * np.sqrt(2 / rho)
z = np.array([2, 2, -1])
h0, p0 = np.array([8.0, 3.0, 3.0]), (1.5e5 - 101325) / 101325 * 101325  # above the ambient


def heads(y):
    return rho * g * (y[:3] + z) - y[3]


def rates(t, y):
    dp = heads(y)
    q = C * dp / (dp**2 + 1) ** 0.25
    return [*(-q / A), k * q.sum()]


def slopes(t, y):
    dp = heads(y)
    s = C * (dp**2 / 2 + 1) / (dp**2 + 1) ** 1.25
    J = np.zeros((4, 4))
    J[:3, :3] = -np.diag(s) * rho * g / A
    J[:3, 3] = s / A
    J[3, :3] = k * s * rho * g
    J[3, 3] = -k * s.sum()
    return J


times = [20, 40, 100]
solution = solve_ivp(rates, (0, 100), [*h0, p0], method="Radau", jac=slopes, rtol=2e-13, atol=[1e-13, 1e-13, 1e-13, 1e-8], t_eval=times)
for t, y in zip(solution.t, solution.y.T):
    print(t, *(repr(float(v)) for v in y))
# What the junction takes up is its pressure over k.
total = h0.sum() * A + p0 / k
level = brentq(lambda x: (3 * x + 3) * A + rho * g * (x + 2) / k - total, 0, 10, xtol=1e-15)
print("rest", repr(level), repr(level + 3))

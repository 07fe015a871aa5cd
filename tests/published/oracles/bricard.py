# SPDX-License-Identifier: GPL-3.0-or-later
# bricard.toml by recursive Newton-Euler equations of the open chain and multipliers for the five constraints of the last hinge, of
# which four are independent (least squares), with terms that take drift back; explicit Runge-Kutta of order 8.
import numpy as np
from scipy.integrate import solve_ivp

L, b, m, g = 1.0, 0.1, 1.0, 9.81
axes = [1, 2, 0, 1, 2]
origins = np.array([[0, 0, 0], [L, 0, 0], [0, L, 0], [0, 0, L], [-L, 0, 0]])
centres = np.array([[L / 2, 0, 0], [0, L / 2, 0], [0, 0, L / 2], [-L / 2, 0, 0], [0, -L / 2, 0]])
thin, long = m * b * b / 6, m * (L * L + b * b) / 12
inertias = [np.diag([thin if i == k else long for i in range(3)]) for k in (0, 1, 2, 0, 1)]


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    R = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R[i, i], R[i, j], R[j, i], R[j, j] = c, -s, s, c
    return R


def chain(q, v, a):
    """Moments in the hinges (inertia, weight), and the acceleration of the closing hinge with its Jacobian."""
    R, p, w, dw, dv = np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), np.array([0, g, 0])
    hinges, loads = [], []
    for k in range(5):
        arm = R @ origins[k]
        dv = dv + np.cross(dw, arm) + np.cross(w, np.cross(w, arm))
        p = p + arm
        e = R[:, axes[k]]
        dw = dw + a[k] * e + np.cross(w, v[k] * e)
        w = w + v[k] * e
        R = R @ turn(axes[k], q[k])
        hinges.append((p, e))
        c = R @ centres[k]
        I = R @ inertias[k] @ R.T
        force = m * (dv + np.cross(dw, c) + np.cross(w, np.cross(w, c)))
        loads.append((p + c, force, I @ dw + np.cross(w, I @ w)))
    moments = [sum(e @ (n + np.cross(r - p, f)) for r, f, n in loads[k:]) for k, (p, e) in enumerate(hinges)]
    end = p + R @ np.array([0, -L, 0])
    x = R[:, 0]
    arm = end - p
    end_acceleration = dv - np.array([0, g, 0]) + np.cross(dw, arm) + np.cross(w, np.cross(w, arm))
    x_acceleration = np.cross(dw, x) + np.cross(w, np.cross(w, x))
    J = np.array([np.concatenate((np.cross(e, end - p), np.cross(e, x)[1:])) for p, e in hinges]).T
    gap = np.concatenate((end - np.array([0, 0, L]), x[1:]))
    return np.array(moments), np.concatenate((end_acceleration, x_acceleration[1:])), J, gap


def rates(t, y):
    q, v = y[:5], y[5:]
    zero = np.zeros(5)
    bias, drift, J, gap = chain(q, v, zero)
    weight, *_ = chain(q, zero, zero)
    M = np.array([chain(q, zero, unit)[0] - weight for unit in np.eye(5)]).T
    free, into = np.linalg.solve(M, -bias), np.linalg.solve(M, J.T)
    multipliers = np.linalg.lstsq(J @ into, -(J @ free + drift + 40 * (J @ v) + 400 * gap), rcond=1e-10)[0]
    return np.concatenate((v, free + into @ multipliers))


solution = solve_ivp(rates, (0, 10), np.zeros(10), method="DOP853", rtol=1e-13, atol=1e-13, t_eval=[1, 5, 10])
for t, y in zip(solution.t, solution.y.T):
    print(t, *(repr(float(v)) for v in y))

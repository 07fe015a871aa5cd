# SPDX-License-Identifier: GPL-3.0-or-later
# bricard.toml as the motion of one point along the line that the closed loop leaves in the space of its five angles: q' = u n with the unit
# vector n that the five constraints of the last hinge leave, and u' from the power of recursive Newton-Euler equations of the open chain, in
# which the forces of the loop have no part. Explicit Runge-Kutta of order 8; what is left of the loop and of the energy is printed, too.
from math import cos, sin

import numpy as np
from scipy.integrate import solve_ivp

L, b, m, g = 1.0, 0.1, 1.0, 9.81
axes = (1, 2, 0, 1, 2)
along = (0, 1, 2, 0, 1)  # the axis that each rod lies along
origins = ((0, 0, 0), (L, 0, 0), (0, L, 0), (0, 0, L), (-L, 0, 0))
centres = ((L / 2, 0, 0), (0, L / 2, 0), (0, 0, L / 2), (-L / 2, 0, 0), (0, -L / 2, 0))
thin, long = m * b * b / 6, m * (L * L + b * b) / 12


def add(*vectors):
    return tuple(map(sum, zip(*vectors)))


def times(s, a):
    return (s * a[0], s * a[1], s * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def out(frame, a):  # frame: the three axes of a body
    return add(times(a[0], frame[0]), times(a[1], frame[1]), times(a[2], frame[2]))


def turned(frame, axis, angle):
    i, j = (axis + 1) % 3, (axis + 2) % 3
    c, s = cos(angle), sin(angle)
    result = list(frame)
    result[i] = add(times(c, frame[i]), times(s, frame[j]))
    result[j] = add(times(c, frame[j]), times(-s, frame[i]))
    return result


def chain(q, v, a, weight):
    """Moments in the hinges, acceleration of what the last hinge holds, its Jacobian, what is left of it, and the energy."""
    frame, p, w, dw, dv, u = [(1, 0, 0), (0, 1, 0), (0, 0, 1)], (0, 0, 0), (0, 0, 0), (0, 0, 0), (0, weight, 0), (0, 0, 0)
    hinges, loads, energy = [], [], 0
    for k in range(5):
        arm = out(frame, origins[k])
        dv = add(dv, cross(dw, arm), cross(w, cross(w, arm)))
        u = add(u, cross(w, arm))
        p = add(p, arm)
        e = frame[axes[k]]
        dw = add(dw, times(a[k], e), cross(w, times(v[k], e)))
        w = add(w, times(v[k], e))
        frame = turned(frame, axes[k], q[k])
        hinges.append((p, e))
        c, rod = out(frame, centres[k]), frame[along[k]]

        def spin(x):  # inertia times x
            return add(times(long, x), times((thin - long) * dot(rod, x), rod))

        force = times(m, add(dv, cross(dw, c), cross(w, cross(w, c))))
        loads.append((add(p, c), force, add(spin(dw), cross(w, spin(w)))))
        speed = add(u, cross(w, c))
        energy += m * dot(speed, speed) / 2 + dot(w, spin(w)) / 2 + m * g * add(p, c)[1]
    moments = [sum(dot(e, add(n, cross(add(r, times(-1, p)), f))) for r, f, n in loads[k:]) for k, (p, e) in enumerate(hinges)]
    arm, x = out(frame, (0, -L, 0)), frame[0]
    end = add(p, arm)
    acceleration = add(dv, (0, -weight, 0), cross(dw, arm), cross(w, cross(w, arm))) + add(cross(dw, x), cross(w, cross(w, x)))[1:]
    J = np.array([cross(e, add(end, times(-1, p))) + cross(e, x)[1:] for p, e in hinges]).T
    return np.array(moments), np.array(acceleration), J, np.array(add(end, (0, 0, -L)) + x[1:]), energy


zero = (0,) * 5
last = np.zeros(5)  # n of the last evaluation, which tells its sign


def direction(q):
    global last
    J = chain(q, zero, zero, 0)[2]
    U, s, V = np.linalg.svd(J)
    n = V[4] if V[4] @ last >= 0 else -V[4]
    last = n
    return n, V[:4].T @ np.diag(1 / s[:4]) @ U[:, :4].T


def rates(t, y):
    q, u = y[:5].tolist(), y[5]
    n, inverse = direction(q)
    v = (u * n).tolist()
    drift = chain(q, v, zero, 0)[1]
    a = -inverse @ drift
    whole = chain(q, v, a.tolist(), g)[0]
    mass = chain(q, zero, n.tolist(), 0)[0]
    return np.concatenate((u * n, [-(n @ whole) / (n @ mass)]))


last = direction([0.0] * 5)[0]
solution = solve_ivp(rates, (0, 10), np.zeros(6), method="DOP853", rtol=2.3e-14, atol=1e-15, t_eval=[1, 5, 10])
for t, y in zip(solution.t, solution.y.T):
    n = direction(y[:5])[0]
    left, energy = chain(y[:5].tolist(), (y[5] * n).tolist(), zero, g)[3:]
    print(t, *(repr(float(v)) for v in y[:5]), "left", abs(left).max(), "energy", energy)

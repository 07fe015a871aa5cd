# SPDX-License-Identifier: GPL-3.0-or-later
# Events and final speeds of coupled_clutches.toml to 20 digits: in each phase all moments are known functions of time, with integrals
# in closed form. A clutch is +1, -1 (slides) or 0 (holds); what may hold is tried first and held against the moment that this takes.
from itertools import product
from mpmath import mp, mpf, pi, sin, cos, findroot, matrix, lu_solve

mp.dps = 30
b = mpf("1.570796326794897")
fM, f1 = 2 * pi * 5, 2 * pi * mpf("0.2")


def drive(t):  # moment of the drive and its integral
    return 10 * sin(fM * t), -10 * cos(fM * t) / fM


def pressed(clutch, t):  # sliding moment, and its integral
    if clutch == 0:
        return 10 * sin(f1 * t + b), -10 * cos(f1 * t + b) / f1
    return (mpf(10), 10 * t) if t >= (mpf("0.4"), mpf("0.9"))[clutch - 1] else (mpf(0), mpf(0))


def solve(modes, M, slide):
    # unknown: accelerations a_1..a_4 and moments c_1..c_3 of the clutches, positive where the left side is braked; J = 1
    A, r = matrix(7), matrix(7, 1)
    for i in range(4):
        A[i, i] = 1
        if i < 3:
            A[i, 4 + i] = 1
        if i > 0:
            A[i, 4 + i - 1] = -1
    r[0] = M
    for c in range(3):
        if modes[c] == 0:
            A[4 + c, c], A[4 + c, c + 1] = 1, -1
        else:
            A[4 + c, 4 + c], r[4 + c] = 1, modes[c] * slide[c]
    return lu_solve(A, r)


def at(modes, t, which):
    return solve(modes, drive(t)[which], [pressed(c, t)[which] for c in range(3)])


def choose(t, w):
    later = t + mpf(10) ** -12
    for modes in sorted(product((0, 1, -1), repeat=3), key=lambda m: sum(map(abs, m))):
        if any(m * (w[c] - w[c + 1]) < 0 or (m == 0 and abs(w[c] - w[c + 1]) > mpf(10) ** -18) for c, m in enumerate(modes)):
            continue
        x = at(modes, later, 0)
        fits = True
        for c, m in enumerate(modes):
            if m == 0:
                fits = fits and abs(x[4 + c]) <= mpf("1.1") * abs(pressed(c, later)[0])
            elif abs(w[c] - w[c + 1]) < mpf(10) ** -18:
                fits = fits and m * (x[c] - x[c + 1]) > 0
        if fits:
            return modes


t, w = mpf(0), [mpf(10), mpf(0), mpf(0), mpf(0)]
for end in (mpf("0.4"), mpf("0.9"), mpf("1.2")):
    modes = choose(t, w)
    while t < end:
        start = at(modes, t, 1)
        speeds = lambda s: [w[i] + at(modes, s, 1)[i] - start[i] for i in range(4)]
        marks = [(lambda s, c=c: speeds(s)[c] - speeds(s)[c + 1]) if m else
                 (lambda s, c=c: mpf("1.1") * pressed(c, s)[0] - abs(at(modes, s, 0)[4 + c])) for c, m in enumerate(modes)]
        first, step = None, mpf(1) / 500
        s = t + mpf(10) ** -9
        while first is None and s < end:
            e = min(s + step, end - mpf(10) ** -15)
            if e <= s:
                break
            found = [findroot(f, (s, e), solver="anderson", tol=mpf(10) ** -45) for f in marks if f(s) * f(e) < 0]
            first, s = (min(found) if found else None), e
        until = first if first is not None else end
        w, t = speeds(until if first is not None else end - mpf(10) ** -28), until
        for c, m in enumerate(modes):
            if m == 0:
                w[c + 1] = w[c]
        if first is not None:
            w = [(w[0] if abs(v - w[0]) < mpf(10) ** -20 else v) for v in w]
            modes = choose(t, w)
            print(mp.nstr(t, 20), modes)
print("w(1.2 s) =", [mp.nstr(v, 20) for v in w])

# SPDX-License-Identifier: GPL-3.0-or-later
# benchmark_bicycle.toml: the canonical equations M qdd + v C1 qd + (g K0 + v^2 K2) q = 0 of lean and steer of Meijaard et al. 2007, appendix A, from the
# parameters of Table 1, and their eigenvalues with 30 digits.
from mpmath import mp, mpf, matrix, sin, cos, tan, pi, polyroots

mp.dps = 30
w, c, lam, g = mpf("1.02"), mpf("0.08"), pi / 10, mpf("9.81")
rR, mR, IRx, IRy = mpf("0.3"), mpf(2), mpf("0.0603"), mpf("0.12")
xB, zB, mB, IBx, IBxz, IBz = mpf("0.3"), mpf("-0.9"), mpf(85), mpf("9.2"), mpf("2.4"), mpf("2.8")
xH, zH, mH, IHx, IHxz, IHz = mpf("0.9"), mpf("-0.7"), mpf(4), mpf("0.05892"), mpf("-0.00756"), mpf("0.00708")
rF, mF, IFx, IFy = mpf("0.35"), mpf(3), mpf("0.1405"), mpf("0.28")

mT = mR + mB + mH + mF
xT = (xB * mB + xH * mH + w * mF) / mT
zT = (-rR * mR + zB * mB + zH * mH - rF * mF) / mT
ITx = IRx + IBx + IHx + IFx + mR * rR**2 + mB * zB**2 + mH * zH**2 + mF * rF**2
ITxz = IBxz + IHxz - mB * xB * zB - mH * xH * zH + mF * w * rF
ITz = IRx + IBz + IHz + IFx + mB * xB**2 + mH * xH**2 + mF * w**2
mA = mH + mF
xA = (xH * mH + w * mF) / mA
zA = (zH * mH - rF * mF) / mA
IAx = IHx + IFx + mH * (zH - zA)**2 + mF * (rF + zA)**2
IAxz = IHxz - mH * (xH - xA) * (zH - zA) + mF * (w - xA) * (rF + zA)
IAz = IHz + IFx + mH * (xH - xA)**2 + mF * (w - xA)**2
uA = (xA - w - c) * cos(lam) - zA * sin(lam)
IAll = mA * uA**2 + IAx * sin(lam)**2 + 2 * IAxz * sin(lam) * cos(lam) + IAz * cos(lam)**2
IAlx = -mA * uA * zA + IAx * sin(lam) + IAxz * cos(lam)
IAlz = mA * uA * xA + IAxz * sin(lam) + IAz * cos(lam)
mu = c / w * cos(lam)
SR, SF = IRy / rR, IFy / rF
ST = SR + SF
SA = mA * uA + mu * mT * xT

M = matrix([[ITx, IAlx + mu * ITxz], [IAlx + mu * ITxz, IAll + 2 * mu * IAlz + mu**2 * ITz]])
K0 = matrix([[mT * zT, -SA], [-SA, -SA * sin(lam)]])
K2 = matrix([[0, (ST - mT * zT) / w * cos(lam)], [0, (SA + SF * sin(lam)) / w * cos(lam)]])
C1 = matrix([[0, mu * ST + SF * cos(lam) + ITxz / w * cos(lam) - mu * mT * zT],
             [-(mu * ST + SF * cos(lam)), IAlz / w * cos(lam) + mu * (SA + ITz / w * cos(lam))]])
print("M ", [mp.nstr(x, 15) for x in M], "\nK0", [mp.nstr(x, 15) for x in K0], "\nK2", [mp.nstr(x, 15) for x in K2], "\nC1", [mp.nstr(x, 15) for x in C1])


def times(p, q):
    result = [mpf(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            result[i + j] += a * b
    return result


for v in (2, 5, 8):
    A = [[[M[i, j], v * C1[i, j], g * K0[i, j] + v**2 * K2[i, j]] for j in range(2)] for i in range(2)]
    determinant = [a - b for a, b in zip(times(A[0][0], A[1][1]), times(A[0][1], A[1][0]))]
    for root in sorted(polyroots(determinant, maxsteps=500, extraprec=100), key=lambda r: (r.real, r.imag)):
        print(v, mp.nstr(root.real, 20), mp.nstr(root.imag, 20))

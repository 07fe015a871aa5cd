# SPDX-License-Identifier: GPL-3.0-or-later
"""The chain of links as a user of SymPy gets it: Kane's method, common subexpressions, C code. M and the forces are SymPy's, and the
slopes of the residual M a - f; what is left for numbers is the solve with M, in the loops that the code by hand has.

    sympy_chain.py FILE N...     writes a C++ header with one class for each N
"""
import sys
import time

import sympy
from sympy.physics.mechanics import KanesMethod, Particle, Point, ReferenceFrame, dynamicsymbols


def chain(n):
    """M, f and their letters. Angles from hanging, each against the vertical, as in systems/mechanics/n_pendulum.toml."""
    q, u = dynamicsymbols(f"q:{n}"), dynamicsymbols(f"u:{n}")
    m, l, g = sympy.symbols(f"m:{n}"), sympy.symbols(f"l:{n}"), sympy.Symbol("g")
    ground, origin = ReferenceFrame("A"), Point("O")
    origin.set_vel(ground, 0)
    last, particles, loads = origin, [], []
    for k in range(n):
        link = ground.orientnew(f"B{k}", "Axis", [q[k], ground.z])
        link.set_ang_vel(ground, u[k] * ground.z)
        end = last.locatenew(f"P{k}", -l[k] * link.y)
        end.v2pt_theory(last, ground, link)
        particles.append(Particle(f"m{k}", end, m[k]))
        loads.append((end, -m[k] * g * ground.y))
        last = end
    kane = KanesMethod(ground, q_ind=q, u_ind=u, kd_eqs=[sympy.diff(a) - b for a, b in zip(q, u)])
    kane.kanes_equations(particles, loads)
    plain = {s: sympy.Symbol(f"q{k}") for k, s in enumerate(q)} | {s: sympy.Symbol(f"w{k}") for k, s in enumerate(u)}
    return kane.mass_matrix.xreplace(plain), kane.forcing.xreplace(plain), [plain[s] for s in q], [plain[s] for s in u], m, l, g


def lines(assignments):
    return "".join(f"        {target} = {sympy.ccode(value)};\n" for target, value in assignments)


def class_of(n):
    begin = time.time()
    mass, force, q, w, m, l, g = chain(n)
    a = sympy.symbols(f"a:{n}")
    residual = mass * sympy.Matrix(a) - force
    slopes = [-residual[i].diff(by) for by in (*q, *w) for i in range(n)]
    lower = [mass[i, j] for i in range(n) for j in range(i + 1)]

    def code(with_slopes):
        values = lower + list(force) + (slopes if with_slopes else [])
        shared, results = sympy.cse(values, symbols=sympy.numbered_symbols("e"))
        late = set(a)  # what needs the accelerations comes behind the solve
        early_lines, late_lines = [], []
        for name, value in shared:
            is_late = bool(value.free_symbols & late)
            if is_late:
                late.add(name)
            (late_lines if is_late else early_lines).append((f"const double {name}", value))
        count = len(lower)
        text = lines(early_lines)
        text += lines((f"M[{i}]", results[i]) for i in range(count))
        text += lines((f"f[{n + i}]", results[count + i]) for i in range(n))
        text += f"        factor<{n}>(M);\n        substitute<{n}>(M, f.data() + {n});\n"
        text += "".join(f"        f[{i}] = w{i};\n" for i in range(n))
        if not with_slopes:
            return text
        text += "".join(f"        [[maybe_unused]] const double a{i} = f[{n + i}];\n" for i in range(n))
        text += lines(late_lines)
        for column in range(2 * n):
            for i in range(n):
                text += f"        J[{2 * n * column + i}] = {1 if column == n + i else 0};\n"
                text += lines([(f"J[{2 * n * column + n + i}]", results[count + n + column * n + i])])
        starts = ", ".join(str(2 * n * column + n) for column in range(2 * n))
        return text + f"        dalembert::detail::ldlt_solve_columns<double, {n}>(M, J.data(), std::array<std::size_t, {2 * n}>{{{starts}}});\n"

    letters = "".join(f"        const double q{k} = x[{k}], w{k} = x[{n + k}], m{k} = m_[{k}], l{k} = l_[{k}];\n" for k in range(n))
    head = letters + f"        const double g = g_;\n        std::array<double, {n * (n + 1) // 2}> M;\n        (void)q0, (void)w0, (void)m0, (void)l0, (void)g;\n"
    result = f"""template <>
class Chain<{n}> {{
public:
    using State = std::array<double, {2 * n}>;
    using Input = std::array<double, 0>;
    using Jacobian = std::array<double, {4 * n * n}>;
    template <class Parameters>
    explicit Chain(const Parameters& p) : m_(p.m), l_(p.l), g_(p.g) {{}}

    void rhs(const State& x, const Input&, double, State& f) const {{
{head}{code(False)}    }}

    void rhs_and_jacobian(const State& x, const Input&, double, State& f, Jacobian& J) const {{
{head}{code(True)}    }}

private:
    std::array<double, {n}> m_, l_;
    double g_;
}};
"""
    print(f"SymPy {sympy.__version__}, N = {n}: {time.time() - begin:.0f} s", file=sys.stderr)
    return result


def main():
    path, sizes = sys.argv[1], [int(n) for n in sys.argv[2:]]
    text = """#pragma once

#include <array>
#include <cmath>

#include "benchmarks/by_hand.hpp"

namespace by_sympy {

using by_hand::factor;
using by_hand::substitute;
using std::cos;
using std::pow;
using std::sin;

template <std::size_t n>
class Chain;

"""
    text += "\n".join(class_of(n) for n in sizes)
    with open(path, "w", encoding="utf-8") as out:
        out.write(text + "\n}  // namespace by_sympy\n")


main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks an exported package: python.py PACKAGE PROGRAM SOURCE."""

import ast
import copy
import csv
import ctypes as C
import importlib
import inspect
import keyword
import pickle
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

try:
    import scipy.integrate
except ImportError:
    scipy = None

folder, program, source = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3])
sys.path.insert(0, str(folder.parent))
package = importlib.import_module(folder.name)
library = importlib.import_module(folder.name + "._library")
rng = np.random.default_rng(7)
problems = []


def check(condition, what):
    if not condition:
        problems.append(what)


# --- the table itself, as plant.h has it ---

P, D, U = C.c_void_p, C.c_double, C.c_uint
AT = C.CFUNCTYPE(None, P, U, P, P, D, P)
OF_X = C.CFUNCTYPE(None, P, U, P, D, P)
OF_TWO = C.CFUNCTYPE(None, P, U, P, P, D, P, P)
ENERGY = C.CFUNCTYPE(D, P, U, P, D)
POWER = C.CFUNCTYPE(D, P, U, P, P, D)


class Table(library.CPlant):
    _fields_ = [("rhs", AT), ("rhs_and_jacobian", OF_TWO), ("jacobian_u", AT), ("jacobian_p", AT), ("jacobian_t", AT), ("output", AT),
                ("output_jacobian_x", AT), ("output_jacobian_u", AT), ("output_jacobian_p", AT), ("output_jacobian_t", AT),
                ("mass_matrix", OF_X), ("kinetic_energy", ENERGY),
                ("potential_energy", ENERGY), ("internal_energy", ENERGY), ("supplied_power", POWER), ("dissipated_power", POWER),
                ("prescribed_power", POWER), ("exchanged_power", POWER), ("guard_values", AT), ("guard_rates", AT), ("kink_values", AT),
                ("holds", C.CFUNCTYPE(C.c_int, P, U, P, P, D))]


def example():
    """Parameters, inputs, end and start of the run in example.py."""
    given = {"u": None, "set": None}
    for node in ast.walk(ast.parse((folder / "example.py").read_text())):
        if isinstance(node, ast.Assign) and node.targets[0].id == "u":
            given["u"] = ast.literal_eval(node.value)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "set":
            given["set"] = ast.literal_eval(node.args[0])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "simulate":
            given.update({k.arg: ast.literal_eval(k.value) for k in node.keywords if k.arg in ("until", "x0")})
    return given


def same(a, b):
    return np.array_equal(np.asarray(a), np.asarray(b), equal_nan=True)


def points(plant, run, count=6):
    """States and inputs near the start, times, and modes."""
    x, u = plant.state(run["x0"]), plant.input(run["u"])
    width = 0.05 * np.where(x != 0, abs(x), 1.0)
    for i, q in enumerate(plant.states):  # stays within the range
        if np.isfinite(q.low) and np.isfinite(q.high):
            width[i] = min(width[i], 0.05 * (q.high - q.low))
    xs = x + width * rng.uniform(-1, 1, (count, len(x)))
    us = u + 0.05 * np.where(u != 0, abs(u), 1.0) * rng.uniform(-1, 1, (count, len(u)))
    return xs, us, rng.uniform(0, 1, count), rng.integers(0, max(1, len(plant.modes)), count)


def check_values(plant, xs, us, ts, modes):
    """Every function beside the table, at many points beside each of them, bit by bit; and shapes that are broadcast."""
    table = C.cast(plant._library.dalembert_plant_table(), C.POINTER(Table)).contents
    n, m, k = len(plant.states), len(plant.inputs), len(plant.outputs)
    stored = [len(p.row_indices) for p in (plant.pattern_x, plant.pattern_u, plant.pattern_p)]
    watched = len(plant.events) if plant.modes else len(plant.guard_table)

    def of_table(name, size, i):
        result = np.full(size, np.nan if name in ("guard_values", "guard_rates", "kink_values") else 0.0)  # not watched: not written
        function = getattr(table, name)
        arguments = [plant._self, int(modes[i]), xs[i].ctypes.data, us[i].ctypes.data, ts[i]]
        if name == "mass_matrix":
            del arguments[3]
        if function:
            function(*arguments, result.ctypes.data)
        return result

    def compare(name, size, shape, columns=None, **more):
        value = getattr(plant, {"guard_values": "guards", "kink_values": "kinks"}.get(name, name))
        arguments = (xs, ts, modes) if name == "mass_matrix" else (xs, us, ts, modes)
        many = value(*arguments, **more)
        for i in range(len(xs)):
            one = value(*(a[i] for a in arguments), **more)
            check(same(many[i], one), f"{name} at many points is not that at one")
            expected = of_table(name, size, i)
            if columns is not None:
                expected = columns.dense(expected)
            elif len(shape) == 2:
                expected = expected.reshape(shape[::-1]).T
            check(one.shape == shape and same(one, expected), f"{name} is not that of the table")

    compare("rhs", n, (n,))
    compare("jacobian_t", n, (n,))
    compare("output", k, (k,))
    if m > 0:
        compare("jacobian_u", stored[1], (n, m), plant.pattern_u)
    compare("jacobian_p", stored[2], (n, len(plant.parameters)), plant.pattern_p)
    compare("output_jacobian_x", k * n, (k, n))
    compare("output_jacobian_u", k * m, (k, m))
    if table.output_jacobian_p:
        compare("output_jacobian_p", k * len(plant.parameters), (k, len(plant.parameters)))
        compare("output_jacobian_t", k, (k,))
    elif k > 0:
        for value in (plant.output_jacobian_p, plant.output_jacobian_t):
            try:
                value(xs, us, ts, modes)
                check(False, "a plant without slopes of outputs has some")
            except NotImplementedError:
                pass
    if table.mass_matrix:
        compare("mass_matrix", plant.degrees**2, (plant.degrees, plant.degrees))
    if watched > 0:
        compare("guard_values", watched, (watched,))
    if plant.modes:
        compare("guard_rates", watched, (watched,))
        compare("kink_values", int(table.kinks), (int(table.kinks),))
    rates, J = plant.rhs_and_jacobian(xs, us, ts, modes)
    energies, powers, holds = plant.energies(xs, ts, modes), plant.powers(xs, us, ts, modes), plant.holds(xs, us, ts, modes)
    for i in range(len(xs)):
        f, entries = np.zeros(n), np.zeros(stored[0])
        table.rhs_and_jacobian(plant._self, int(modes[i]), xs[i].ctypes.data, us[i].ctypes.data, ts[i], f.ctypes.data, entries.ctypes.data)
        check(same(rates[i], f) and same(J[i], plant.pattern_x.dense(entries)), "rhs_and_jacobian is not that of the table")
        x, u, mode = xs[i].ctypes.data, us[i].ctypes.data, int(modes[i])
        for values, kind, arguments in ((energies, "energy", (plant._self, mode, x, ts[i])), (powers, "power", (plant._self, mode, x, u, ts[i]))):
            for name in values._fields:
                function = getattr(table, f"{name}_{kind}")
                expected = function(*arguments) if function else 0.0
                check(same(getattr(values, name)[i], expected), f"{name} {kind} is not that of the table")
        check(holds[i] == bool(not table.holds or table.holds(plant._self, mode, x, u, ts[i])), "holds() is not that of the table")
    # Shapes: one point beside many, two axes, no points, results in a given array, and arrays that are not in the order of C.
    u, t, mode = us[0], ts[0], modes[0]
    check(same(plant.rhs(xs, u, t, mode), [plant.rhs(x, u, t, mode) for x in xs]), "one input beside many states")
    check(same(plant.rhs(xs[0], u, ts, mode), [plant.rhs(xs[0], u, t, mode) for t in ts]), "one state at many times")
    grid = plant.rhs(xs[:, None, :], us[None, :2, :], ts[:, None], modes[:, None])
    check(grid.shape == (len(xs), 2, n) and same(grid[3, 1], plant.rhs(xs[3], us[1], ts[3], modes[3])), "two axes are broadcast")
    check(plant.rhs(np.zeros((0, n)), us[0]).shape == (0, n), "no points")
    out = np.empty_like(xs)
    check(plant.rhs(np.asfortranarray(xs), us, ts, modes, out=out) is out and same(out, plant.rhs(xs, us, ts, modes)), "out= and the order of arrays")
    if scipy is not None:
        one = (xs[0], us[0], ts[0], modes[0])
        check(same(plant.jacobian_x(*one, sparse=True).toarray(), plant.jacobian_x(*one)), "sparse df/dx")


def differences(f, x, j, h):
    up, down = x.copy(), x.copy()
    up[j] += h
    down[j] -= h
    return (f(up) - f(down)) / (up[j] - down[j])


def check_slopes(what, J, f, x):
    """Beside central differences: of several steps the best, since kinks and roundings spoil some."""
    scale = np.nanmax(abs(J), axis=0, initial=0) if J.size else np.zeros(0)
    for j in range(len(x)):
        if not np.isfinite(J[:, j]).all():
            continue
        best = np.inf
        for step in (1e-4, 1e-5, 1e-6, 1e-7):
            h = step * (abs(x[j]) if x[j] else 1e-3)
            apart = differences(f, x, j, h) - J[:, j]
            roundings = 1e-15 / h * abs(f(x))
            if np.isfinite(apart).all():
                best = min(best, np.max(np.maximum(abs(apart) - 20 * roundings, 0), initial=0) / max(scale[j], 1e-6 * scale.max(), 1e-12))
        check(best < 1e-5, f"{what} by number {j} is {best:.1g} off differences")


def check_jacobians(plant, xs, us, ts, modes):
    for i in range(2):
        x, u, t, mode = xs[i], us[i], ts[i], int(modes[i])
        if not np.isfinite(plant.rhs(x, u, t, mode)).all():
            continue
        check_slopes("df/dx", plant.jacobian_x(x, u, t, mode), lambda v: plant.rhs(v, u, t, mode), x)
        check_slopes("df/du", plant.jacobian_u(x, u, t, mode), lambda v: plant.rhs(x, v, t, mode), u)
        check_slopes("df/dt", plant.jacobian_t(x, u, t, mode)[:, None], lambda v: plant.rhs(x, u, v[0], mode), np.array([t]))
        if len(plant.outputs) > 0:
            check_slopes("C", plant.output_jacobian_x(x, u, t, mode), lambda v: plant.output(v, u, t, mode), x)
            check_slopes("D", plant.output_jacobian_u(x, u, t, mode), lambda v: plant.output(x, v, t, mode), u)
        other = plant.copy()
        parameters = np.array(list(plant.values().values()))

        def by_parameters(function):
            def at(values):
                other.set(dict(zip(other.values(), values)))
                return function(x, u, t, mode)
            return at

        check_slopes("df/dp", plant.jacobian_p(x, u, t, mode), by_parameters(other.rhs), parameters)
        if len(plant.outputs) > 0 and C.cast(plant._library.dalembert_plant_table(), C.POINTER(Table)).contents.output_jacobian_p:
            check_slopes("dy/dp", plant.output_jacobian_p(x, u, t, mode), by_parameters(other.output), parameters)
            check_slopes("dy/dt", plant.output_jacobian_t(x, u, t, mode)[:, None], lambda v: plant.output(x, u, v[0], mode), np.array([t]))


def check_run(plant, run):
    """At 1e-10 beside the program, which runs the library of the package as a plant, more accurately."""
    made = next((folder / "c").glob("plant-*.so"))
    asked = lambda option, numbers: ["--" + option, ",".join(f"{k}={v!r}" for k, v in numbers.items())] if numbers else []
    with tempfile.TemporaryDirectory() as results:
        ended = subprocess.run([program, "simulate", str(made), "--until", repr(run["until"]), "--tolerance", "1e-12", "--no-plot", "-o", results,
                                *asked("input", run["u"]), *asked("state", run["x0"]), *asked("parameter", run["set"])], capture_output=True, text=True)
        tables = [path for path in Path(results).glob("*.csv") if not path.name.endswith("_events.csv")]
        if ended.returncode not in (0, 1, 4) or not tables:
            problems.append(f"the program does not run it: {ended.stderr}")
            return
        rows = list(csv.reader(tables[0].open()))
        events = [row for path in Path(results).glob("*_events.csv") for row in list(csv.reader(path.open()))[1:]]
    numbers = np.array(rows[1:], dtype=float)
    titles = [re.sub(r" \[[^\[]*\]$", "", title) for title in rows[0]]
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        own = plant.simulate(run["until"], run["x0"], run["u"], tolerance=1e-10)
    count = min(len(own.t), len(numbers)) - (ended.returncode == 4)
    check(own.success or ended.returncode == 4, f"the run ends with '{own.message}', that of the program does not")
    check(count > 1, "the run has no rows")
    for name in [q.name for q in plant.states]:
        expected = numbers[:count, titles.index(name)]
        if name.startswith("dot(") and name[4:-1] in titles:  # at rest: roundings beside the speed of the size of the position
            size = max(1e-5, np.max(abs(expected)), np.max(abs(numbers[:count, titles.index(name[4:-1])]), initial=0) / run["until"])
        else:
            size = max(1e-5, np.max(abs(expected)))
        apart = np.max(abs(own[name][:count] - expected)) / size
        check(apart <= 1e-8, f"the run of {name} is {apart:.2g} off that of the program")
    if ended.returncode == 0 and plant.modes:
        own_events = [e for e in own.events if e.name in plant.events]
        check(len(own_events) == len(events), f"{len(own_events)} events, the program has {len(events)}")
        for mine, theirs in zip(own_events, events):
            check(mine.name == theirs[1] and abs(mine.t - float(theirs[0])) <= 1e-8 * run["until"], f"event {mine} is not {theirs}")


def check_sensitivities(plant, run):
    """dS/dt beside differences of rhs(), and S beside differences of runs."""
    names = [q.name for q in plant.parameters][:2] + [plant.states[-1].name]
    u = plant.input(run["u"])
    f = plant.sensitivities(names, run["u"])
    x, S = f.split(f.y0)
    check(same(x, plant.x0) and S.shape == (len(x), len(names)) and S[-1, -1] == 1, "y0 of sensitivities() is not that of the plant")
    rng = np.random.default_rng(3)
    x = plant.state(run["x0"])
    sizes = np.array([abs(plant[name]) or 1.0 for name in names[:-1]] + [1.0])
    S = rng.uniform(-1, 1, S.shape) * (1e-3 + abs(x))[:, None] / sizes
    rates = f.split(f(0.1, np.concatenate([x, S.T.ravel()])))[1]
    for k, name in enumerate(names):
        def rhs(step):
            other = plant.copy()
            if name != plant.states[-1].name:
                other[name] = plant[name] + step
            return other.rhs(x + step * S[:, k], u, 0.1)

        size = sizes[k]
        h = 2e-5 * size
        expected = (8 * (rhs(h) - rhs(-h)) - (rhs(2 * h) - rhs(-2 * h))) / (12 * h)
        scale = 1e-5 * (abs(expected).max() + abs(rhs(0)).max() / size) + 1e-9 / size
        # A flow like a root has no derivative at equal pressures.
        is_known = np.isfinite(expected).all() and np.isfinite(plant.jacobian_x(x, u, 0.1)).all()
        if is_known and abs(rhs(h) - 2 * rhs(0) + rhs(-h)).max() < 1e-4 * abs(rhs(h) - rhs(-h)).max():
            check(np.max(abs(rates[:, k] - expected)) <= scale, f"dS/dt by {name} is {np.max(abs(rates[:, k] - expected)):.2g} off")
    if scipy is None or not plant.parameters or plant.modes or plant.guard_table or plant.constraints or len(x) > 12:
        return
    until, name = min(1.0, run["until"] / 20), names[0]
    h = 1e-3 * (abs(plant[name]) or 1.0)
    solved = scipy.integrate.solve_ivp(f, (0, until), f.y0, method="LSODA", rtol=1e-9, atol=1e-12)

    def end(steps):
        other = plant.copy()
        other[name] = plant[name] + steps * h
        return other.simulate(until, u=run["u"], tolerance=1e-11).x[-1]

    expected = (8 * (end(1) - end(-1)) - (end(2) - end(-2))) / (12 * h)
    found = f.split(solved.y)[1][:, 0, -1]
    check(solved.success and np.max(abs(found - expected)) <= 1e-5 * (abs(expected).max() + abs(end(0)).max() / (1000 * h)),
          f"S by {name} is {np.max(abs(found - expected)):.2g} off, of {abs(expected).max():.2g}")


def check_ivp(plant, run):
    u = plant.input(run["u"])
    x = plant.state(run["x0"])
    f, g = plant.ivp(run["u"]), plant.ivp(lambda t, x: u)
    check(same(f(0.0, x), plant.rhs(x, u)) and same(f.jac(0.0, x), plant.jacobian_x(x, u)), "ivp() is not rhs() and jacobian_x()")
    check(same(g(0.0, x), f(0.0, x)) and same(g(0.0, np.array([x, x]).T), np.array([f(0.0, x)] * 2).T), "ivp() of a function")
    if scipy is not None and not plant.modes and not plant.guard_table and not plant.constraints and np.isfinite(f(0.0, x)).all():
        until = 0.05 * run["until"]
        own = plant.simulate(until, run["x0"], run["u"], tolerance=1e-10)
        peer = scipy.integrate.solve_ivp(f, (0, until), x, method="Radau", jac=f.jac, rtol=1e-7, atol=1e-10 * abs(x).max() + 1e-12)
        apart = np.max(abs(peer.y[:, -1] - own.x_end) / np.maximum(1e-6, abs(own.x).max(axis=0)))
        check(peer.success and apart < 1e-3, f"solve_ivp is {apart:.2g} off")


def refused(kind, text, call):
    try:
        call()
    except kind as error:
        check(text in str(error), f"'{error}' does not say '{text}'")
    else:
        problems.append(f"nothing is said of '{text}'")


def check_names_and_errors(plant):
    taken = re.search(r"std::array taken\{(.*?)\};", (source / "generator/export/python.cpp").read_text(), re.S)[1]
    public = {name for name in {*dir(type(plant)), *plant.__dict__} if not name.startswith("_")} - set(plant._families)
    other = set(re.findall(r'"(\w+)"', taken)) ^ (public | set(keyword.kwlist))
    check(not other, f"the generator knows other names that are taken: {other}")
    check(plant.title in package.__doc__ and "Equations" in inspect.getdoc(type(plant)), "the documentation")
    for q, family in zip(plant.parameters, (plant.attributes[p.name] for p in plant.parameters)):
        check(np.all(np.isin(plant[q.name], getattr(plant, family))), f"the attribute of {q.name}")
    for p in plant.parameters[:1]:
        other = plant.copy()
        before, value = other.rhs(other.x0), other[p.name]
        other[p.name] = f"{value * 1.01!r} {p.unit}"
        check(abs(other[p.name] / (value * 1.01) - 1 if value else 0) < 1e-15 and plant[p.name] == value, "a parameter with a unit")
        restored = pickle.loads(pickle.dumps(other))
        check(same(restored.rhs(other.x0), other.rhs(other.x0)) and copy.copy(other).values() == other.values(), "copies")
        other[p.name] = value
        check(same(other.rhs(other.x0), before), "a parameter that is set back")
        refused(ValueError, "of another kind", lambda: plant.set({p.name: "3 cd*A"}))
        refused(ValueError, "is not a unit", lambda: plant.set({p.name: "3 kq"}))
        refused(TypeError, "takes a number", lambda: plant.set({p.name: [1]}))
        check(plant[p.name] == value, "a value that is refused is not taken")
    refused(AttributeError, "has no parameter", lambda: setattr(plant, "no_such", 1))
    refused(AttributeError, "is not a parameter", lambda: setattr(plant, "rhs", 1))
    refused(KeyError, "has no parameter", lambda: plant["no such"])
    refused(KeyError, "has no state", lambda: plant.state(no_such=1))
    refused(ValueError, "the last axis", lambda: plant.rhs(np.zeros(len(plant.states) + 1)))
    refused(ValueError, "has no mode", lambda: plant.rhs(plant.x0, mode=1000))
    refused(ValueError, "ends after it begins", lambda: plant.simulate(0))
    refused(ValueError, "there is no method", lambda: plant.simulate(1, method="magic"))
    refused(ValueError, "tolerance", lambda: plant.simulate(1, tolerance=0))
    refused(ValueError, "must be a writeable array", lambda: plant.rhs(plant.x0, out=np.zeros(len(plant.states) + 1)))
    if plant.inputs:
        def broken(t, x):
            raise ZeroDivisionError("mine")
        refused(ZeroDivisionError, "mine", lambda: plant.simulate(1, u=broken))


plant = package.Plant()
run = example()
check_names_and_errors(plant)
plant.set(run["set"])
at = points(plant, run)
check_values(plant, *at)
check_jacobians(plant, *at)
check_run(plant, run)
check_ivp(plant, run)
check_sensitivities(plant, run)
for problem in dict.fromkeys(problems):
    print(f"{folder.name}: {problem}")
sys.exit(bool(problems))

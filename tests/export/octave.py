# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what octave.m compares with: octave.py PACKAGE PROGRAM FOLDER. PACKAGE is the export of the same scene to Python, which python.py compares with the
table; FOLDER gets points.mat and run.mat, as Octave's text files."""

import ast
import csv
import importlib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

folder, program, results = Path(sys.argv[1]).resolve(), sys.argv[2], Path(sys.argv[3])
sys.path.insert(0, str(folder.parent))
plant = importlib.import_module(folder.name).Plant()


def written(path, values):
    """Octave's text format of matrices with two or three axes."""
    with open(path, "w") as file:
        for name, value in values.items():
            a = np.asarray(value, dtype=float)
            a = a.reshape(1, 1) if a.ndim == 0 else a.reshape(-1, 1) if a.ndim == 1 else a
            numbers = [repr(float(v)).replace("nan", "NaN").replace("inf", "Inf") for v in a.ravel("F")]
            print(f"# name: {name}\n# type: matrix\n# ndims: {a.ndim}\n {' '.join(map(str, a.shape))}", *(f" {v}" for v in numbers), sep="\n", file=file)
            print(file=file)


text = (folder / "example.py").read_text()
u = ast.literal_eval(re.search(r"^u = (.*?)  # held$", text, re.M)[1])
until, x0 = re.search(r"until=([^,]*), x0=(.*?), u=u\)", text).groups()
until, x0 = float(until), ast.literal_eval(x0)
given = re.search(r"^plant\.set\((.*)\)$", text, re.M)
given = ast.literal_eval(given[1]) if given else None

rng = np.random.default_rng(3)
count = 4
start, inputs = plant.state(x0), plant.input(u)
x = start + 0.02 * np.where(start != 0, abs(start), 1) * rng.uniform(-1, 1, (count, len(start)))
us = inputs + 0.02 * np.where(inputs != 0, abs(inputs), 1) * rng.uniform(-1, 1, (count, len(inputs)))
t, mode = rng.uniform(0, 1, count), rng.integers(0, max(1, len(plant.modes)), count)
at = (x, us, t, mode)
values = {"rhs": plant.rhs(*at).T, "jacobian_t": plant.jacobian_t(*at).T, "energies": np.array(plant.energies(x, t, mode)),
          "powers": np.array(plant.powers(*at)), "holds": plant.holds(*at)[None, :]}
for name, many in (("jacobian_x", plant.jacobian_x), ("jacobian_u", plant.jacobian_u), ("jacobian_p", plant.jacobian_p),
                   ("output_jacobian_x", plant.output_jacobian_x), ("output_jacobian_u", plant.output_jacobian_u)):
    values[name] = np.moveaxis(many(*at), 0, -1)
try:
    values["output_jacobian_p"] = np.moveaxis(plant.output_jacobian_p(*at), 0, -1)
    values["output_jacobian_t"] = plant.output_jacobian_t(*at).T
except NotImplementedError:  # rods in loops
    pass
if plant.outputs:
    values["output"] = plant.output(*at).T
if plant.degrees > 0:
    values["mass_matrix"] = np.moveaxis(plant.mass_matrix(x, t, mode), 0, -1)
if plant.events or plant.guard_table:
    values["guard_values"] = plant.guards(*at).T
values = {name: value for name, value in values.items() if value.size > 0}
written(results / "points.mat", {"x": x.T, "u": us.T if us.size else np.zeros((0, count)), "t": t[None, :], "mode": mode[None, :] + 1, **values})

asked = lambda option, numbers: ["--" + option, ",".join(f"{k}={v!r}" for k, v in numbers.items())] if numbers else []
with tempfile.TemporaryDirectory() as made:
    library = next((folder / "c").glob("plant-*.so"))
    subprocess.run([program, "simulate", str(library), "--until", repr(until), "--tolerance", "1e-12", "--no-plot", "-o", made,
                    *asked("input", u), *asked("state", x0), *asked("parameter", given)], capture_output=True)
    rows = list(csv.reader(next(p for p in Path(made).glob("*.csv") if not p.name.endswith("_events.csv")).open()))
titles = [re.sub(r" \[[^\[]*\]$", "", title) for title in rows[0]]
numbers = np.array(rows[1:], dtype=float)
if given:
    plant.set(given)
finite = np.isfinite(plant.rhs(start, inputs)).all() and not plant.constraints
x = numbers[:, [titles.index(q.name) for q in plant.states]]
sizes = np.maximum(1e-5, abs(x).max(axis=0, initial=0))
names = [q.name for q in plant.states]
for i, name in enumerate(names):  # a velocity at rest: roundings beside the speed of the size of the position
    if name.startswith("dot(") and name[4:-1] in names:
        sizes[i] = max(sizes[i], abs(x[:, names.index(name[4:-1])]).max(initial=0) / until)
written(results / "run.mat", {"t_end": until, "u": inputs if inputs.size else np.zeros((0, 0)), "p": np.array(list(plant.values().values())), "x0": start,
                              "x": x, "sizes": sizes[None, :], "peers": float(finite)})

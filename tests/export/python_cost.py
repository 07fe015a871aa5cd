# SPDX-License-Identifier: GPL-3.0-or-later
"""What 1e5 evaluations of the right-hand side cost from numpy, beside a loop in C over the same points: pairs, the best of many. Usage:
python_cost.py PACKAGE [LIMIT]: exit code 1 if the ratio is above the limit."""

import ctypes
import importlib
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

LOOP = """
#include "{name}.h"
#include <stddef.h>
#define SHOWN __attribute__((visibility("default")))
static {name} plant;
SHOWN void prepare(void) {{
    const {name}_parameters p = {name}_default_parameters();
    {name}_update(&plant, &p);
}}
SHOWN void loop(size_t count, const double* x, const double* u, double t, double* dxdt) {{
    for (size_t i = 0; i < count; ++i) {name}_rhs(&plant, {mode}x + {states} * i, u + {inputs} * i, t, dxdt + {states} * i);
}}
"""


def main() -> int:
    folder = Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(folder.parent))
    package = importlib.import_module(folder.name)
    plant = package.Plant()
    n, m, count = len(plant.states), len(plant.inputs), 100000
    with tempfile.TemporaryDirectory() as made:
        source = Path(made) / "loop.c"
        source.write_text(LOOP.format(name=folder.name, states=n, inputs=m, mode=f"{folder.name}_m_{plant.modes[0]}, " if plant.modes else ""))
        library = Path(made) / "loop.so"
        subprocess.run([*package._library.compiler(), *package._library.OPTIONS, "-I", str(folder / "c"), "-o", str(library), str(source), "-lm"], check=True)
        in_library = ctypes.CDLL(str(library))
    in_library.prepare()
    loop = in_library.loop
    loop.argtypes = [ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p]
    rng = np.random.default_rng(1)
    x = plant.x0 + 0.1 * rng.standard_normal((count, n)) * np.maximum(1e-3, abs(plant.x0))
    u, rates = rng.random((count, m)), np.empty((count, n))
    in_c, in_numpy, values = [], [], np.empty((count, n))
    for _ in range(60):
        start = time.perf_counter()
        loop(count, x.ctypes.data, u.ctypes.data, 0.0, rates.ctypes.data)
        middle = time.perf_counter()
        plant.rhs(x, u, out=values)
        end = time.perf_counter()
        in_c.append((middle - start) / count * 1e9)
        in_numpy.append((end - middle) / count * 1e9)
    if not np.array_equal(values, rates, equal_nan=True):
        print(f"{folder.name}: the loop gives other values")
        return 1
    ratio = min(in_numpy) / min(in_c)
    print(f"{folder.name}: C {min(in_c):.1f} ns, numpy {min(in_numpy):.1f} ns, ratio {ratio:.2f} (medians {np.median(in_numpy) / np.median(in_c):.2f})")
    return ratio > (float(sys.argv[2]) if len(sys.argv) > 2 else 1.3)


sys.exit(main())

# SPDX-License-Identifier: BSL-1.0
"""A plant over the table of dalembert_plant.h, for numpy. It knows no model."""

from __future__ import annotations

import ctypes as C
import keyword
import re
from pathlib import Path
from typing import Any, Mapping, Sequence, Union

import numpy as np

from . import _library
from ._ivp import Ivp
from ._sensitivities import Sensitivities
from ._simulate import Inputs, Result, simulate
from ._tables import Constraint, Energies, Guard, Powers, Quantity, near, pattern_of, quantities, text_of
from ._units import in_si

#: A number in SI, or a text with a unit such as "5 bar".
Number = Union[float, str]
#: Numbers in the order of a table, or those of some names.
Values = Union[np.ndarray, Sequence[float], Mapping[str, Number]]

# As in enum dalembert_value of many_points.h.
(_RHS, _JACOBIAN_X, _JACOBIAN_U, _JACOBIAN_P, _JACOBIAN_T, _OUTPUT, _OUTPUT_X, _OUTPUT_U, _OUTPUT_P, _OUTPUT_T, _MASS, _ENERGIES, _POWERS,
 _GUARDS, _GUARD_RATES, _KINKS, _HOLDS, _CONSTRAINT_POSITIONS, _CONSTRAINT_RATES, _CONSTRAINT_JACOBIAN) = range(20)


class Plant:
    """A model with its parameters. Numbers are in SI; x = [q; v; z] are coordinates, their velocities and further states.

    Parameters are attributes: `plant.m = 2` or `plant.m = "200 g"`; also `plant["m"]`, for names that Python does not allow.
    Functions take one point or many: arrays of shape (..., states) and (..., inputs), and t and mode of shape (...), which are
    broadcast against each other. u = None means zeros. Modes are given by number or name.
    """

    _texts: Path  # of the package

    def __init__(self, **parameters: Number):
        self._self = None
        self._library = _library.load(self._texts)
        table = self._table = self._library.dalembert_plant_table().contents
        self.name, self.scene, self.title = text_of(table.name), text_of(table.scene), text_of(table.title)
        #: Tables of what the numbers mean, in their order.
        self.states = quantities(table.state_table, table.states)
        self.inputs = quantities(table.input_table, table.inputs)
        self.outputs = quantities(table.output_table, table.outputs)
        self.parameters = quantities(table.parameter_table, table.parameters)
        self.guard_table = tuple(
            Guard(text_of(g.name), text_of(g.doc), bool(g.ends)) for g in (table.guard_table[i] for i in range(table.guards)))
        self.constraints = tuple(
            Constraint(text_of(c.name), text_of(c.unit), text_of(c.description), bool(c.has_position))
            for c in (table.constraint_table[i] for i in range(table.constraints)))
        self.modes = tuple(text_of(table.mode_names[i]) for i in range(table.modes))
        self.events = tuple(text_of(table.event_names[i]) for i in range(table.events))
        self.degrees, self.velocity_place = int(table.degrees), int(table.velocity_place)
        #: Stored entries of df/dx, df/du and df/dp.
        self.pattern_x = pattern_of(table.pattern_x, table.states, table.states)
        self.pattern_u = pattern_of(table.pattern_u, table.states, table.inputs)
        self.pattern_p = pattern_of(table.pattern_p, table.states, table.parameters)
        self._values = np.array(table.parameter_defaults[: table.parameters], dtype=float)
        #: Attribute of each parameter, or of a family of them: a name that Python or this class has already gets a '_' behind.
        self.attributes: dict[str, str] = {}
        self._families: dict[str, list[int]] = {}
        for i, parameter in enumerate(self.parameters):
            family = re.sub(r"\W+", "_", parameter.name.split("[")[0]).strip("_")
            if keyword.iskeyword(family) or hasattr(type(self), family) or family in self.__dict__:
                family += "_"
            self._families.setdefault(family, []).append(i)
            self.attributes[parameter.name] = family
        self._self = table.create()
        if not self._self:
            raise MemoryError(f"there is no memory for the plant '{self.name}'")
        for name, value in parameters.items():
            setattr(self, name, value)

    def __del__(self) -> None:
        if getattr(self, "_self", None):
            self._table.destroy(self._self)
            self.__dict__["_self"] = None

    def __reduce__(self) -> tuple[Any, ...]:
        return _remade, (type(self), self._values)

    def copy(self) -> Plant:
        """Another plant with the same parameters."""
        return _remade(type(self), self._values)

    def __repr__(self) -> str:
        return (f"<{self.name}, scene {self.scene}: {len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs, "
                f"{len(self.parameters)} parameters>")

    # --- parameters ---

    def __getattr__(self, name: str) -> Any:
        families = self.__dict__.get("_families", {})
        if name not in families:
            owner = self.__dict__.get("name", "a plant")
            raise AttributeError(f"'{name}' is neither a parameter nor a function of {owner}{near(name, families)}")
        places = families[name]
        if self.parameters[places[0]].name.endswith("]"):
            values = self._values[places]
            values.flags.writeable = False  # plant["l[1]"] = ... sets one of a family
            return values
        return float(self._values[places[0]])

    def __setattr__(self, name: str, value: Any) -> None:
        if self.__dict__.get("_self") is None:
            super().__setattr__(name, value)
        elif name not in self._families:
            if name in self.__dict__ or hasattr(type(self), name):
                raise AttributeError(f"'{name}' of {self.name} cannot be set: it is not a parameter")
            raise AttributeError(f"{self.name} has no parameter '{name}'{near(name, self._families)}")
        else:
            places = self._families[name]
            is_family = self.parameters[places[0]].name.endswith("]")
            values = list(value) if is_family and not isinstance(value, str) and np.ndim(value) == 1 else [value] * len(places)
            if len(values) != len(places):
                raise ValueError(f"'{name}' of {self.name} has {len(places)} values, but {len(values)} are given")
            self._set({self.parameters[place].name: v for place, v in zip(places, values)})

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._families]

    def __getitem__(self, name: str) -> float:
        return float(self._values[self._place(name, self.parameters, "parameter")])

    def __setitem__(self, name: str, value: Number) -> None:
        self._set({name: value})

    def _set(self, given: Mapping[str, Number]) -> None:
        values = self._values.copy()
        for name, value in given.items():
            place = self._place(name, self.parameters, "parameter")
            values[place] = in_si(value, self.parameters[place].unit, name)
        self._values[:] = values
        self._table.set_parameters(self._self, self._values.ctypes.data)

    def set(self, parameters: Mapping[str, Number] | None = None, **more: Number) -> Plant:
        """Sets several parameters by their names in the model; all or none. Returns the plant."""
        self._set({**(parameters or {}), **more})
        return self

    def values(self) -> dict[str, float]:
        """All parameters by their names in the model."""
        return {p.name: float(v) for p, v in zip(self.parameters, self._values)}

    # --- names and arrays ---

    def _place(self, name: str, table: Sequence[Quantity], kind: str) -> int:
        for i, q in enumerate(table):
            if q.name == name:
                return i
        raise KeyError(f"{self.name} has no {kind} '{name}'{near(name, [q.name for q in table])}")

    def _numbers(self, given: Values | None, table: Sequence[Quantity], kind: str, otherwise: np.ndarray) -> np.ndarray:
        if given is None:
            return otherwise
        if isinstance(given, Mapping):
            values = otherwise.copy()
            for name, value in given.items():
                place = self._place(name, table, kind)
                values[place] = in_si(value, table[place].unit, name)
            return values
        array = np.asarray(given, dtype=float)
        if array.ndim == 0 and len(table) == 1:
            array = array.reshape(1)
        if array.ndim == 0 or array.shape[-1] != len(table):
            names = ", ".join(q.name for q in table) or "none"
            raise ValueError(f"{self.name} has {len(table)} {kind}s ({names}), but an array of shape {array.shape} is given; "
                             "the last axis is theirs")
        return array

    def state(self, values: Values | None = None, /, **more: Number) -> np.ndarray:
        """A state: the start state for the present parameters, with some values replaced: `plant.state({"phi": "10 deg"})`."""
        x = np.zeros(len(self.states))
        self._table.start_state(self._self, x.ctypes.data)
        x = np.array(self._numbers(values, self.states, "state", x))
        return np.array(self._numbers(more, self.states, "state", x)) if more else x

    @property
    def x0(self) -> np.ndarray:
        """The start state for the present parameters."""
        return self.state()

    def input(self, values: Values | None = None, /, **more: Number) -> np.ndarray:
        """Inputs by names, all others zero."""
        u = np.array(self._numbers(values, self.inputs, "input", np.zeros(len(self.inputs))))
        return np.array(self._numbers(more, self.inputs, "input", u)) if more else u

    def mode_number(self, mode: int | str) -> int:
        """The number of a mode, also given by its name."""
        if isinstance(mode, str):
            if mode not in self.modes:
                raise KeyError(f"{self.name} has no mode '{mode}'{near(mode, self.modes)}")
            return self.modes.index(mode)
        if not 0 <= mode < max(1, len(self.modes)):
            raise ValueError(f"{self.name} has no mode {mode}; the first of {max(1, len(self.modes))} has the number 0")
        return int(mode)

    def _modes(self, mode: Any) -> np.ndarray:
        if isinstance(mode, (int, str)):
            return np.asarray(self.mode_number(mode), dtype=np.uintc)
        modes = np.asarray(mode)
        if modes.dtype.kind not in "iu" or np.any(modes < 0) or np.any(modes >= max(1, len(self.modes))):
            raise ValueError(f"modes of {self.name} are whole numbers from 0 to {max(1, len(self.modes)) - 1}")
        return modes.astype(np.uintc)

    def _many(self, value: int, x: Values, u: Values | None, t: Any, mode: Any, out: np.ndarray | None = None) -> np.ndarray:
        """One call into C for all points."""
        x = self._numbers(x, self.states, "state", self.x0 if isinstance(x, Mapping) else np.zeros(0))
        u = self._numbers(u, self.inputs, "input", np.zeros(len(self.inputs)))
        t = np.asarray(t, dtype=float)
        modes = self._modes(mode)
        shape = np.broadcast_shapes(x.shape[:-1], u.shape[:-1], t.shape, modes.shape)
        full = shape + (self._library.dalembert_python_size(value),)
        result = np.empty(full) if out is None else out
        if result.shape != full or result.dtype != np.float64 or not result.flags.c_contiguous or not result.flags.writeable:
            raise ValueError(f"`out` must be a writeable array of shape {full}, of float64 in the order of C, "
                             f"but is one of shape {result.shape}, of {result.dtype}")
        keep = []  # until the call is done

        def data(array: np.ndarray, leading: tuple[int, ...], length: int) -> tuple[int, int]:
            if array.size == length and result.size > 0:
                array = np.ascontiguousarray(array)
                keep.append(array)
                return array.ctypes.data, 0
            if leading != shape:
                array = np.broadcast_to(array, shape + array.shape[len(leading):])
            array = np.ascontiguousarray(array)
            keep.append(array)
            return array.ctypes.data, length

        points = _library.CPoints(int(np.prod(shape, dtype=np.intp)), *data(modes, modes.shape, 1),
                                  *data(x, x.shape[:-1], len(self.states)), *data(u, u.shape[:-1], len(self.inputs)), *data(t, t.shape, 1))
        self._library.dalembert_python_many(self._self, value, C.addressof(points), result.ctypes.data)
        return result

    # --- values ---

    def rhs(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0, out: np.ndarray | None = None) -> np.ndarray:
        """dx/dt. `out`: an array for the result, which saves the system from giving new memory to each of many large results."""
        return self._many(_RHS, x, u, t, mode, out)

    def rhs_and_jacobian(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0,
                         sparse: bool = False) -> tuple[np.ndarray, Any]:
        """dx/dt and df/dx: together they cost less."""
        both, n = self._many(_JACOBIAN_X, x, u, t, mode), len(self.states)
        return both[..., :n], (self.pattern_x.csc if sparse else self.pattern_x.dense)(both[..., n:])

    def jacobian_x(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0, sparse: bool = False) -> Any:
        """df/dx, of shape (..., states, states), or a scipy.sparse.csc_matrix."""
        return self.rhs_and_jacobian(x, u, t, mode, sparse)[1]

    def jacobian_u(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0, sparse: bool = False) -> Any:
        """df/du, of shape (..., states, inputs), or a scipy.sparse.csc_matrix."""
        return (self.pattern_u.csc if sparse else self.pattern_u.dense)(self._many(_JACOBIAN_U, x, u, t, mode))

    def jacobian_p(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0, sparse: bool = False) -> Any:
        """df/dp by the parameters, of shape (..., states, parameters), or a scipy.sparse.csc_matrix."""
        return (self.pattern_p.csc if sparse else self.pattern_p.dense)(self._many(_JACOBIAN_P, x, u, t, mode))

    def jacobian_t(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """df/dt at fixed x and u."""
        return self._many(_JACOBIAN_T, x, u, t, mode)

    def output(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """The outputs y."""
        return self._many(_OUTPUT, x, u, t, mode)

    def _columns(self, values: np.ndarray, rows: int, columns: int) -> np.ndarray:
        return values.reshape(values.shape[:-1] + (columns, rows)).swapaxes(-1, -2)

    def output_jacobian_x(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """C = dy/dx, of shape (..., outputs, states)."""
        return self._columns(self._many(_OUTPUT_X, x, u, t, mode), len(self.outputs), len(self.states))

    def output_jacobian_u(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """D = dy/du, of shape (..., outputs, inputs)."""
        return self._columns(self._many(_OUTPUT_U, x, u, t, mode), len(self.outputs), len(self.inputs))

    def _asked_for(self, value: int, name: str) -> None:
        if not self._library.dalembert_python_has(value):
            raise NotImplementedError(f"{self.name} has no {name}")

    def output_jacobian_p(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """dy/dp by the parameters, of shape (..., outputs, parameters)."""
        self._asked_for(_OUTPUT_P, "derivatives of outputs by parameters")
        return self._columns(self._many(_OUTPUT_P, x, u, t, mode), len(self.outputs), len(self.parameters))

    def output_jacobian_t(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """dy/dt at fixed x and u."""
        self._asked_for(_OUTPUT_T, "derivatives of outputs by time")
        return self._many(_OUTPUT_T, x, u, t, mode)

    def linearise(self, x: Values, u: Values | None = None, t: float = 0.0,
                  mode: Any = 0) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """A, B, C, D at a point."""
        return (self.jacobian_x(x, u, t, mode), self.jacobian_u(x, u, t, mode), self.output_jacobian_x(x, u, t, mode),
                self.output_jacobian_u(x, u, t, mode))

    def mass_matrix(self, x: Values, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """M of the coordinates, of shape (..., degrees, degrees)."""
        self._asked_for(_MASS, "mass matrix")
        return self._columns(self._many(_MASS, x, None, t, mode), self.degrees, self.degrees)

    def energies(self, x: Values, t: Any = 0.0, mode: Any = 0) -> Energies:
        """Kinetic, potential and internal energy."""
        return Energies(*np.moveaxis(self._many(_ENERGIES, x, None, t, mode), -1, 0))

    def powers(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> Powers:
        """Supplied, dissipated, prescribed and exchanged power."""
        return Powers(*np.moveaxis(self._many(_POWERS, x, u, t, mode), -1, 0))

    def guards(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Values of the guards; of a plant with modes those of its events, which happen where one falls through zero, or NaN in modes
        in which they cannot."""
        return self._many(_GUARDS, x, u, t, mode)

    def guard_rates(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Rates of the values of events along the motion, with inputs held. Only plants with modes have them."""
        if not self._library.dalembert_python_has(_GUARD_RATES):
            raise NotImplementedError(f"{self.name} has no modes, and so no rates of guards")
        return self._many(_GUARD_RATES, x, u, t, mode)

    def kinks(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Of a plant with modes: functions where the right-hand side of the mode has a kink."""
        return self._many(_KINKS, x, u, t, mode)

    def holds(self, x: Values, u: Values | None = None, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Whether the state meets the conditions of the mode."""
        return self._many(_HOLDS, x, u, t, mode)[..., 0] != 0

    def constraint_positions(self, x: Values, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Positions that constraints hold at zero."""
        return self._many(_CONSTRAINT_POSITIONS, x, None, t, mode)

    def constraint_rates(self, x: Values, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """Rates that constraints hold at zero."""
        return self._many(_CONSTRAINT_RATES, x, None, t, mode)

    def constraint_jacobian(self, x: Values, t: Any = 0.0, mode: Any = 0) -> np.ndarray:
        """The rates' derivatives by the velocities, of shape (..., constraints, degrees)."""
        return self._columns(self._many(_CONSTRAINT_JACOBIAN, x, None, t, mode), len(self.constraints), self.degrees)

    # --- runs ---

    def ivp(self, u: Inputs = None, mode: int | str = 0, sparse: bool | None = None) -> Ivp:
        """For scipy: `f = plant.ivp(); solve_ivp(f, (0, 10), f.x0, method="BDF", jac=f.jac)`. `u`: see simulate()."""
        return Ivp(self, u, self.mode_number(mode), sparse)

    def sensitivities(self, varied: Sequence[str], u: Inputs = None, mode: int | str = 0) -> Sensitivities:
        """The motion with its derivatives by parameters and start values, for scipy's solve_ivp: see Sensitivities. `u`: see simulate()."""
        return Sensitivities(self, varied, u, self.mode_number(mode))

    def simulate(self, until: Number, x0: Values | None = None, u: Inputs = None, *, start: Number = 0.0,
                 samples: int | Sequence[float] | np.ndarray = 500, tolerance: float = 1e-9, method: str = "automatic",
                 longest_step: float = 0.0, first_step: float = 0.0, scale: Values | None = None, most_steps: int = 0, stops: Sequence[float] = ()) -> Result:
        """A run with the integrators, events, modes and constraints of dalembert, to `until` in s.

        x0: the start; values of some names are enough, the others are those of plant.x0.
        u: inputs as numbers, by names, or a function of (t, x) that returns them; by names, each may be a function of (t, x).
        samples: the number of intervals, or the times themselves.
        tolerance: of the error of a step. method: "automatic", "explicit" (Dormand-Prince 8(5,3)) or "rosenbrock" (Rodas5P).
        longest_step: in s; 0: chosen. scale: of each state; a smaller value counts as this.
        stops: times at which inputs jump or have kinks; no step goes across.
        """
        return simulate(self, until, x0, u, start, samples, tolerance, method, longest_step, first_step, scale, most_steps, stops)


def _remade(kind: type[Plant], values: np.ndarray) -> Plant:
    plant = kind()
    plant._values[:] = values
    plant._table.set_parameters(plant._self, plant._values.ctypes.data)
    return plant

# SPDX-License-Identifier: BSL-1.0
"""Runs of a plant with the integrators of dalembert_run.h, and their results."""

from __future__ import annotations

import ctypes as C
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _library
from ._units import in_si

if TYPE_CHECKING:
    from ._plant import Energies, Plant, Powers

InputFunction = Callable[[float, np.ndarray], Any]
#: Numbers, numbers by names, a function of (t, x), or by names numbers and functions.
Inputs = Union[None, np.ndarray, Sequence[float], Mapping[str, Any], InputFunction]

# As in enum dalembert_method and enum dalembert_status.
_METHODS = {"automatic": 0, "explicit": 1, "rosenbrock": 2}
_STATUS = ("success", "stopped", "not finite", "step too small", "too many steps", "event storm", "range left", "no start mode", "no mode",
           "accumulation", "constraint broken", "singular position", "bad options", "no memory")


class Event(NamedTuple):
    """An event of a run, the modes before and after it, or a kink: the mode stays."""

    t: float
    name: str
    before: str
    after: str


@dataclass(repr=False)
class Result:
    """A run: rows belong to the times t. result["phi"] is a column by the name of a state, output or input."""

    plant: Plant
    t: np.ndarray
    x: np.ndarray
    u: np.ndarray
    y: np.ndarray
    mode: np.ndarray
    events: list[Event]
    success: bool  #: whether it came to its end
    status: str
    message: str  #: how it ended, for people
    t_end: float  #: where it ended, and the state there
    x_end: np.ndarray
    steps: int
    rejected: int
    rhs_calls: int
    jacobians: int
    implicit_steps: int

    def __repr__(self) -> str:
        return f"<Result of {self.plant.name}: {len(self.t)} times, {len(self.events)} events. {self.message}>"

    def __getitem__(self, name: str) -> np.ndarray:
        if name == "t":
            return self.t
        for table, values in ((self.plant.states, self.x), (self.plant.outputs, self.y), (self.plant.inputs, self.u)):
            for i, q in enumerate(table):
                if q.name == name:
                    return values[:, i]
        names = ", ".join(q.name for q in (*self.plant.states, *self.plant.outputs, *self.plant.inputs))
        raise KeyError(f"the run of {self.plant.name} has no column '{name}'; there are t, {names}")

    @property
    def energies(self) -> Energies:
        """At each time."""
        return self.plant.energies(self.x, self.t, self.mode)

    @property
    def powers(self) -> Powers:
        """At each time."""
        return self.plant.powers(self.x, self.u, self.t, self.mode)

    def plot(self, *names: str) -> Any:
        """A figure of matplotlib, with a panel for each unit: of these columns, or of all states."""
        import matplotlib.pyplot as pyplot

        tables = {q.name: q.unit for q in (*self.plant.states, *self.plant.outputs, *self.plant.inputs)}
        panels: dict[str, list[str]] = {}
        for name in names or [q.name for q in self.plant.states]:
            self[name]
            panels.setdefault(tables[name], []).append(name)
        figure, axes = pyplot.subplots(len(panels), 1, sharex=True, squeeze=False, figsize=(8, 1.5 + 2 * len(panels)), layout="constrained")
        for axis, (unit, columns) in zip(axes[:, 0], panels.items()):
            for name in columns:
                axis.plot(self.t, self[name], label=name)
            axis.set_ylabel(f"{', '.join(columns) if len(columns) < 4 else ''} [{unit}]".strip())
            axis.grid(alpha=0.3)
            if len(columns) > 1:
                axis.legend(loc="upper right")
        axes[-1, 0].set_xlabel("t [s]")
        axes[0, 0].set_title(f"{self.plant.title or self.plant.name} ({self.plant.scene})")
        return figure


def input_function(plant: Plant, u: Inputs) -> tuple[InputFunction | None, np.ndarray]:
    """Inputs as a function that returns all of them, or nothing and the numbers that are held."""
    if callable(u):
        return (lambda t, x: plant._numbers(u(t, x), plant.inputs, "input", np.zeros(len(plant.inputs)))), plant.input()
    if isinstance(u, Mapping) and any(callable(value) for value in u.values()):
        held = plant.input({name: value for name, value in u.items() if not callable(value)})
        functions = [(plant._place(name, plant.inputs, "input"), value) for name, value in u.items() if callable(value)]

        def values(t: float, x: np.ndarray) -> np.ndarray:
            result = held.copy()
            for place, function in functions:
                result[place] = function(t, x)
            return result

        return values, held
    held = plant.input(u)
    if held.ndim != 1:
        raise ValueError(f"{plant.name} takes one value an input during a run, or a function of (t, x), "
                         f"but an array of shape {held.shape} is given")
    return None, held


def _event_name(plant: Plant, event: int) -> str:
    if not plant.modes:
        return plant.guard_table[event].name
    return plant.events[event] if event < len(plant.events) else f"kink {event - len(plant.events) + 1}"


def _times(until: float, start: float, samples: Any) -> np.ndarray:
    if isinstance(samples, (int, np.integer)):
        if samples < 1:
            raise ValueError(f"a run has at least one interval, but samples = {samples}")
        return np.linspace(start, until, int(samples) + 1)
    times = np.ascontiguousarray(samples, dtype=float)
    if times.ndim != 1 or len(times) == 0 or np.any(np.diff(times) <= 0):
        raise ValueError("the times in `samples` are one axis of rising numbers")
    if times[0] < start or times[-1] > until:
        raise ValueError(f"the times in `samples` lie between {start} s and {until} s, where the run is, "
                         f"but go from {times[0]} s to {times[-1]} s")
    return times


def simulate(plant: Plant, until: Any, x0: Any, u: Inputs, start: Any, samples: Any, tolerance: float, method: str, longest_step: float,
             first_step: float, scale: Any, most_steps: int, stops: Any) -> Result:
    """See Plant.simulate."""
    until, start = in_si(until, "s", "until"), in_si(start, "s", "start")
    if not (np.isfinite(until) and np.isfinite(start) and until > start):
        raise ValueError(f"a run ends after it begins, but this one goes from {start} s to {until} s")
    if method not in _METHODS:
        raise ValueError(f"there is no method '{method}'; there are {', '.join(_METHODS)}")
    if not 0 < tolerance < 1:
        raise ValueError(f"the tolerance is a number between 0 and 1, but not {tolerance}")
    n = len(plant.states)
    shown = _times(until, start, samples)
    times = np.unique(np.concatenate(([start], shown, [until])))
    x, modes, end = np.zeros((len(times), n)), np.zeros(len(times), dtype=np.uintc), np.zeros(n)
    begin = plant.state(x0) if x0 is not None else None
    if begin is not None and begin.shape != (n,):
        raise ValueError(f"a run of {plant.name} begins with one state of {n} numbers, but x0 has the shape {begin.shape}")
    function, held = input_function(plant, u)
    held = np.ascontiguousarray(held)
    scales = np.ascontiguousarray(plant.state(scale)) if scale is not None else None
    stop_times = np.sort(np.asarray(stops, dtype=float).reshape(-1))
    failure: list[BaseException] = []

    def inputs(_: Any, t: float, state: Any, result: Any) -> None:
        try:
            values = function(t, np.ctypeslib.as_array(state, (n,)).copy())  # type: ignore[misc]
            np.ctypeslib.as_array(result, (len(held),))[:] = values
        except BaseException as error:  # ends the run; it is raised again below
            failure.append(error)
            np.ctypeslib.as_array(result, (len(held),))[:] = np.nan

    def ask(_: Any) -> int:
        return len(failure)

    record = _library.CRecord(times.ctypes.data, len(times), x.ctypes.data, modes.ctypes.data, _library.ASK(ask))
    call = _library.CCall(
        plant._values.ctypes.data, None if begin is None else begin.ctypes.data, None if scales is None else scales.ctypes.data,
        _METHODS[method], tolerance, longest_step, first_step, most_steps, stop_times.ctypes.data, len(stop_times),
        _library.INPUT(inputs) if function is not None else _library.INPUT(), held.ctypes.data, end=end.ctypes.data)
    status = _STATUS[plant._library.dalembert_python_run(C.byref(call), C.byref(record))]
    names = plant.modes or ("",)
    events = [Event(e.t, _event_name(plant, e.event), names[e.before], names[e.after])
              for e in (record.events[i] for i in range(record.event_count))]
    plant._library.dalembert_python_free(C.byref(record))
    if failure:
        raise failure[0]
    if status == "no memory":
        raise MemoryError(f"there is no memory for the run of {plant.name}")
    if status == "bad options":
        raise ValueError(f"this run of {plant.name} is not possible: {call.message.decode()}")
    done = np.isin(times, shown)
    done[record.filled:] = False
    t, x, modes = times[done], x[done], modes[done]
    values = np.tile(held, (len(t), 1))
    if function is not None:
        for i in range(len(t)):
            values[i] = function(t[i], x[i])
    message = call.message.decode()
    if status != "success":
        warnings.warn(f"the run of {plant.name} ended at {call.t:g} s: {message}", RuntimeWarning, stacklevel=3)
    return Result(plant, t, x, values, plant.output(x, values, t, modes), modes, events, status == "success", status, message, call.t, end,
                  call.steps, call.rejected, call.rhs_calls, call.jacobians, call.implicit_steps)

# SPDX-License-Identifier: BSL-1.0
"""A plant and the derivatives of its motion by parameters and start values, as scipy's solve_ivp takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

import numpy as np

from ._ivp import Ivp
from ._simulate import Inputs

if TYPE_CHECKING:
    from ._plant import Plant


class Sensitivities:
    """The states x with S = dx/d(varied), as one motion: dS/dt = df/dx S + df/dp, with the exact derivatives of the plant.

    f = plant.sensitivities(["m", "phi"])
    run = solve_ivp(f, (0, 10), f.y0, method="DOP853", rtol=1e-9)
    x, S = f.split(run.y)             # shapes (states, times) and (states, varied, times)

    A name is one of a parameter, or of a state: then its start is varied. Parameters move the start state where it follows them, and are
    not asked whether inputs follow them. In one mode: at events S jumps, which this does not know; `dalembert simulate --sensitivities`
    does.
    """

    def __init__(self, plant: Plant, varied: Sequence[str], u: Inputs, mode: int):
        self.plant = plant
        self.varied = list(varied)
        self._f = Ivp(plant, u, mode, False)
        parameters, states = [q.name for q in plant.parameters], [q.name for q in plant.states]
        for name in self.varied:
            if name not in parameters and name not in states:
                raise KeyError(f"no parameter and no state is called '{name}'; parameters: {', '.join(parameters)}; states: {', '.join(states)}")
        self._columns = [parameters.index(name) if name in parameters else None for name in self.varied]
        self._starts = [states.index(name) if name not in parameters else None for name in self.varied]

    @property
    def y0(self) -> np.ndarray:
        """x and S at the start, one column of S after the other."""
        x = self.plant.x0
        columns = [x]
        for name, start in zip(self.varied, self._starts):
            columns.append(self._start_by(name) if start is None else np.eye(len(x))[start])
        return np.concatenate(columns)

    def _start_by(self, name: str) -> np.ndarray:
        """By a parameter: differences of order four, as start states are not differentiated."""
        value = self.plant[name]
        step = (abs(value) or 1.0) / 1024

        def at(steps: int) -> np.ndarray:
            moved = self.plant.copy()
            moved[name] = value + steps * step
            return moved.x0

        return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step)

    def __call__(self, t: float, y: np.ndarray) -> np.ndarray:
        """d/dt of x and S."""
        x, S = self.split(y)
        rates = self._f.jac(t, x) @ S
        by_parameters = None
        for k, column in enumerate(self._columns):
            if column is None:
                continue
            if by_parameters is None:
                by_parameters = self.plant.jacobian_p(x, self._f.input(t, x), t, self._f.mode)
            rates[:, k] += by_parameters[:, column]
        return np.concatenate([self._f(t, x), rates.T.ravel()])

    def split(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """x of shape (states, ...) and S of shape (states, varied, ...), from y of shape (states*(1 + varied), ...)."""
        n = len(self.plant.states)
        columns = np.asarray(y)[n:].reshape(len(self.varied), n, *np.shape(y)[1:])
        return np.asarray(y)[:n], np.swapaxes(columns, 0, 1)

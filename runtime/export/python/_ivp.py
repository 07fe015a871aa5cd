# SPDX-License-Identifier: BSL-1.0
"""A plant as scipy's solve_ivp takes it."""

from __future__ import annotations

import ctypes as C
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _library
from ._simulate import Inputs, input_function

if TYPE_CHECKING:
    from ._plant import Plant


class Ivp:
    """f(t, x) with its Jacobian, for the parameters that the plant has at each call.

    f = plant.ivp(u)
    solve_ivp(f, (0, 10), f.x0, method="BDF", jac=f.jac, vectorized=True)
    """

    def __init__(self, plant: Plant, u: Inputs, mode: int, sparse: bool | None):
        self.plant, self.mode = plant, mode
        n, m = len(plant.states), len(plant.inputs)
        self.sparse = n > 50 if sparse is None else sparse
        self._function, held = input_function(plant, u)
        # One point, and its results: their places are known to C, and only numbers move.
        self._x, self._u, self._t, self._mode = np.zeros(n), np.array(held, dtype=float), np.zeros(1), np.array([mode], dtype=np.uintc)
        self._held = self._u.copy()
        self._rates, self._both = np.zeros(n), np.zeros(plant._library.dalembert_python_size(1))
        self._points = _library.CPoints(1, self._mode.ctypes.data, 0, self._x.ctypes.data, 0, self._u.ctypes.data, 0,
                                        self._t.ctypes.data, 0)
        self._call: Callable[..., None] = plant._library.dalembert_python_many
        self._at, self._to_rates, self._to_both = C.addressof(self._points), self._rates.ctypes.data, self._both.ctypes.data

    @property
    def x0(self) -> np.ndarray:
        """The start state of the plant."""
        return self.plant.x0

    def input(self, t: float, x: np.ndarray) -> np.ndarray:
        """The inputs there."""
        return self._held if self._function is None else np.asarray(self._function(t, x), dtype=float)

    def _set(self, t: float, x: np.ndarray) -> None:
        self._x[:] = x
        self._t[0] = t
        if self._function is not None:
            self._u[:] = self._function(t, x)

    def __call__(self, t: float, x: np.ndarray) -> np.ndarray:
        """dx/dt; x may have columns, as with vectorized=True."""
        if np.ndim(x) == 2:
            u = self._held if self._function is None else np.array([self._function(t, column) for column in x.T])
            return self.plant.rhs(x.T, u, t, self.mode).T
        self._set(t, x)
        self._call(self.plant._self, 0, self._at, self._to_rates)
        return self._rates.copy()

    def jac(self, t: float, x: np.ndarray) -> Any:
        """df/dx, dense or scipy.sparse.csc_matrix. If the inputs follow x, their slopes are differences, and those of the plant exact."""
        self._set(t, x)
        self._call(self.plant._self, 1, self._at, self._to_both)
        n = len(self._x)
        values = self._both[n:].copy()
        J = self.plant.pattern_x.csc(values) if self.sparse else self.plant.pattern_x.dense(values)
        slopes = self._slopes(t, x) if self._function is not None else None
        if slopes is None:
            return J
        J = J + self.plant.jacobian_u(x, self._u, t, self.mode) @ slopes
        if not self.sparse:
            return J
        from scipy.sparse import csc_matrix

        return csc_matrix(J)

    def _slopes(self, t: float, x: np.ndarray) -> np.ndarray | None:
        """du/dx by central differences; nothing where the inputs do not follow x."""
        assert self._function is not None
        slopes = np.zeros((len(self._u), len(x)))
        for j, value in enumerate(x):
            h = 6e-6 * max(1.0, abs(value))
            up, down = np.array(x, dtype=float), np.array(x, dtype=float)
            up[j] += h
            down[j] -= h
            slopes[:, j] = (np.asarray(self._function(t, up)) - np.asarray(self._function(t, down))) / (up[j] - down[j])
        return slopes if slopes.any() else None

# SPDX-License-Identifier: BSL-1.0
"""The tables of a plant as values of Python."""

from __future__ import annotations

import difflib
from typing import Any, Iterable, NamedTuple

import numpy as np

from . import _library


class Quantity(NamedTuple):
    """A state, input, output or parameter: its name in the model, SI unit, description and declared range."""

    name: str
    unit: str
    description: str
    low: float
    high: float


class Guard(NamedTuple):
    """A function whose sign an integrator must watch. If `ends`, the model holds only where it is not negative."""

    name: str
    description: str
    ends: bool


class Constraint(NamedTuple):
    """A rate that is held at zero, with the position whose rate it is, if there is one."""

    name: str
    unit: str
    description: str
    has_position: bool


class Energies(NamedTuple):
    """In J."""

    kinetic: np.ndarray
    potential: np.ndarray
    internal: np.ndarray


class Powers(NamedTuple):
    """In W. d(sum of energies)/dt = supplied - dissipated + prescribed + exchanged."""

    supplied: np.ndarray
    dissipated: np.ndarray
    prescribed: np.ndarray
    exchanged: np.ndarray


class Pattern(NamedTuple):
    """Stored entries of a matrix, column by column, as scipy.sparse.csc_matrix has them; and the column of each entry."""

    shape: tuple[int, int]
    column_starts: np.ndarray
    row_indices: np.ndarray
    columns: np.ndarray

    def dense(self, values: np.ndarray) -> np.ndarray:
        """Whole matrices from stored entries."""
        matrix = np.zeros(values.shape[:-1] + self.shape)
        matrix[..., self.row_indices, self.columns] = values
        return matrix

    def csc(self, values: np.ndarray) -> Any:
        """A scipy.sparse.csc_matrix of stored entries."""
        from scipy.sparse import csc_matrix

        if values.ndim != 1:
            raise ValueError(f"sparse=True makes one matrix, but there are points of shape {values.shape[:-1]}")
        return csc_matrix((values, self.row_indices, self.column_starts), shape=self.shape)


def text_of(characters: bytes | None) -> str:
    return (characters or b"").decode("utf-8")


def quantities(table: Any, count: int) -> tuple[Quantity, ...]:
    rows = (table[i] for i in range(count))
    return tuple(Quantity(text_of(q.name), text_of(q.unit), text_of(q.description), q.low, q.high) for q in rows)


def pattern_of(pattern: _library.CPattern, rows: int, columns: int) -> Pattern:
    if pattern.column_starts:
        starts = np.array(pattern.column_starts[: columns + 1], dtype=np.intp)
        indices = np.array(pattern.row_indices[: int(starts[-1])], dtype=np.intp)
    else:
        starts = np.arange(columns + 1, dtype=np.intp) * rows
        indices = np.tile(np.arange(rows, dtype=np.intp), columns)
    return Pattern((rows, columns), starts, indices, np.repeat(np.arange(columns), np.diff(starts)))


def near(name: str, names: Iterable[str]) -> str:
    names = list(names)
    near = difflib.get_close_matches(name, names, 1)
    if near:
        return f"; do you mean '{near[0]}'?"
    return f"; there are {', '.join(names)}" if names else "; there are none"

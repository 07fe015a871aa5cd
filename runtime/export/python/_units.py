# SPDX-License-Identifier: BSL-1.0
"""Units of numbers that are given as text, such as "5 bar". The table is that of the model language: `dalembert help units`."""

from __future__ import annotations

import difflib
import math
import re
from fractions import Fraction
from typing import NamedTuple

# Factor, offset, exponents of m, kg, s, A, K, mol, cd, and whether it takes a prefix: the value in SI is (value + offset) * factor.
_UNITS: dict[str, tuple[float, float, tuple[str, ...], bool]] = {
@UNITS@}
_PREFIXES = {@PREFIXES@}
_TOKEN = re.compile(r"\s*([A-Za-z]+|\d+(?:\.\d+)?|[-*/^()])")
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$", re.DOTALL)


class Unit(NamedTuple):
    factor: float
    offset: float
    exponents: tuple[Fraction, ...]

    def times(self, other: Unit, sign: int) -> Unit:
        if self.offset or other.offset:
            raise ValueError("degC is for absolute temperatures alone; differences are in K")
        return Unit(self.factor * other.factor**sign, 0.0, tuple(a + sign * b for a, b in zip(self.exponents, other.exponents)))

    def to_the(self, power: Fraction) -> Unit:
        if self.offset:
            raise ValueError("degC is for absolute temperatures alone; differences are in K")
        whole = int(power) if power.denominator == 1 else float(power)
        return Unit(self.factor**whole, 0.0, tuple(power * e for e in self.exponents))


def _known(name: str) -> Unit:
    entry, factor = _UNITS.get(name), 1.0
    if entry is None and name[1:] in _UNITS and name[0] in _PREFIXES and _UNITS[name[1:]][3]:
        entry, factor = _UNITS[name[1:]], _PREFIXES[name[0]]
    if entry is None:
        near = difflib.get_close_matches(name, _UNITS, 1)
        raise ValueError(f"'{name}' is not a unit" + (f"; do you mean '{near[0]}'?" if near else ""))
    return Unit(entry[0] * factor, entry[1], tuple(Fraction(e) for e in entry[2]))


class _Reader:
    """Products, quotients and powers of units, as in kg*m/s^2."""

    def __init__(self, text: str):
        self.text, self.tokens, at = text, [], 0
        while at < len(text.rstrip()):
            match = _TOKEN.match(text, at)
            if match is None:
                raise ValueError(f"'{text}' is not a unit")
            self.tokens.append(match[1])
            at = match.end()

    def take(self, *wanted: str) -> str | None:
        return self.tokens.pop(0) if self.tokens and self.tokens[0] in wanted else None

    def next(self) -> str:
        if not self.tokens:
            raise ValueError(f"the unit '{self.text}' ends too early")
        return self.tokens.pop(0)

    def product(self) -> Unit:
        unit = self.power()
        while operator := self.take("*", "/"):
            unit = unit.times(self.power(), 1 if operator == "*" else -1)
        return unit

    def power(self) -> Unit:
        token = self.next()
        if token == "(":
            unit = self.product()
            if not self.take(")"):
                raise ValueError(f"a bracket of the unit '{self.text}' is not closed")
        elif token == "1":
            unit = Unit(1.0, 0.0, (Fraction(0),) * 7)
        elif token[0].isalpha():
            unit = _known(token)
        else:
            raise ValueError(f"'{token}' cannot stand in the unit '{self.text}'")
        return unit.to_the(self.exponent()) if self.take("^") else unit

    def exponent(self) -> Fraction:
        bracket, sign = self.take("("), -1 if self.take("-") else 1
        value = sign * Fraction(self.next())
        if bracket:
            if self.take("/"):
                value /= Fraction(self.next())
            if not self.take(")"):
                raise ValueError(f"a bracket of the unit '{self.text}' is not closed")
        return value


def read(text: str) -> Unit:
    """Factor, offset and dimension of a unit."""
    reader = _Reader(text)
    unit = reader.product()
    if reader.tokens:
        raise ValueError(f"'{reader.tokens[0]}' cannot stand in the unit '{text}'")
    return unit


def in_si(value: object, unit: str, name: str) -> float:
    """A number, or a text such as "5 bar", in the SI unit of the quantity `name`."""
    if not isinstance(value, str):
        try:
            return float(value)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            raise TypeError(f"'{name}' takes a number in {unit}, or a text such as '1 {unit}', but not {value!r}") from None
    match = _NUMBER.match(value)
    if match is None:
        raise ValueError(f"'{name}' takes a number in {unit}, or a text such as '1 {unit}', but not '{value}'")
    if not match[2]:
        return float(match[1])
    try:
        given = read(match[2])
    except (ValueError, ZeroDivisionError) as error:
        raise ValueError(f"'{name}' cannot be '{value}': {error}") from None
    if given.exponents != read(unit).exponents:
        raise ValueError(f"'{name}' has the unit {unit}, but '{value}' is given in {match[2]}, which is of another kind")
    result = (float(match[1]) + given.offset) * given.factor
    if not math.isfinite(result):
        raise ValueError(f"'{name}' cannot be '{value}': it is too large")
    return result

// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a curve in a CSV file.
#pragma once

#include "elements/curves.hpp"
#include "read/entry.hpp"

namespace dalembert {

/// In SI, but for the power of pi.
inline Rational in_si(const Rational& value, const Unit& unit) { return (value + unit.offset) * unit.factor; }

/// Reads the points of the keys "file" and "columns"; of two variables the grid, whose lines may come in any order. Whether it could; what
/// could not be read of the keys has been told. Throws Failure (unreadable-file, unknown-name, missing-key, wrong-type, unit-mismatch,
/// wrong-arguments, doubly-defined) for what is wrong in the file.
bool read_curve_file(const Entry& e, Curve& curve);

}  // namespace dalembert

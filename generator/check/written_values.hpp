// SPDX-License-Identifier: GPL-3.0-or-later
// Values that a user gives to something with a declared unit, in the model, in a run or on the command line. A value without a unit
// counts in the declared unit: 150, 2*3 and sin(t) alike. Any other has the unit that its parts give it, which must be of the same kind.
#pragma once

#include "elements/names.hpp"
#include "elements/runs.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Whether it is made of numbers without a unit alone, and of pi. Such values are converted when they are read.
bool is_plain_number(const Expression& expression);

/// The unit that the model declares for a parameter, coordinate, rate, state, input, output or definition; SI where it declares none.
/// Nothing where the variable is none of these.
std::optional<Unit> declared_unit(const Expression& variable, const Names& names);

/// The value in SI. `what` stands in the sentence when units disagree (unit-mismatch); the value comes back unchanged then.
ExpressionPtr in_si(const ExpressionPtr& value, const Unit& declared, const std::string& what, const Names& names,
                    Diagnostics& diagnostics);
/// The same; throws Failure.
ExpressionPtr in_si(const ExpressionPtr& value, const Unit& declared, const std::string& what, const Names& names);

/// Gives their declared unit to numbers alone that stand where formulas do: definitions, outputs, resets, points of printed equations.
void convert_numbers(Model& model);
/// The same for points of an equation.
void convert_numbers(std::vector<AtPoint>& points, const Names& names);
/// Converts all values that are no formulas and not converted yet, and checks their units.
void convert_values(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert

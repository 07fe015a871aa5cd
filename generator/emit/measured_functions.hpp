// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of a header, each as a call that fills numbers and as what these numbers are exactly.
#pragma once

#include <functional>

#include "emit/header.hpp"
#include "graph/exact_code.hpp"

namespace dalembert {

/// One number that a function gives.
struct MeasuredResult {
    std::string name;
    std::function<MaybeExact(ExactCode&)> exact;
    Function solves = Function::rhs;         ///< the function in which what it is made of is solved for
    std::optional<Function> column_of = {};  ///< and of a Jacobian its columns,
    std::size_t column = 0;                  ///< of which it is in this one
    std::optional<std::size_t> row = {};     ///< of a Jacobian
    std::size_t input = 0;                   ///< of its column, as ExactCode numbers them
    bool is_of_rate = false;                 ///< the row belongs to a rate, else to an output
};

struct MeasuredFunction {
    std::string name;
    std::string statements;               ///< C++ that writes its numbers in this order
    std::vector<MeasuredResult> results;  ///< where one has no `exact` it is not measured
};

/// Those of one mode; of a machine that does not switch, all. `modes`: the code of all modes.
std::vector<MeasuredFunction> measured_functions(const std::vector<const Code*>& modes, std::size_t mode);

/// The source of a program that reads points and writes what the functions give there, for float or double; its arguments are the
/// arithmetic and the files of points and of results, both of doubles. `functions`: by mode.
std::string accuracy_source(const System& system, const Header& header, const std::vector<std::vector<MeasuredFunction>>& functions);

}  // namespace dalembert

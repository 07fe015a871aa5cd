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
    std::optional<std::size_t> row = {};     ///< in a Jacobian
    std::optional<std::size_t> column = {};  ///< there: the input, as ExactCode numbers them
};

struct MeasuredFunction {
    std::string name;
    std::string statements;               ///< C++ that writes its numbers in this order
    std::vector<MeasuredResult> results;  ///< where one has no `exact` it is not measured
};

/// Those of one mode; of a machine that does not switch, all. `modes`: the code of all modes.
std::vector<MeasuredFunction> measured_functions(const std::vector<const Code*>& modes, std::size_t mode);

/// The source of a program that reads points and writes what the functions give there, for float or double; its arguments are the arithmetic and
/// the files of points and of results, both of doubles. `functions`: by mode.
std::string accuracy_source(const System& system, const Header& header, const std::vector<std::vector<MeasuredFunction>>& functions);

}  // namespace dalembert

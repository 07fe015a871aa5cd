// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert evaluate`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <utility>
#include <vector>

#include "report/subject.hpp"

namespace dalembert {

/// Values at one point, in SI. Numbers are decimals with as many significant digits as were asked for, which may be more than a double has.
struct EvaluateResult {
    struct Number {
        std::string name, value, unit;  ///< the unit is empty where the model gives none
    };
    using Numbers = std::vector<Number>;
    struct AtRest {
        std::string name;                        ///< of the friction
        bool sticks;
        std::string margin, needed_coefficient;  ///< N, 1
    };
    Subject subject;
    int digits = 0;
    std::string time = {};        ///< s
    bool time_given = false;
    Numbers parameters = {}, states = {}, inputs = {}, rates = {}, outputs = {};
    Numbers unknowns = {};        ///< of loads
    std::vector<AtRest> frictions = {};
    Numbers energies_and_powers = {};
};

std::string as_text(const EvaluateResult& result);
nlohmann::ordered_json as_json(const EvaluateResult& result);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert optimise`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "report/subject.hpp"
#include "run/optimum.hpp"

namespace dalembert {

/// The parameter that is varied, in SI, and as the model gives it.
struct VariedParameter {
    std::string name, unit;             ///< of SI; empty without one
    std::string declared_unit = {};     ///< empty where it is that of SI
    double of_declared = 1;             ///< SI units in one declared one
};

struct OptimiseResult {
    Subject subject;
    bool is_largest = true;             ///< was looked for; else the smallest
    std::string output, unit;           ///< unit is empty without one
    VariedParameter parameter;
    double low = 0, high = 0;           ///< of the parameter, in SI
    int points = 0;                     ///< of the scan
    double value = 0, value_error = 0;  ///< of the output
    double at = 0, at_error = 0;        ///< of the parameter; without an error at an end of the range
    Optimum::Place place = Optimum::Place::inside;
    std::optional<double> second_derivative = {};  ///< nothing at an end of the range
    std::optional<double> loses_a_percent = {};    ///< change of the parameter that does
    double t = 0;                       ///< s, where the run ends
    std::string event = {};                  ///< that ends it; empty: the end that the run names
    std::size_t evaluations = 0;
    std::vector<Optimum> others = {};        ///< with values of the output
};

/// "0.7423 rad (42.53 deg)"
std::string with_units(double value, const VariedParameter& parameter, int digits);

/// Warnings of better ones elsewhere; empty without any.
std::string warnings_of(const OptimiseResult& result);

std::string as_text(const OptimiseResult& result);
nlohmann::ordered_json as_json(const OptimiseResult& result);

}  // namespace dalembert

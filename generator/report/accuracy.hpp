// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert accuracy`: how many digits the generated functions have.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/rewritten.hpp"
#include "report/subject.hpp"
#include "run/accuracy_measurement.hpp"

namespace dalembert {

struct AccuracyResult {
    Subject subject;
    std::uint64_t seed = 0;                ///< of the random numbers
    double limit = 0;                      ///< largest error in double that is good, in ulp beyond the condition
    std::vector<std::string> inputs;       ///< of the functions: parameters, states, inputs, time
    AccuracyReport in_float, in_double;    ///< of the same functions
    std::vector<RewrittenPlaces> rewritten;
    bool explained = false;                ///< rewritings are told, too
    bool is_good() const;
};

std::string as_text(const AccuracyResult& result);
nlohmann::ordered_json as_json(const AccuracyResult& result);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert simulate`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/subject.hpp"
#include "run/simulation.hpp"

namespace dalembert {

struct SimulateResult {
    Subject subject;
    SimulationReport run;
    double tolerance = 0;       ///< of the run
    bool has_balances = false;  ///< of mass and energy, so that there is internal energy
    std::string exact_roots;    ///< flows like a root: "'a', 'b'", or empty
};

/// Why the run stopped before its end, and what to try: a sentence for people.
std::string why_it_stopped(const SimulateResult& result);

std::string as_text(const SimulateResult& result);
nlohmann::ordered_json as_json(const SimulateResult& result);

}  // namespace dalembert

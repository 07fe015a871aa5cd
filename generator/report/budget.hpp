// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert cost --budget`: ways to make a step of a controller, and the most accurate one that it has the time for.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/work_precision.hpp"

namespace dalembert {

/// "1 ms step, 20 us": a step of fixed length, and the time that its computation may take.
struct Budget {
    double step;  ///< s
    double time;  ///< s
};

/// One way to make a step of the controller.
struct StepCandidate {
    std::string name, scene, size;  ///< of the run; of the model
    double from_fullest;  ///< what the scene leaves out
    RunPlan plan;
    int parts;            ///< steps of the method in one of the controller
    double time;          ///< s, of one step of the controller
    double slowest;
    double error;         ///< of what is compared: that of the method, and what the scene leaves out
    double of_method;
    std::string status;   ///< empty where it came to the end of the run
    bool fits(const Budget& budget) const { return status.empty() && slowest <= budget.time; }
};

struct BudgetResult {
    std::string model;
    Budget budget;
    std::vector<StepCandidate> candidates;
    std::optional<std::size_t> best;  ///< of the candidates; nothing where none fits
};

std::string as_text(const BudgetResult& result);
nlohmann::ordered_json as_json(const BudgetResult& result);

}  // namespace dalembert

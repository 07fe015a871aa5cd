// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/budget.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

std::string line(const StepCandidate& c) {
    const std::string parts = c.parts > 1 ? fmt::format(" with {} steps in one", c.parts) : "";
    const std::string of_method = c.from_fullest > c.of_method ? fmt::format(", with {:.1e} from the method", c.of_method) : "";
    return fmt::format("{}: {}, {}{}: {:.3g} us a step (slowest run {:.3g}), error {:.1e}{}", c.name, c.plan.arithmetic, c.plan.method,
                       parts, c.time * 1e6, c.slowest * 1e6, c.error, of_method);
}

std::string why_none_fits(const BudgetResult& result) {
    const StepCandidate* fastest = nullptr;
    for (const StepCandidate& c : result.candidates)
        if (c.status.empty() && (fastest == nullptr || c.slowest < fastest->slowest)) fastest = &c;
    if (fastest == nullptr)
        return fmt::format("none reaches the end of the run with steps of {:g} s or parts of them\n", result.budget.step);
    return fmt::format("none fits: the fastest that reaches the end takes {:.3g} us of {:.3g} us\n  {}\n", fastest->slowest * 1e6,
                       result.budget.time * 1e6, line(*fastest));
}

/// All that fit but the best, the most accurate first.
std::vector<const StepCandidate*> others_that_fit(const BudgetResult& result) {
    std::vector<const StepCandidate*> fitting;
    for (std::size_t i = 0; i < result.candidates.size(); ++i)
        if (result.candidates[i].fits(result.budget) && i != result.best) fitting.push_back(&result.candidates[i]);
    std::stable_sort(fitting.begin(), fitting.end(), [](const StepCandidate* a, const StepCandidate* b) { return a->error < b->error; });
    return fitting;
}

nlohmann::ordered_json as_json(const StepCandidate& c, const Budget& budget) {
    return {{"scene", c.scene},
            {"size", c.size},
            {"arithmetic", c.plan.arithmetic},
            {"method", c.plan.method},
            {"parts", c.parts},
            {"microseconds", c.time * 1e6},
            {"slowest", c.slowest * 1e6},
            {"error", c.error},
            {"error_of_method", c.of_method},
            {"status", c.status.empty() ? "success" : c.status},
            {"fits", c.fits(budget)}};
}

}  // namespace

std::string as_text(const BudgetResult& result) {
    std::string text = fmt::format("steps of {:g} s in {:.3g} us on this machine; on a slower controller, the time grows in proportion\n",
                                   result.budget.step, result.budget.time * 1e6);
    text += result.best ? "most accurate that fits: " + line(result.candidates[*result.best]) + "\n" : why_none_fits(result);
    const std::vector<const StepCandidate*> fitting = others_that_fit(result);
    constexpr std::size_t shown = 8;
    if (!fitting.empty()) text += "what fits, too\n";
    for (std::size_t i = 0; i < std::min(shown, fitting.size()); ++i) text += "  " + line(*fitting[i]) + "\n";
    if (fitting.size() > shown) text += fmt::format("  and {} more, less accurate\n", fitting.size() - shown);
    return text;
}

nlohmann::ordered_json as_json(const BudgetResult& result) {
    nlohmann::ordered_json json = json_result("cost", result.model);
    json["budget"] = {{"step", result.budget.step}, {"time", result.budget.time}};
    json["candidates"] = nlohmann::ordered_json::array();
    for (const StepCandidate& c : result.candidates) json["candidates"].push_back(as_json(c, result.budget));
    if (result.best) json["best"] = as_json(result.candidates[*result.best], result.budget);
    return json;
}

}  // namespace dalembert

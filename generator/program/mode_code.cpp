// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/mode_code.hpp"

#include <algorithm>

namespace dalembert {

FunctionBody by_mode(const Scene& scene, const std::vector<FunctionBody>& bodies) {
    FunctionBody result = bodies[0];
    for (const FunctionBody& body : bodies)
        for (std::size_t i = 0; i < body.arguments.size(); ++i)
            result.arguments[i].is_used = result.arguments[i].is_used || body.arguments[i].is_used;
    const bool same =
        std::all_of(bodies.begin(), bodies.end(), [&](const FunctionBody& b) { return b.statements == bodies[0].statements; });
    if (!same) {
        // Modes with the same body stand together; the last ones are also what a compiler takes for a number that is no mode.
        ByMode choice;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            auto known = std::find_if(choice.cases.begin(), choice.cases.end(),
                                      [&](const ByMode::Case& c) { return c.body == bodies[i].statements; });
            if (known == choice.cases.end()) known = choice.cases.insert(known, {{}, bodies[i].statements});
            known->modes.push_back(scene.modes[i].name);
        }
        result.statements = {std::move(choice)};
    }
    const bool is_used = !same || mentions(result.statements, "mode");
    result.arguments.insert(result.arguments.begin(), Argument{"Mode", "mode", Argument::Passing::value, is_used});
    return result;
}

}  // namespace dalembert

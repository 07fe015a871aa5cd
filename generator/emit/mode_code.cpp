// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/mode_code.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>


namespace dalembert {

namespace {

/// Of two lists of arguments that differ in which of them are commented out.
std::string used_in_either(const std::string& a, const std::string& b) {
    std::string result;
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        const std::size_t i_end = std::min(a.find(", ", i), a.size());
        const std::size_t j_end = std::min(b.find(", ", j), b.size());
        const std::string one = a.substr(i, i_end - i), other = b.substr(j, j_end - j);
        result += (result.empty() ? "" : ", ") + (one.find("/*") == std::string::npos ? one : other);
        i = std::min(i_end + 2, a.size());
        j = std::min(j_end + 2, b.size());
    }
    return result;
}

}  // namespace

FunctionBody by_mode(const Scene& scene, const std::vector<FunctionBody>& bodies) {
    FunctionBody result = bodies[0];
    for (const FunctionBody& body : bodies)
        for (std::size_t i = 0; i < body.arguments.size(); ++i) result.arguments[i].is_used = result.arguments[i].is_used || body.arguments[i].is_used;
    const bool same = std::all_of(bodies.begin(), bodies.end(), [&](const FunctionBody& b) { return b.statements == bodies[0].statements; });
    if (!same) {
        // Modes with the same body stand together; the last ones are also what a compiler takes for a number that is no mode.
        ByMode choice;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            auto known = std::find_if(choice.cases.begin(), choice.cases.end(), [&](const ByMode::Case& c) { return c.body == bodies[i].statements; });
            if (known == choice.cases.end()) known = choice.cases.insert(known, {{}, bodies[i].statements});
            known->modes.push_back(scene.modes[i].name);
        }
        result.statements = {std::move(choice)};
    }
    const bool is_used = !same || mentions(result.statements, "mode");
    result.arguments.insert(result.arguments.begin(), Argument{"Mode", "mode", Argument::Passing::value, is_used});
    return result;
}

CppBody by_mode(const Scene& scene, const std::vector<CppBody>& bodies) {
    CppBody result;
    for (std::size_t i = 0; i < bodies.size(); ++i) result.arguments = i == 0 ? bodies[0].arguments : used_in_either(result.arguments, bodies[i].arguments);
    const bool same = std::all_of(bodies.begin(), bodies.end(), [&](const CppBody& b) { return b.statements == bodies[0].statements; });
    if (same) {
        result.statements = bodies[0].statements;
    } else {
        const bool returns = bodies[0].statements.find("return ") != std::string::npos;
        // Modes with the same body stand together; the last ones are also what a compiler takes for a number that is no mode.
        std::vector<std::pair<std::string, const std::string*>> cases;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const auto known = std::find_if(cases.begin(), cases.end(), [&](const auto& c) { return *c.second == bodies[i].statements; });
            const std::string label = fmt::format("            case Mode::{}:", scene.modes[i].name);
            if (known != cases.end()) known->first += "\n" + label;
            else cases.emplace_back(label, &bodies[i].statements);
        }
        cases.back().first += "\n            default:";
        result.statements = "        switch (mode) {\n";
        for (const auto& [labels, statements] : cases)
            result.statements += labels + " {\n" + shifted(shifted(*statements)) + (returns ? "" : "                break;\n") + "            }\n";
        result.statements += "        }\n";
    }
    const bool is_used = !same || result.statements.find("(mode, ") != std::string::npos;
    result.arguments = (is_used ? "Mode mode, " : "Mode /*mode*/, ") + result.arguments;
    return result;
}

}  // namespace dalembert

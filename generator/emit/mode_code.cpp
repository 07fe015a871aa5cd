// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/mode_code.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/notation.hpp"
#include "emit/safe_text.hpp"
#include "emit/template.hpp"

namespace dalembert {

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

std::string mode_tables(const std::vector<const Code*>& machine) {
    const System& system = machine.front()->system;
    const Scene& scene = system.scene;
    std::vector<std::string> modes, mode_names, indices, names;
    for (const SceneMode& mode : scene.modes) {
        modes.push_back(mode.name);
        mode_names.push_back(cpp_string(mode.name));
    }
    for (std::size_t e = 0; e < system.events.size(); ++e) {
        indices.push_back(fmt::format("{} = {}", system.events[e].item != nullptr ? system.events[e].name : fmt::format("limit_{}_", e), e));
        names.push_back(cpp_string(system.events[e].name));
    }
    std::size_t most = 1;
    std::string rows;
    for (std::size_t e = 0; e < system.events.size(); ++e) {
        rows += fmt::format("    std::array<Transition, mode_count>{{{{  // {}\n", system.events[e].name);
        for (std::size_t m = 0; m < machine.size(); ++m) {
            const EventEquation& event = machine[m]->system.events[e];
            const auto list = [&](const std::vector<std::size_t>& to) {
                most = std::max(most, to.size());
                std::vector<std::string> parts;
                for (const std::size_t i : to) parts.push_back("Mode::" + scene.modes[i].name);
                return parts.empty() ? std::string("{}") : fmt::format("{{{{{{{}}}}}, {}}}", fmt::join(parts, ", "), to.size());
            };
            const bool leads = event.is_watched && !event.ends;
            rows += fmt::format("        {{{}, {}, {}, {}}},\n", event.is_watched, leads ? list(scene.modes_after(event.next(), m)) : "{}",
                                leads ? list(scene.modes_beside(*event.item, event.next(), m)) : "{}",
                                leads && !event.item->rest.empty() ? list(scene.modes_after(event.item->rest, m)) : "{}");
        }
        rows += "    }},\n";
    }
    const std::string list_of_indices = indices.empty() ? "" : fmt::format(" enum : std::size_t {{ {} }}; ", fmt::join(indices, ", "));
    return fill_template(embedded_file("mode_tables.hpp.in"), {{"MODES", fmt::format("{}", fmt::join(modes, ", "))},
                                                                           {"MODE_COUNT", std::to_string(modes.size())},
                                                                           {"MODE_NAMES", fmt::format("{}", fmt::join(mode_names, ", "))},
                                                                           {"EVENT_INDICES", list_of_indices},
                                                                           {"EVENT_COUNT", std::to_string(names.size())},
                                                                           {"EVENT_NAMES", fmt::format("{}", fmt::join(names, ", "))},
                                                                           {"MOST_MODES", std::to_string(most)},
                                                                           {"TRANSITIONS", rows.empty() ? "" : "{\n" + rows + "}"}});
}

std::string events_apart(const System& system) {
    const auto list = [&](bool Event::*flag) {
        std::vector<bool> flags;
        for (const EventEquation& event : system.events) flags.push_back(event.item != nullptr && event.item->*flag);
        return flags;
    };
    const std::vector<bool> at_once = list(&Event::at_once), at_start = list(&Event::at_start);
    if (std::find(at_once.begin(), at_once.end(), true) == at_once.end()) return {};
    return fill_template(embedded_file("mode_events_apart.hpp.in"), {{"AT_ONCE", fmt::format("{}", fmt::join(at_once, ", "))}, {"AT_START", fmt::format("{}", fmt::join(at_start, ", "))}});
}

std::vector<std::string> event_equations(const std::vector<const Code*>& machine) {
    std::vector<std::string> result;
    for (std::size_t e = 0; e < machine.front()->system.events.size(); ++e)
        for (const Code* code : machine) {
            const EventEquation& event = code->system.events[e];
            if (!event.is_watched) continue;
            result.push_back(fmt::format("{}: {} in the mode {}", event.name, Notation(code->system.symbols, Style::text)(event.guard), code->system.scene.modes[*code->system.scene.mode].name));
            break;
        }
    return result;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header_equations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/equations.hpp"
#include "graph/notation.hpp"

namespace dalembert {

namespace {

/// Equations as they are in the modes.
template <class Make>
std::vector<std::string> in_modes(const std::vector<const Code*>& modes, const Make& make) {
    std::vector<std::vector<std::string>> of_mode;
    for (const Code* code : modes) of_mode.push_back(make(code->system, Notation(code->system.symbols, Style::text)));
    const bool same = std::all_of(of_mode.begin(), of_mode.end(), [&](const auto& l) { return l == of_mode.front(); });
    if (same) return of_mode.front();
    std::vector<std::string> all;
    for (std::size_t m = 0; m < of_mode.size(); ++m) {
        all.push_back(fmt::format("In the mode {}:", modes.front()->system.scene.modes[m].name));
        all.insert(all.end(), of_mode[m].begin(), of_mode[m].end());
    }
    return all;
}

std::vector<std::string> written_motion(const System& s, const Notation& write) {
    std::vector<std::string> motion;
    for (const auto& [letter, value] : s.named.names) motion.push_back(fmt::format("{} = {}", write(letter), write(value)));
    for (const auto& [left, right] : motion_equations(s)) motion.push_back(fmt::format("{} = {}", write(left), write(right)));
    for (std::size_t i = 0; i < s.state_rates.size(); ++i)
        motion.push_back(fmt::format("{} = {}", rate_of_state(s, i), write(s.named.state_rates[i])));
    return motion;
}

/// What stands on the left, by value.
std::vector<std::string> left_sides(const HeaderFunction& row, const System& s) {
    if (row.kind == HeaderFunction::Kind::number) return {row.letter};
    const std::vector<std::string> names = row.names(s);
    std::vector<std::string> result;
    const bool is_triangle = row.kind == HeaderFunction::Kind::symmetric;
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = is_triangle ? 0 : i; j <= i; ++j)
            result.push_back(is_triangle          ? fmt::format("{}[{}, {}]", row.letter, names[j], names[i])
                             : *row.letter != 0 ? fmt::format("{}[{}]", row.letter, names[i])
                                                  : names[i]);
    return result;
}

/// The guard of each event, in the first mode that watches it.
std::vector<std::string> event_equations(const std::vector<const Code*>& machine) {
    std::vector<std::string> result;
    for (std::size_t e = 0; e < machine.front()->system.events.size(); ++e)
        for (const Code* code : machine) {
            const EventEquation& event = code->system.events[e];
            if (!event.is_watched) continue;
            result.push_back(fmt::format("{}: {} in the mode {}", event.name, Notation(code->system.symbols, Style::text)(event.guard),
                                         code->system.scene.modes[*code->system.scene.mode].name));
            break;
        }
    return result;
}

/// What the constraints hold at zero, as all modes write it.
void add_constraints(std::map<Function, std::vector<std::string>>& result, const System& s) {
    const Notation write(s.symbols, Style::text);
    for (const ConstraintEquation& c : s.constraints) {
        if (c.position) result[Function::constraint_positions].push_back(fmt::format("{}: {} = 0", c.name, write(*c.position)));
        result[Function::constraint_rates].push_back(fmt::format("{}: {} = 0", c.name, write(c.whole_rate)));
    }
}

}  // namespace

std::map<Function, std::vector<std::string>> header_equations(const std::vector<const Code*>& modes) {
    std::map<Function, std::vector<std::string>> result;
    const bool is_large = modes.front()->system.symbols.degrees() > 8;
    for (const HeaderFunction& row : header_functions()) {
        if (!row.has_equations || (is_large && row.function != Function::output)) continue;
        result[row.function] = in_modes(modes, [&](const System& s, const Notation& write) {
            if (row.kind == HeaderFunction::Kind::motion) return written_motion(s, write);
            const std::vector<std::string> left = left_sides(row, s);
            const bool is_sample = row.kind == HeaderFunction::Kind::sample;
            const std::vector<GiNaC::ex> right = (is_sample ? header_function(Function::output) : row).shown_values(s);
            std::vector<std::string> rows;
            if (is_sample) rows = written_motion(s, write);
            for (std::size_t i = 0; i < right.size(); ++i) rows.push_back(fmt::format("{} = {}", left[i], write(right[i])));
            return rows;
        });
    }
    result[Function::events] = event_equations(modes);
    add_constraints(result, modes.front()->system);
    return result;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header_equations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/equations.hpp"
#include "emit/notation.hpp"

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
        motion.push_back(fmt::format("dot({}) = {}", s.symbols.all(SymbolKind::state)[i].name, write(s.named.state_rates[i])));
    return motion;
}

}  // namespace

std::map<Function, std::vector<std::string>> header_equations(const std::vector<const Code*>& modes) {
    std::map<Function, std::vector<std::string>> result;
    const std::size_t n = modes.front()->system.symbols.degrees();
    const bool is_large = n > 8;
    const auto of_coordinates = [&](Function function, const auto& row) {
        if (is_large) return;
        result[function] = in_modes(modes, [&](const System& s, const Notation& write) {
            std::vector<std::string> rows;
            for (std::size_t j = 0; j < n; ++j) row(s, write, j, rows);
            return rows;
        });
    };
    if (!is_large) result[Function::rhs] = in_modes(modes, written_motion);
    of_coordinates(Function::mass_matrix, [](const System& s, const Notation& write, std::size_t j, auto& rows) {
        const auto& q = s.symbols.all(SymbolKind::coordinate);
        for (std::size_t l = 0; l <= j; ++l)
            rows.push_back(
                fmt::format("M[{}, {}] = {}", q[l].name, q[j].name, write(s.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)))));
    });
    of_coordinates(Function::bias, [](const System& s, const Notation& write, std::size_t j, auto& rows) {
        rows.push_back(fmt::format("bias[{}] = {}", s.symbols.all(SymbolKind::coordinate)[j].name, write(s.bias[j])));
    });
    of_coordinates(Function::generalised_force, [](const System& s, const Notation& write, std::size_t j, auto& rows) {
        rows.push_back(fmt::format("Q[{}] = {}", s.symbols.all(SymbolKind::coordinate)[j].name, write(s.supplied[j])));
    });
    result[Function::output] = in_modes(modes, [](const System& s, const Notation& write) {
        std::vector<std::string> rows;
        for (const OutputEquation& o : s.outputs) rows.push_back(fmt::format("{} = {}", o.name, write(o.shown())));
        return rows;
    });
    const auto scalar = [&](Function function, const char* letter, const auto& value) {
        if (is_large) return;
        result[function] = in_modes(modes, [&](const System& s, const Notation& write) {
            return std::vector<std::string>{fmt::format("{} = {}", letter, write(value(s)))};
        });
    };
    scalar(Function::kinetic_energy, "T", [](const System& s) { return s.kinetic_energy; });
    scalar(Function::potential_energy, "V", [](const System& s) { return s.potential_energy; });
    scalar(Function::internal_energy, "E", [](const System& s) { return s.named.internal_energy; });
    scalar(Function::supplied_power, "supplied", [](const System& s) { return s.supplied_power; });
    scalar(Function::dissipated_power, "dissipated", [](const System& s) { return s.dissipated_power; });
    return result;
}

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

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header_equations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/equations.hpp"
#include "emit/notation.hpp"
#include "emit/safe_text.hpp"

namespace dalembert {

namespace {

constexpr std::size_t longest_equations = 8000;
const std::string too_long = "    /// (Too long to be printed here; `dalembert derive` prints the equations.)\n";

/// Equations as they are in the modes.
template <class Make>
std::string in_modes(const std::vector<const Code*>& modes, const Make& make) {
    std::vector<std::vector<std::string>> of_mode;
    for (const Code* code : modes) of_mode.push_back(make(code->system, Notation(code->system.symbols, Style::text)));
    const bool same = std::all_of(of_mode.begin(), of_mode.end(), [&](const auto& l) { return l == of_mode.front(); });
    if (same) return comment_lines(of_mode.front());
    std::vector<std::string> all;
    for (std::size_t m = 0; m < of_mode.size(); ++m) {
        all.push_back(fmt::format("In the mode {}:", modes.front()->system.scene.modes[m].name));
        all.insert(all.end(), of_mode[m].begin(), of_mode[m].end());
    }
    return comment_lines(all);
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

std::string comment_lines(const std::vector<std::string>& equations) {
    std::size_t length = 0;
    for (const std::string& e : equations) length += e.size();
    if (length > longest_equations) return too_long;
    std::string text;
    for (const std::string& e : equations) text += cpp_comment("    " + e, 4);
    return text;
}

std::map<std::string, std::string> header_equations(const std::vector<const Code*>& modes) {
    std::map<std::string, std::string> texts;
    const auto values = [&](const char* name, std::string text) { texts[name] = std::move(text); };
    const std::size_t n = modes.front()->system.symbols.degrees();
    const bool is_large = n > 8;
    const auto of_coordinates = [&](const char* name, const auto& row) {
        values(name, is_large ? too_long : in_modes(modes, [&](const System& s, const Notation& write) {
            std::vector<std::string> result;
            for (std::size_t j = 0; j < n; ++j) row(s, write, j, result);
            return result;
        }));
    };
    values("EQUATIONS", is_large ? too_long : in_modes(modes, written_motion));
    of_coordinates("MASS_EQUATIONS", [](const System& s, const Notation& write, std::size_t j, auto& result) {
        const auto& q = s.symbols.all(SymbolKind::coordinate);
        for (std::size_t l = 0; l <= j; ++l) result.push_back(fmt::format("M[{}, {}] = {}", q[l].name, q[j].name, write(s.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)))));
    });
    of_coordinates("BIAS_EQUATIONS", [](const System& s, const Notation& write, std::size_t j, auto& result) {
        result.push_back(fmt::format("bias[{}] = {}", s.symbols.all(SymbolKind::coordinate)[j].name, write(s.bias[j])));
    });
    of_coordinates("FORCE_EQUATIONS", [](const System& s, const Notation& write, std::size_t j, auto& result) {
        result.push_back(fmt::format("Q[{}] = {}", s.symbols.all(SymbolKind::coordinate)[j].name, write(s.supplied[j])));
    });
    values("OUTPUT_EQUATIONS", in_modes(modes, [](const System& s, const Notation& write) {
        std::vector<std::string> result;
        for (const OutputEquation& o : s.outputs) result.push_back(fmt::format("{} = {}", o.name, write(o.shown())));
        return result;
    }));
    const auto scalar = [&](const char* name, const char* letter, const auto& value) {
        values(name, is_large ? too_long : in_modes(modes, [&](const System& s, const Notation& write) { return std::vector<std::string>{fmt::format("{} = {}", letter, write(value(s)))}; }));
    };
    scalar("KINETIC_ENERGY_EQUATIONS", "T", [](const System& s) { return s.kinetic_energy; });
    scalar("POTENTIAL_ENERGY_EQUATIONS", "V", [](const System& s) { return s.potential_energy; });
    scalar("INTERNAL_ENERGY_EQUATIONS", "E", [](const System& s) { return s.named.internal_energy; });
    scalar("SUPPLIED_POWER_EQUATIONS", "supplied", [](const System& s) { return s.supplied_power; });
    scalar("DISSIPATED_POWER_EQUATIONS", "dissipated", [](const System& s) { return s.dissipated_power; });
    return texts;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/equations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "form/linear_system.hpp"
#include "prove/definiteness.hpp"

#include "elements/model.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

bool is_constrained(const System& s) {
    return std::any_of(s.constraints.begin(), s.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
}

struct NamedPart {
    const char* key;
    const char* title;
    const Generalised& values;
};

const char* title_of_bias(const System& s) {
    if (s.circuit.empty())
        return s.fluids.empty() ? "bias = c - gravity - elastic - dissipative" : "bias = c - gravity - elastic - dissipative - fluid";
    return s.fluids.empty() ? "bias = c - gravity - elastic - dissipative - circuit"
                            : "bias = c - gravity - elastic - dissipative - fluid - circuit";
}

/// The parts of the equations that have one entry a coordinate.
std::vector<NamedPart> parts(const System& s) {
    std::vector<NamedPart> all{{"coriolis", "Coriolis and centrifugal forces c", s.coriolis},
                               {"gravity", "generalised forces of gravity", s.gravity},
                               {"elastic", "generalised forces of springs and potentials", s.elastic},
                               {"dissipative", "generalised forces of dampers", s.dissipative},
                               {"fluid", "generalised forces of fluids: p*dV/dq, shafts of pumps", s.fluids.force}};
    if (!s.circuit.empty())
        all.push_back({"circuit", "generalised forces of circuits: k*i of motors, i^2/2*dL/dq, u^2/2*dC/dq", s.circuit.force});
    all.push_back({"bias", title_of_bias(s), s.bias});
    all.push_back({"generalised_force", "Q, generalised forces of forces, torques and inputs", s.supplied});
    return all;
}

bool all_zero(const Generalised& values) {
    for (const ex& value : values)
        if (!value.is_zero()) return false;
    return true;
}

std::vector<std::pair<const char*, ex>> scalars(const System& s) {
    return {{"kinetic_energy", s.kinetic_energy},
            {"potential_energy", s.potential_energy},
            {"supplied_power", s.supplied_power},
            {"dissipated_power", s.dissipated_power},
            {"prescribed_power", s.prescribed_power}};
}

nlohmann::ordered_json constraints_as_json(const System& s, const Notation& write) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ConstraintEquation& c : s.constraints)
        if (c.holds)
            json.push_back({{"name", c.name},
                            {"position", c.position ? write(*c.position) : ""},
                            {"rate", write(c.whole_rate)},
                            {"force", write(c.force)}});
    return json;
}

/// What constraints hold and bear in this mode.
std::string constrained(const System& s, const Notation& write) {
    if (!is_constrained(s)) return {};
    std::string text = "\nconstraints, and their force along the rate\n";
    for (const ConstraintEquation& c : s.constraints) {
        if (!c.holds) continue;
        const std::string force = c.is_redundant
                                      ? (c.has_multiplier ? "unknown, or zero: follows from the others" : "zero: follows from the others")
                                  : c.has_multiplier ? "unknown"
                                                     : write(c.force);
        text += fmt::format("  {}: {} = 0, force {}\n", c.name, write(c.position ? *c.position : c.whole_rate), force);
    }
    return text;
}

/// D, C, B and k of a linear system, with what is known of M, D and C; nothing of others.
std::string linear_as_text(const System& s, const Notation& write) {
    const auto linear = linear_system(s).system;
    if (!linear) return {};
    const auto& q = s.symbols.all(SymbolKind::coordinate);
    std::string text = "\nlinear: M*ddot(q) + D*dot(q) + C*q = k + B*u\n";
    const auto matrix = [&](const char* name, const GiNaC::matrix& A, const std::vector<Variable>& columns) {
        for (unsigned i = 0; i < A.rows(); ++i)
            for (unsigned j = 0; j < A.cols(); ++j)
                if (!A(i, j).is_zero()) text += fmt::format("    {}[{}, {}] = {}\n", name, q[i].name, columns[j].name, write(A(i, j)));
    };
    for (const auto& [name, A] : {std::pair{"M", &linear->M}, std::pair{"D", &linear->D}, std::pair{"C", &linear->C}}) {
        text += fmt::format("  {} {}\n", name, definiteness(*A, s).sentence());
        if (A != &linear->M) matrix(name, *A, q);
    }
    if (!s.symbols.all(SymbolKind::input).empty()) text += "  B\n";
    matrix("B", linear->B, s.symbols.all(SymbolKind::input));
    if (!all_zero(linear->k)) text += "  k\n";
    for (std::size_t i = 0; i < q.size(); ++i)
        if (!linear->k[i].is_zero()) text += fmt::format("    [{}] {}\n", q[i].name, write(linear->k[i]));
    return text;
}

nlohmann::ordered_json matrix_as_json(const GiNaC::matrix& A, const Notation& write) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (unsigned i = 0; i < A.rows(); ++i) {
        nlohmann::ordered_json row = nlohmann::ordered_json::array();
        for (unsigned j = 0; j < A.cols(); ++j) row.push_back(write(A(i, j)));
        rows.push_back(std::move(row));
    }
    return rows;
}

void add_linear(nlohmann::ordered_json& json, const System& s, const Notation& write) {
    const auto linear = linear_system(s).system;
    if (!linear) return;
    nlohmann::ordered_json& result = json["linear"];
    result = {{"D", matrix_as_json(linear->D, write)},
              {"C", matrix_as_json(linear->C, write)},
              {"B", matrix_as_json(linear->B, write)},
              {"k", nlohmann::ordered_json::array()}};
    for (const ex& value : linear->k) result["k"].push_back(write(value));
    for (const auto& [name, A] : {std::pair{"M", &linear->M}, std::pair{"D", &linear->D}, std::pair{"C", &linear->C}}) {
        const DefinitenessVerdict verdict = definiteness(*A, s);
        result["definiteness"][name] = {{"kind", verdict.kind}, {"proven", verdict.is_proven}, {"where", verdict.where}};
    }
}

/// Events that are watched in this mode, and where they lead.
std::string events(const System& s, const Notation& write) {
    std::string text;
    for (const EventEquation& event : s.events) {
        if (!event.is_watched) continue;
        std::string next = event.ends ? "the run ends" : "";
        if (!event.ends)
            for (const std::size_t mode : s.scene.modes_after(event.next(), *s.scene.mode))
                next += (next.empty() ? "" : ", else ") + s.scene.modes[mode].name;
        text += fmt::format("  {}: {} -> {}\n", event.name, write(event.guard), next);
    }
    return text.empty() ? text : "\nevents: where this falls through zero -> mode afterwards\n" + text;
}

}  // namespace

std::vector<std::pair<ex, ex>> motion_equations(const System& s) {
    std::vector<std::pair<ex, ex>> result;
    const bool is_free = s.motion.accelerations.empty();
    const std::vector<std::size_t>& free = s.motion.free;  // in the order of the solve
    for (std::size_t j = 0; j < s.symbols.all(SymbolKind::coordinate).size(); ++j) {
        const auto row = std::find(free.begin(), free.end(), j);
        if (row == free.end()) continue;
        const auto i = static_cast<std::size_t>(row - free.begin());
        const ex& right = is_free ? s.supplied[j] : s.motion.force[i];
        result.emplace_back(s.motion.residual[i] + right, right);
    }
    for (const auto& [coordinate, acceleration] : s.motion.accelerations)
        result.emplace_back(s.symbols.get(SymbolKind::acceleration, coordinate), acceleration);
    return result;
}

std::string rate_of_state(const System& s, std::size_t state) {
    return fmt::format("{}({})", s.scene.sampling == nullptr ? "dot" : "next", s.symbols.all(SymbolKind::state)[state].name);
}

std::string equations_as_text(const System& s) {
    const Notation write(s.symbols, Style::text);
    const auto& q = s.symbols.all(SymbolKind::coordinate);
    std::string text = fmt::format("{}, scene {}{}\n", s.scene.sized_name(), s.scene.name,
                                   s.scene.mode ? ", mode " + s.scene.modes[*s.scene.mode].name : "");
    if (!s.scene.model->title.empty()) text += safe_line(s.scene.model->title) + "\n";
    const auto& definitions = s.symbols.all(SymbolKind::definition);
    if (!definitions.empty()) text += "\nwith\n";
    for (std::size_t i = 0; i < definitions.size(); ++i)
        text += fmt::format("  {} = {}\n", definitions[i].name, write(s.symbols.definition_values()[i]));
    if (!q.empty()) {
        text += fmt::format("\nequations of motion  M*ddot(q) + bias = Q{}\n", is_constrained(s) ? " + forces of constraints" : "");
        for (const auto& [left, right] : motion_equations(s)) text += fmt::format("  {} = {}\n", write(left), write(right));
        text += constrained(s, write);
        text += "\nmass matrix M\n";
        for (std::size_t i = 0; i < q.size(); ++i)
            for (std::size_t j = i; j < q.size(); ++j) {
                const ex& entry = s.mass(static_cast<unsigned>(i), static_cast<unsigned>(j));
                if (!entry.is_zero()) text += fmt::format("  M[{}, {}] = {}\n", q[i].name, q[j].name, write(entry));
            }
        for (const NamedPart& part : parts(s)) {
            if (all_zero(part.values)) continue;
            text += fmt::format("\n{}\n", part.title);
            for (std::size_t j = 0; j < q.size(); ++j) text += fmt::format("  [{}] {}\n", q[j].name, write(part.values[j]));
        }
    }
    text += linear_as_text(s, write);
    if (!s.named.names.empty()) text += "\nflows and media\n";
    for (const auto& [letter, value] : s.named.names) text += fmt::format("  {} = {}\n", write(letter), write(value));
    if (!s.named.balanced.empty()) text += "\ntemperatures that follow from balances\n";
    for (const auto& [letter, heat] : s.named.balanced) text += fmt::format("  {}: 0 = {}\n", write(letter), write(heat));
    if (!s.named.junctions.empty()) text += "\npressures of junctions that follow from balances\n";
    for (const auto& [letter, inflow] : s.named.junctions) text += fmt::format("  {}: 0 = {}\n", write(letter), write(inflow));
    if (!s.state_rates.empty()) text += "\nstates\n";
    for (std::size_t i = 0; i < s.state_rates.size(); ++i)
        text += fmt::format("  {} = {}\n", rate_of_state(s, i), write(s.named.state_rates[i]));
    for (const CellField& f : s.heat.fields) {
        text += fmt::format("\n{} {}: {} cells in a loop; what stands above of its cells comes from elsewhere and is added\n", f.kind,
                            f.body->name, f.cells);
        for (const FieldPart& part : f.parts()) text += fmt::format("  {} = {}\n", f.title(part), write(part.value));
        text += "  " + f.balance() + "\n";
    }
    const bool has_energy = s.scene.sampling == nullptr;
    if (has_energy) text += "\nenergies and powers\n";
    for (const auto& [name, value] : has_energy ? scalars(s) : decltype(scalars(s)){})
        text += fmt::format("  {} = {}\n", name, write(value));
    const auto of_cells = [&](const char* name, GiNaC::ex CellLaw::* what) {
        std::string sums;
        for (const CellField& f : s.heat.fields)
            if (std::any_of(f.laws.begin(), f.laws.end(), [&](const CellLaw& law) { return !(law.*what).is_zero(); }))
                sums += fmt::format(" + sum of {} over the cells of {}", name, f.body->name);
        return sums;
    };
    std::string through_sides;
    for (const CellField& f : s.heat.fields)
        if (!f.sides.empty()) through_sides += fmt::format(" + sum of heat through sides of {}", f.body->name);
    if (s.has_balances())
        text += fmt::format("  internal_energy = {}{}\n", write(s.named.internal_energy), of_cells("energy", &CellLaw::energy));
    if (s.has_exchange())
        text += fmt::format("  exchanged_power = {}{}{}\n", write(s.named.exchanged_power), of_cells("source", &CellLaw::source),
                            through_sides);
    if (!s.guards.empty())
        text += "\nguards: a run ends where one becomes negative, or the right-hand side has an edge where its sign changes\n";
    for (const Guard& guard : s.guards) text += fmt::format("  {} ({}): {}\n", guard.doc, guard.ends ? "ends" : "edge", write(guard.value));
    text += events(s, write);
    if (!s.outputs.empty()) text += "\noutputs\n";
    for (const OutputEquation& output : s.outputs)
        text += fmt::format("  {} = {}\n", output.name, write(s.named.shortened(output.shown())));
    return text;
}

std::string equations_as_latex(const System& s) {
    const Notation write(s.symbols, Style::latex);
    const auto& definitions = s.symbols.all(SymbolKind::definition);
    std::string text = fmt::format("% {}, scene {}{}\n", s.scene.sized_name(), s.scene.name,
                                   s.scene.mode ? ", mode " + s.scene.modes[*s.scene.mode].name : "");
    const auto aligned = [&](const std::vector<std::string>& lines) {
        if (lines.empty()) return;
        text += "\\begin{align}\n";
        for (std::size_t i = 0; i < lines.size(); ++i) text += "  " + lines[i] + (i + 1 < lines.size() ? " \\\\\n" : "\n");
        text += "\\end{align}\n";
    };
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < definitions.size(); ++i)
        lines.push_back(fmt::format("{} &= {}", write.symbol(definitions[i]), write(s.symbols.definition_values()[i])));
    aligned(lines);
    lines.clear();
    for (const auto& [left, right] : motion_equations(s)) lines.push_back(fmt::format("{} &= {}", write(left), write(right)));
    for (const ConstraintEquation& c : s.constraints)
        if (c.has_multiplier) lines.push_back(fmt::format("0 &= {}", write(c.position ? *c.position : c.whole_rate)));
    for (const auto& [letter, value] : s.named.names) lines.push_back(fmt::format("{} &= {}", write(letter), write(value)));
    for (const auto* balances : {&s.named.balanced, &s.named.junctions})
        for (const auto& [letter, sum] : *balances) lines.push_back(fmt::format("0 &= {} \\quad ({})", write(sum), write(letter)));
    for (std::size_t i = 0; i < s.state_rates.size(); ++i)
        lines.push_back(fmt::format("{} &= {}",
                                    s.scene.sampling == nullptr ? write.symbol(s.symbols.all(SymbolKind::state_rate)[i])
                                                                : write.symbol(s.symbols.all(SymbolKind::state)[i]) + "^{+}",
                                    write(s.named.state_rates[i])));
    for (const CellField& f : s.heat.fields)
        for (const FieldPart& part : f.parts())
            lines.push_back(fmt::format("\\text{{{}, {}}} &= {}", f.body->name, f.title(part), write(part.value)));
    aligned(lines);
    lines.clear();
    if (s.scene.sampling == nullptr)
        lines = {fmt::format("T &= {}", write(s.kinetic_energy)), fmt::format("V &= {}", write(s.potential_energy))};
    for (const OutputEquation& output : s.outputs)
        lines.push_back(fmt::format("{} &= {}", latex_name(output.base), write(s.named.shortened(output.shown()))));
    aligned(lines);
    return text;
}

nlohmann::ordered_json equations_as_json(const System& s) {
    const Notation write(s.symbols, Style::text);
    nlohmann::ordered_json json;
    const auto& q = s.symbols.all(SymbolKind::coordinate);
    const auto& definitions = s.symbols.all(SymbolKind::definition);
    json["definitions"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < definitions.size(); ++i) json["definitions"][definitions[i].name] = write(s.symbols.definition_values()[i]);
    json["coordinates"] = nlohmann::ordered_json::array();
    for (const Variable& variable : q) json["coordinates"].push_back(variable.name);
    json["equations"] = nlohmann::ordered_json::array();
    for (std::size_t j = 0; j < q.size(); ++j)
        json["equations"].push_back(
            {{"coordinate", q[j].name}, {"left", write(s.residual[j] + s.supplied[j])}, {"right", write(s.supplied[j])}});
    json["constraints"] = constraints_as_json(s, write);
    json["mass_matrix"] = q.empty() ? nlohmann::ordered_json::array() : matrix_as_json(s.mass, write);
    for (const NamedPart& part : parts(s)) {
        json[part.key] = nlohmann::ordered_json::array();
        for (const ex& value : part.values) json[part.key].push_back(write(value));
    }
    add_linear(json, s, write);
    json["state_rates"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < s.state_rates.size(); ++i)
        json["state_rates"][s.symbols.all(SymbolKind::state)[i].name] = write(s.state_rates[i]);
    json["rods"] = nlohmann::ordered_json::array();
    json["blocks"] = nlohmann::ordered_json::array();
    for (const CellField& f : s.heat.fields) {
        nlohmann::ordered_json field{{"name", f.body->name}, {"cells", f.cells}};
        if (!f.is_block()) {
            for (const FieldPart& part : f.parts()) field[part.key] = write(part.value);
            json["rods"].push_back(std::move(field));
            continue;
        }
        field["parts"] = nlohmann::ordered_json::array();
        for (const FieldPart& part : f.parts())
            field["parts"].push_back({{"title", f.title(part)}, {"value", write(part.value)}});
        json["blocks"].push_back(std::move(field));
    }
    for (const auto& [name, value] : scalars(s)) json[name] = write(value);
    json["internal_energy"] = write(s.internal_energy);
    json["exchanged_power"] = write(s.exchanged_power);
    json["guards"] = nlohmann::ordered_json::array();
    for (const Guard& guard : s.guards)
        json["guards"].push_back({{"name", guard.name}, {"doc", guard.doc}, {"ends", guard.ends}, {"value", write(guard.value)}});
    json["outputs"] = nlohmann::ordered_json::object();
    for (const OutputEquation& output : s.outputs) json["outputs"][output.name] = write(output.shown());
    return json;
}

nlohmann::ordered_json mode_as_json(const System& s) {
    const Notation write(s.symbols, Style::text);
    nlohmann::ordered_json json{{"mode", s.scene.modes[*s.scene.mode].name}, {"equations", nlohmann::ordered_json::array()}};
    for (const auto& [left, right] : motion_equations(s)) json["equations"].push_back({{"left", write(left)}, {"right", write(right)}});
    json["state_rates"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < s.state_rates.size(); ++i)
        json["state_rates"][s.symbols.all(SymbolKind::state)[i].name] = write(s.state_rates[i]);
    json["constraints"] = constraints_as_json(s, write);
    json["events"] = nlohmann::ordered_json::array();
    for (const EventEquation& event : s.events) {
        if (!event.is_watched) continue;
        json["events"].push_back(
            {{"name", event.name}, {"guard", write(event.guard)}, {"ends", event.ends}, {"next", nlohmann::ordered_json::array()}});
        if (event.ends) continue;
        for (const std::size_t mode : s.scene.modes_after(event.next(), *s.scene.mode))
            json["events"].back()["next"].push_back(s.scene.modes[mode].name);
    }
    return json;
}

}  // namespace dalembert

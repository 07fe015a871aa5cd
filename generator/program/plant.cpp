// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "text/safe_text.hpp"

namespace dalembert {

std::size_t PlantCurve::size() const {
    std::size_t size = 0;
    for (const std::vector<Value>& row : rows) size += row.size();
    return size;
}

std::string PlantCurve::header() const {
    return fmt::format("Curve '{}'{}{}: {}", name, doc.empty() ? "" : ", ", safe_line(doc),
                       has_two_variables ? "steps and knots of both variables, places of both, and the coefficients of each cell."
                                         : "steps and knots; for each piece its place, the integral up to there, and coefficients.");
}

std::size_t PlantModes::most_modes() const {
    std::size_t most = 1;
    for (const auto& row : transitions)
        for (const PlantTransition& to : row) most = std::max({most, to.next.size(), to.beside.size(), to.rest.size()});
    return most;
}

namespace {

/// df/dx: neighbours in a rod or block, and what the core has there.
PlantPattern pattern_of(const PlantPattern& core, const PlantFields& fields) {
    PlantPattern result;
    result.is_sparse = true;
    result.rows = result.columns = fields.states;
    result.column_starts.push_back(0);
    for (std::size_t column = 0; column < fields.states; ++column) {
        std::set<std::size_t> rows;
        for (const PlantField& field : fields.list)
            if (column >= field.first && column < field.first + field.cells) {
                const std::size_t cell = column - field.first;
                if (cell >= field.columns) rows.insert(column - field.columns);
                if (cell % field.columns > 0) rows.insert(column - 1);
                rows.insert(column);
                if ((cell + 1) % field.columns > 0) rows.insert(column + 1);
                if (cell + field.columns < field.cells) rows.insert(column + field.columns);
            }
        const auto place = std::lower_bound(fields.positions.begin(), fields.positions.end(), column);
        if (place != fields.positions.end() && *place == column) {
            const auto c = static_cast<std::size_t>(place - fields.positions.begin());
            for (std::size_t i = core.column_starts[c]; i < core.column_starts[c + 1]; ++i)
                rows.insert(fields.positions[core.row_indices[i]]);
        }
        result.row_indices.insert(result.row_indices.end(), rows.begin(), rows.end());
        result.column_starts.push_back(result.row_indices.size());
    }
    return result;
}

PlantPattern full_pattern(std::size_t rows, std::size_t columns) {
    PlantPattern pattern{false, rows, columns, {0}, {}};
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t r = 0; r < rows; ++r) pattern.row_indices.push_back(r);
        pattern.column_starts.push_back(pattern.row_indices.size());
    }
    return pattern;
}

}  // namespace

Plant whole_plant(const Plant& core, const PlantFields& fields) {
    Plant whole = core;
    whole.functions.clear();
    whole.constraint_functions.clear();
    whole.plain_states = fields.plain_states;
    whole.states.assign(fields.states, {});
    for (std::size_t i = 0; i < fields.positions.size(); ++i) whole.states[fields.positions[i]] = core.states[i];
    for (const PlantField& field : fields.list)
        for (std::size_t k = 0; k < field.cells; ++k) {
            PlantQuantity& cell = whole.states[field.first + k];
            cell = field.states;
            cell.name += "[" + std::to_string(field.first_number + static_cast<int>(k)) + "]";
        }
    whole.by_state = pattern_of(core.by_state, fields);
    whole.by_input = full_pattern(fields.states, core.inputs.size());
    whole.by_parameter = full_pattern(fields.states, core.parameters.size());
    return whole;
}

std::size_t size_of(const Plant& plant, const std::string& vector) {
    const std::size_t states = plant.states.size(), inputs = plant.inputs.size(), outputs = plant.outputs.size(),
                      guards = plant.guards.size(), n = plant.degrees;
    const std::size_t constraints = plant.constraints ? plant.constraints->list.size() : 0;
    const std::map<std::string, std::size_t> sizes{
        {"State", states},        {"Input", inputs},           {"Output", outputs},
        {"Generalised", n},       {"MassMatrix", n * n},       {"Guards", guards},
        {"Kinks", guards},        {"Events", plant.modes ? plant.modes->events.size() : 0},
        {"TimeSwitches", 2 * plant.time_switches},
        {"JacobianX", plant.by_state.size()},                  {"JacobianU", plant.by_input.size()},
        {"JacobianP", plant.by_parameter.size()},              {"JacobianT", states},
        {"OutputJacobianX", outputs * states},                 {"OutputJacobianU", outputs * inputs},
        {"Constraints", constraints},                          {"ConstraintJacobian", constraints * n},
        {"OutputJacobianP", outputs * plant.parameters.size()}, {"OutputJacobianT", outputs},
        {"Hessian", (states + inputs) * (states + inputs)}};
    const auto found = sizes.find(vector);
    if (found == sizes.end()) throw std::logic_error("a vector that plants do not have: " + vector);
    return found->second;
}

}  // namespace dalembert

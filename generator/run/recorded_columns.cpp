// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/recorded_columns.hpp"

#include "elements/model.hpp"
#include "pipeline.hpp"

namespace dalembert {

namespace {

std::string si(const std::string& unit) { return unit == "1" ? "" : unit; }

/// "speed_z": the states of its controller.
void add_states(const Sampler& sampler, std::vector<RecordedColumn>& columns) {
    const LoadedModel controller(*sampler.controller);
    const Scene scene = select_scene(controller.model, controller.names, "", {});
    const std::string prefix = sampler.name + "_";
    for (const Variable* state : Symbols(scene, controller.names).state_variables())
        columns.push_back({prefix + state->name, prefix + state->base, si(state->unit)});
}

}  // namespace

std::vector<RecordedColumn> recorded_columns(const System& system) {
    std::vector<RecordedColumn> columns{{"t", "t", "s"}};
    for (const Variable* state : system.symbols.state_variables())
        columns.push_back({state->recorded_name(), state->kind == SymbolKind::velocity ? "dot(" + state->base + ")" : state->base,
                           si(state->is_root ? state->declared->unit.si() : state->unit)});
    for (const OutputEquation& output : system.outputs) columns.push_back({output.name, output.base, si(output.unit)});
    for (const Variable& input : system.symbols.all(SymbolKind::input)) columns.push_back({input.name, input.base, si(input.unit)});
    for (const Sampler* sampler : system.scene.samplers) add_states(*sampler, columns);
    for (const char* energy : recorded_energies) columns.push_back({energy, energy, "J"});
    columns.push_back({"work", "work", "J"});
    if (!system.scene.modes.empty()) columns.push_back({"mode", "mode", ""});
    return columns;
}

std::vector<std::string> recorded_names(const std::string& name, const System& system) {
    std::vector<std::string> names;
    for (const RecordedColumn& column : recorded_columns(system))
        if (column.name != "mode" && (column.name == name || column.family == name)) names.push_back(column.name);
    return names;
}

}  // namespace dalembert

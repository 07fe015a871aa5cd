// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/modal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "plant/modal.hpp"
#include "run/plant_run.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"
#include "form/linear_system.hpp"

namespace dalembert {

namespace {

/// Modal forms are of machines with coordinates, whose forces know no further states.
void refuse_other_machines(const System& system) {
    for (const ConstraintEquation& constraint : system.constraints)
        if (constraint.item->share)
            throw Failure(Diagnostic{Id::not_allowed_here, constraint.item->span,
                                     fmt::format("friction '{}' has a state instead of modes, so there is no mode in which to linearise "
                                                 "the machine; with fewer frictions it has modes",
                                                 constraint.name)});
    const Scene& scene = system.scene;
    const auto refuse = [&](const Span& place, std::string why) { throw Failure(Diagnostic{Id::not_allowed_here, place, std::move(why)}); };
    const auto& q = system.symbols.all(SymbolKind::coordinate);
    if (q.empty())
        refuse(scene.model->name_span,
               fmt::format("scene '{}' has no coordinates, so it has no mass matrix and no modal form; `dalembert equilibrium` prints "
                           "the eigenvalues of such a model", scene.name));
    if (system.symbols.positions() != q.size())
        refuse(q[system.symbols.attitudes().front().coordinates[0]].declared->span,
               "an attitude is a quaternion, with more states than velocities; a modal form needs coordinates, such as angles");
    for (std::size_t i = 0; i < q.size(); ++i)
        for (const Variable& z : system.symbols.all(SymbolKind::state))
            if (system.residual[i].has(z.symbol))
                refuse(z.declared != nullptr ? z.declared->span : scene.model->name_span,
                       fmt::format("the force on '{}' depends on the state '{}', which M*ddot(q) + D*dot(q) + C*q = B*u does not contain; "
                                   "`dalembert equilibrium` prints the eigenvalues",
                                   q[i].name, z.name));
}

std::vector<ModalMode> modes_of(const PlantModalForm& found) {
    std::vector<ModalMode> modes;
    std::size_t number = 0;
    for (const PlantModalBlock& block : found.blocks) {
        ++number;
        for (std::size_t i = 0; i < block.size; ++i) {
            const std::size_t k = modes.size();
            modes.push_back({found.eigenvalues[k], found.alpha[k], number, block.size, block.is_real, {}, found.matrix[k],
                             found.input.empty() ? std::vector<Complex>{} : found.input[k]});
            for (const auto& row : found.vectors) modes.back().vector.push_back(row[k]);
        }
    }
    return modes;
}

ModalReduction reduction_of(const PlantModalReduction& found, const System& system) {
    const std::vector<const Variable*> states = system.symbols.state_variables();
    const auto names = [&](const std::vector<std::size_t>& places) {
        std::vector<std::string> list;
        for (const std::size_t place : places) list.push_back(states[place]->name);
        return list;
    };
    return {found.is_closed, names(found.coordinates), names(found.apart), names(found.free), found.of_apart, found.N};
}

/// The largest of the second half of the rates of coordinates.
double largest_acceleration(const std::vector<double>& rates, const System& system) {
    const std::size_t n = system.symbols.degrees();
    double largest = 0;
    for (std::size_t i = n; i < 2 * n; ++i) largest = std::max(largest, std::abs(rates[i]));
    return largest;
}

std::vector<ResultValue> evaluated(const std::vector<const Variable*>& variables, const std::vector<GiNaC::ex>& numbers) {
    std::vector<ResultValue> values;
    for (std::size_t i = 0; i < variables.size(); ++i)
        values.push_back({variables[i]->name, GiNaC::ex_to<GiNaC::numeric>(numbers[i].evalf()).to_double(), variables[i]->unit});
    return values;
}

}  // namespace

ExitCode modal_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    Machine machine = derive_machine(model, scene_for_run(model->model, options), options.choice.sizes);
    show_warnings(machine, streams);
    refuse_fields(*machine.system, "modal");
    refuse_other_machines(*in_chosen_mode(machine, options).system);
    const Header header = generate(machine);
    const Machine& chosen = in_chosen_mode(machine, options);
    const System& system = *chosen.system;
    const auto [values, inputs] = start_of_run(system, options);
    streams.err << doubts_of_start(values, system);
    Values with_inputs = values;
    for (std::size_t i = 0; i < inputs.size(); ++i) with_inputs.find(SymbolKind::input, i, inputs[i]);
    streams.err << doubts_of_curves(with_inputs, system);
    const Linearity linearity = linear_system(system);
    const PlantLibrary library(source_of_plant(*chosen.code, header), plant_cache(options));
    explain(machine.stages, library.origin(), options, streams);
    ModalPointOfPlant point{parameter_numbers(system, values), numbers_of(values.state()), numbers_of(inputs)};
    point.mode = static_cast<unsigned>(system.scene.mode.value_or(0));
    point.is_held = std::any_of(system.constraints.begin(), system.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
    point.takes_rows_of_plant = projects_to_constraints(system);
    if (point.is_held && !point.takes_rows_of_plant) point.rows = held_rows(system, values, true);
    const PlantModalForm found = modes_of_plant(library.table(), point);

    std::vector<const Variable*> input_variables;
    for (const Variable& v : system.symbols.all(SymbolKind::input)) input_variables.push_back(&v);
    ModalResult result{.subject = subject_of(system.scene), .status = found.status, .not_linear = linearity.reason};
    result.is_linear = linearity.system.has_value();
    result.largest_acceleration = largest_acceleration(found.rates, system);
    for (const Variable& q : system.symbols.all(SymbolKind::coordinate)) result.coordinates.push_back(q.name);
    if (found.reduction) result.reduction = reduction_of(*found.reduction, system);
    result.states = evaluated(system.symbols.state_variables(), values.state());
    result.inputs = evaluated(input_variables, inputs);
    result.matrices = {{"M", found.M, found.of_M}, {"D", found.D, found.of_D}, {"C", found.C, found.of_C}, {"B", found.B, ""}};
    if (result.found()) result.modes = modes_of(found);
    write_result(result, options, streams);
    return result.found() ? ExitCode::good : ExitCode::run_stopped;
}

}  // namespace dalembert

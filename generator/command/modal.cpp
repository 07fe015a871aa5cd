// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/modal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "run/number_lists.hpp"
#include "run/run_header.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"
#include "emit/runner.hpp"
#include "form/linear_system.hpp"

namespace dalembert {

namespace {

/// Of a program: names and values.
using PrintedValues = std::map<std::string, std::string>;

/// Modal forms are of machines with coordinates, whose forces know no further states.
void refuse_other_machines(const System& system) {
    for (const ConstraintEquation& constraint : system.constraints)
        if (constraint.item->share)
            throw Failure(Diagnostic{
                Id::not_allowed_here, constraint.item->span,
                fmt::format("friction '{}' has a state in place of modes, so that there is no mode to linearise the machine in; with "
                            "fewer frictions there is one",
                            constraint.name)});
    const Scene& scene = system.scene;
    const auto refuse = [&](const Span& place, std::string why) { throw Failure(Diagnostic{Id::not_allowed_here, place, std::move(why)}); };
    const auto& q = system.symbols.all(SymbolKind::coordinate);
    if (q.empty())
        refuse(scene.model->name_span,
               fmt::format("scene '{}' has no coordinates, so that it has no mass matrix and no modal form", scene.name));
    if (system.symbols.positions() != q.size())
        refuse(q[system.symbols.attitudes().front().coordinates[0]].declared->span,
               "an attitude is a quaternion, with more states than velocities; a modal form needs coordinates, such as angles");
    for (std::size_t i = 0; i < q.size(); ++i)
        for (const Variable& z : system.symbols.all(SymbolKind::state))
            if (system.residual[i].has(z.symbol))
                refuse(z.declared != nullptr ? z.declared->span : scene.model->name_span,
                       fmt::format("the force on '{}' depends on the state '{}', which M*ddot(q) + D*dot(q) + C*q = B*u does not have; "
                                   "`dalembert equilibrium` has the eigenvalues", q[i].name, z.name));
}

std::vector<Complex> complex_row(const std::vector<double>& numbers) {
    std::vector<Complex> result;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) result.emplace_back(numbers[i], numbers[i + 1]);
    return result;
}

std::vector<ModalMode> modes_of(const PrintedValues& printed) {
    const auto rows = [&](const char* name) {
        std::vector<std::vector<Complex>> complex;
        for (const auto& row : matrix(printed.at(name))) complex.push_back(complex_row(row));
        return complex;
    };
    const auto eigenvalues = rows("eigenvalues"), alpha = rows("alpha"), vectors = rows("vectors"), matrix_rows = rows("matrix"),
               input = rows("input");
    std::vector<ModalMode> modes;
    std::size_t number = 0;
    for (const auto& block : matrix(printed.at("blocks"))) {
        const auto size = static_cast<std::size_t>(block[0]);
        ++number;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t k = modes.size();
            modes.push_back({eigenvalues[k][0], alpha[k][0], number, size, block[1] != 0, {}, matrix_rows[k],
                             input.empty() ? std::vector<Complex>{} : input[k]});
            for (const auto& row : vectors) modes.back().vector.push_back(row[k]);
        }
    }
    return modes;
}

ModalReduction reduction_of(const PrintedValues& printed, const System& system) {
    const std::vector<const Variable*> states = system.symbols.state_variables();
    const auto names = [&](const char* key) {
        std::vector<std::string> list;
        for (const double place : number_list(printed.at(key), ',')) list.push_back(states[static_cast<std::size_t>(place)]->name);
        return list;
    };
    ModalReduction reduction{printed.at("is_closed") == "1", names("coordinates"), names("apart"), names("free"), {},
                             matrix(printed.at("N"))};
    for (const auto& row : matrix(printed.at("of_apart"))) reduction.of_apart.emplace_back(row[0], row[1]);
    return reduction;
}

std::vector<ModalMatrix> matrices_of(const PrintedValues& printed) {
    std::vector<ModalMatrix> matrices;
    for (const char* name : {"M", "D", "C", "B"}) {
        const auto definiteness = printed.find(std::string("of_") + name);
        matrices.push_back({name, matrix(printed.at(name)), definiteness == printed.end() ? "" : definiteness->second});
    }
    return matrices;
}

/// The largest of the second half of the rates of coordinates.
double largest_acceleration(const PrintedValues& printed, const System& system) {
    const std::size_t n = system.symbols.degrees();
    const auto rates = number_list(printed.at("rates"), ',');
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
    const Linearity linearity = linear_system(system);
    const ScratchFolder scratch;
    const std::string source = modal_source(*chosen.code, header, values, values.state(), inputs);
    const PrintedValues printed = run_with_header(scratch, header, source, {}, "-O0");  // compiling takes longer than running

    std::vector<const Variable*> input_variables;
    for (const Variable& v : system.symbols.all(SymbolKind::input)) input_variables.push_back(&v);
    ModalResult result{.subject = subject_of(system.scene), .status = printed.at("status"), .not_linear = linearity.reason};
    result.is_linear = linearity.system.has_value();
    result.largest_acceleration = largest_acceleration(printed, system);
    for (const Variable& q : system.symbols.all(SymbolKind::coordinate)) result.coordinates.push_back(q.name);
    if (printed.contains("is_closed")) result.reduction = reduction_of(printed, system);
    result.states = evaluated(system.symbols.state_variables(), values.state());
    result.inputs = evaluated(input_variables, inputs);
    result.matrices = matrices_of(printed);
    if (result.found()) result.modes = modes_of(printed);
    write_result(result, options, streams);
    return result.found() ? ExitCode::good : ExitCode::run_stopped;
}

}  // namespace dalembert

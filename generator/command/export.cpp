// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "command/write_result.hpp"
#include "export/plant_in_c.hpp"
#include "export/target.hpp"
#include "form/state_places.hpp"
#include "prove/constraint_validity.hpp"
#include "run/plant_run.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// x at the start of the default parameters, in the order of the header.
std::vector<double> start_values(const System& system) {
    Values values(system.scene, system.translate);
    meet_constraints(system, values);
    const StatePlaces places = place_states(system);
    const std::vector<double> state = numbers_of(values.state());
    std::vector<double> x(places.count, 0);
    const GiNaC::exmap known = values.substitution();
    for (std::size_t r = 0; r < system.heat.fields.size(); ++r) {
        const CellField& field = system.heat.fields[r];
        const GiNaC::ex start = system.symbols.without_definitions(field.start).subs(known, GiNaC::subs_options::no_pattern);
        std::vector<GiNaC::ex> cells;
        for (std::size_t k = 0; k < field.cells; ++k)
            cells.push_back(start.subs(field.number == field.first_index + static_cast<int>(k), GiNaC::subs_options::no_pattern));
        const std::vector<double> numbers = numbers_of(cells);
        std::copy(numbers.begin(), numbers.end(), x.begin() + static_cast<std::ptrdiff_t>(places.firsts[r]));
    }
    for (std::size_t i = 0; i < state.size(); ++i) x[places.positions[i]] = state[i];
    return x;
}

ExportSubject subject_of_export(const Machine& machine, const Header& header) {
    const System& system = *machine.system;
    ExportSubject subject{machine, header.plant, header.name_space, start_values(system),
                          parameter_numbers(system, Values(system.scene, system.translate)), {}};
    subject.c_files = {{header.file_name, header.text},
                       {"dalembert_plant.h", std::string(embedded_file("plant.h"))},
                       {subject.name + "_plant.h",
                        plant_in_c(subject.plant, subject.name, subject.start_values, subject.parameter_defaults)}};
    return subject;
}

/// With all functions that the target takes; those that cannot be made are left out, with the reasons.
Header generate_for(const Target& target, Machine& machine, std::map<Function, std::string>& missing) {
    machine.wished.insert(target.wishes.begin(), target.wishes.end());
    const auto leave_out = [&](Function function, const std::string& why) {
        missing.emplace(function, why);
        machine.wished.erase(function);
    };
    for (;;) {
        try {
            return generate(machine);
        } catch (const CannotMake& refused) {
            leave_out(refused.function(), refused.reason());
        } catch (const Failure& failure) {  // the code is too large: leave out the largest function
            const auto next =
                std::find_if(target.wishes.begin(), target.wishes.end(), [&](Function f) { return machine.wished.contains(f); });
            if (failure.diagnostics().front().id != Id::too_large || next == target.wishes.end()) throw;
            leave_out(*next, failure.diagnostics().front().message);
        }
    }
}

/// Throws Failure for a mode that there is not, or a target that takes all.
void check_mode(const Machine& machine, const Target& target, const Options& options) {
    in_chosen_mode(machine, options);
    if (!target.takes_mode)
        throw Failure(Diagnostic{Id::bad_option, machine.loaded->model.name_span,
                                 fmt::format("--mode: '{}' takes a machine in all its modes; leave the option out", target.name)});
}

}  // namespace

ExitCode export_command(const Options& options, Streams streams) {
    const auto rows = targets();
    const Target& target = *std::find_if(rows.begin(), rows.end(), [&](const Target& t) { return options.target == t.name; });
    const auto model = loaded(options, streams);
    Machine machine = derive_machine(model, options.choice.scene, options.choice.sizes, parse_fixed(options.fix, model->names));
    show_warnings(machine, streams);
    show_doubts(machine, streams);
    refuse_rest(*machine.system, "export");
    tell_of_samplers(*machine.system, streams);
    if (!options.mode.empty()) check_mode(machine, target, options);
    ask_of_code(machine, options);
    machine.language = &language_named("c");
    std::map<Function, std::string> missing;
    const Header header = generate_for(target, machine, missing);
    const ExportSubject subject = subject_of_export(machine, header);
    Exported exported = target.make(subject, {options.sources_only, options.mode});
    Subject whole = subject_of(machine.system->scene);
    whole.mode = options.mode;  // of a machine that switches all modes are exported, unless one is chosen
    ExportResult result{std::move(whole), target.name, proofs_of(machine).all_proven(), {}, std::move(exported.notes)};
    for (auto& [path, content] : exported.files) {
        path = options.output / path;
        result.files.push_back({path, content.size()});
    }
    for (const auto& [function, reason] : missing)
        if (function == Function::hessian || !subject.plant.outputs.empty())
            result.notes.push_back(fmt::format("without {}: {}", header_function(function).wish, reason));
    write_files(exported.files);
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/controllers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "emit/runner.hpp"
#include "form/sampling.hpp"
#include "run/plant_run.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

/// The index of a named quantity in a list of the controller or of its machine.
template <class Items>
std::size_t place_of(const std::string& name, const Items& items, const RunEntry& entry, const Sampler& sampler, const Scene& scene) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
    if (found == items.end())
        throw Failure(Diagnostic{Id::needs_absent, entry.span,
                                 fmt::format("sampler '{}' needs '{}', which scene '{}' of '{}' leaves out", sampler.name, name, scene.name,
                                             scene.model->name)});
    return static_cast<std::size_t>(found - items.begin());
}

PreparedController prepare(const Sampler& sampler, const System& machine, const Values& values, double until) {
    const auto controller = std::make_shared<Machine>(derive_machine(std::make_shared<const LoadedModel>(*sampler.controller), "", {}));
    const System& system = *controller->system;
    const Header header = generate(*controller);
    PreparedController result{&sampler, controller, {header.file_name, header.text, controller_source(system, header)}, {}};
    ControllerOfRun& run = result.run;
    run.name = sampler.name;
    run.measures.resize(system.symbols.count(SymbolKind::input));
    for (const RunEntry& entry : sampler.measures) {
        const std::size_t input = place_of(entry.variable->name, system.symbols.all(SymbolKind::input), entry, sampler, system.scene);
        run.measures[input] = place_of(sampler.name + "_" + entry.variable->name, machine.outputs, entry, sampler, machine.scene);
    }
    for (const RunEntry& entry : sampler.sets) {
        run.outputs.push_back(place_of(entry.variable->name, system.outputs, entry, sampler, system.scene));
        run.sets.push_back(machine.symbols.find(SymbolKind::input, entry.value->name, 0)->position);
    }
    set_parameters(run, result, machine, values, until);
    return result;
}

}  // namespace

void set_parameters(ControllerOfRun& run, const PreparedController& controller, const System& machine, const Values& values, double until) {
    const System& system = *controller.machine->system;
    Values own(system.scene, system.translate);
    for (const RunEntry& entry : controller.sampler->of_machine) {
        const auto number = value_at(machine.translate(*entry.value, {}), values.substitution(), 40);
        if (!number)
            throw Failure(Diagnostic{Id::division_by_zero, entry.value->span,
                                     fmt::format("parameter '{}' of the controller of sampler '{}' has no value", entry.variable->name,
                                                 controller.sampler->name)});
        own.set(*entry.variable, *make_number(cln::rational(*number), entry.value->span), on_parameters);
    }
    const SampleTimes times = sample_times(system, own);
    if (until / times.every > budget::steps)
        throw Failure(Diagnostic{Id::bad_option, controller.sampler->span,
                                 fmt::format("sampler '{}' takes {:.3g} samples in a run of {:g} s; the limit is {:g}", run.name,
                                             until / times.every, until, budget::steps)});
    run.parameters = parameter_numbers(system, own);
    run.period = times.every;
    run.first = times.offset;
    run.delay = times.delay;
}

std::vector<PreparedController> prepare_controllers(const System& machine, const Values& values, double until) {
    std::vector<PreparedController> prepared;
    for (const Sampler* sampler : machine.scene.samplers) prepared.push_back(prepare(*sampler, machine, values, until));
    return prepared;
}

LoadedControllers::LoadedControllers(const std::vector<PreparedController>& prepared, PlantCache cache) {
    for (const PreparedController& one : prepared) {
        libraries_.push_back(std::make_unique<PlantLibrary>(one.source, cache, Exports::controller));
        of_run_.push_back(one.run);
        of_run_.back().table = &libraries_.back()->controller();
    }
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/example_run.hpp"

#include "form/state_places.hpp"
#include "prove/constraint_validity.hpp"
#include "run/plant_run.hpp"
#include "run/run_preparation.hpp"

namespace dalembert {

namespace {

NamedNumbers changed(const std::vector<PlantQuantity>& table, const std::vector<double>& values, const std::vector<double>& usual) {
    NamedNumbers result;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] != usual[i]) result.emplace_back(table[i].name, values[i]);
    return result;
}

ExampleRun run_of_model(const ExportSubject& subject) {
    const System& system = *subject.machine.system;
    const Options options;
    const RunPreparation preparation(*system.scene.model, options);
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    meet_constraints_in_mode(system, values);
    ExampleRun run;
    run.until = preparation.make_settings(values, system).until;
    run.parameters = changed(subject.plant.parameters, parameter_numbers(system, values), subject.parameter_defaults);
    const std::vector<double> state = numbers_of(values.state());
    const StatePlaces places = place_states(system);
    std::vector<double> x = subject.start_values;
    for (std::size_t i = 0; i < state.size(); ++i) x[places.positions[i]] = state[i];
    run.start = changed(subject.plant.states, x, subject.start_values);
    const std::vector<double> inputs = numbers_of(preparation.inputs_at_start(values, system));
    for (std::size_t i = 0; i < inputs.size(); ++i) run.inputs.emplace_back(subject.plant.inputs[i].name, inputs[i]);
    return run;
}

}  // namespace

ExampleRun example_run(const ExportSubject& subject) {
    try {
        return run_of_model(subject);
    } catch (const Failure&) {  // no run, or one of another scene
        ExampleRun run;
        for (const PlantQuantity& input : subject.plant.inputs) run.inputs.emplace_back(input.name, 0.0);
        return run;
    }
}

}  // namespace dalembert

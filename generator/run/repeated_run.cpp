// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/repeated_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/model.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "text/nearest.hpp"

namespace dalembert {

RepeatedRun::RepeatedRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& wanted)
    : options_(options),
      preparation_(model->model, options),
      machine_(derive_machine(model, preparation_.scene(options.choice.scene), options.choice.sizes)) {
    header_ = generate(machine_);
    const System& system = *machine_.system;
    const std::vector<std::string> names = recorded_names(wanted, system);
    if (names.size() != 1) {
        std::vector<std::string> known;
        for (const OutputEquation& output : system.outputs) known.push_back(output.name);
        for (const Variable* state : system.symbols.state_variables()) known.push_back(state->recorded_name());
        throw Failure(Diagnostic{Id::unknown_name, system.scene.model->name_span,
                                 names.empty() ? fmt::format("scene '{}' has no output or state '{}'; it has {}{}", system.scene.name,
                                                             wanted, quoted_list(known), did_you_mean(wanted, known))
                                               : fmt::format("'{}' is a family; name a member, as in '{}'", wanted, names.front())});
    }
    constexpr double fine = 1e-12;
    const SimulationSettings settings = preparation_.make_settings(values(), system);
    tolerance_ = options.tolerance > 0 ? options.tolerance : std::min(settings.tolerance, fine);
    source_ = source_of_plant(*machine_.code, header_, settings);
    wanted_ = names.front();
}

void RepeatedRun::compile() { library_.emplace(source_, plant_cache(options_)); }

/// Those of the model, the run and the command line.
Values RepeatedRun::values() const {
    Values result(machine_.system->scene, machine_.system->translate);
    preparation_.set_values(result, *machine_.system);
    return result;
}

RepeatedRun::End RepeatedRun::operator()(const Expression& parameter, double value, Care care) const {
    const System& system = *machine_.system;
    Values at = values();
    at.set(parameter, *make_number(cln::rational(cln::cl_DF(value)), parameter.span), on_parameters);
    meet_constraints(system, at);
    check_values(system, at);
    SimulationSettings settings = preparation_.make_settings(at, system);
    settings.tolerance = tolerance_;
    if (care == Care::coarse) {
        settings.tolerance = std::min(10 * tolerance_, 0.5);
        settings.step *= 2;
        settings.intervals = std::max(1, settings.intervals / 2);
    }
    PlantRun run = run_of_plant(system, at, settings);
    run.keeps_all = false;
    const PlantRunResult result = simulate_plant(library_->table(), run);
    const Status status = result.outcome.status;
    End end{0, result.outcome.t, static_cast<double>(result.outcome.steps), ""};
    const std::size_t event = result.outcome.guard;
    const bool ends = status == Status::event && !system.scene.modes.empty() && event < system.events.size() &&
                      system.events[event].item != nullptr && !system.events[event].item->is_limit;
    if (ends) end.event = system.events[event].name;
    if (!result.recording.rows.empty()) end.value = result.recording.rows.back()[result.recording.find(wanted_)];
    if ((status != Status::success && !ends) || !std::isfinite(end.value))
        throw RunStopped(fmt::format("with {} = {:.6g} the run does not reach its end: {} at t = {:.6g} s", parameter.written(), value,
                                     status == Status::success ? "not finite" : to_string(status), end.t));
    return end;
}

}  // namespace dalembert

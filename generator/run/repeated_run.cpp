// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/repeated_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/model.hpp"
#include "run/recorded_columns.hpp"
#include "text/nearest.hpp"

namespace dalembert {

RepeatedRun::RepeatedRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& wanted)
    : runs_(model, options, "optimise") {
    const System& system = *machine().system;
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
    tolerance_ = options.tolerance > 0 ? options.tolerance : std::min(runs_.settings().tolerance, fine);
    wanted_ = names.front();
}

void RepeatedRun::compile(const Variable& parameter) {
    parameter_ = parameter.name;
    runs_.vary({&parameter});
    runs_.compile();
}

RepeatedRun::End RepeatedRun::operator()(double value, Care care) const {
    const System& system = *machine().system;
    PlantRun run = runs_(std::span(&value, 1));
    run.tolerance = tolerance_;
    if (care == Care::coarse) {
        run.tolerance = std::min(10 * tolerance_, 0.5);
        run.step *= 2;
        run.intervals = std::max<std::size_t>(1, run.intervals / 2);
    }
    run.keeps_all = false;
    const PlantRunResult result = simulate_plant(runs_.plant(), run);
    const Status status = result.outcome.status;
    End end{0, result.outcome.t, static_cast<double>(result.outcome.steps), ""};
    const EventEquation* ends = event_that_ended(result.outcome, system);
    if (ends != nullptr) end.event = ends->name;
    if (!result.recording.rows.empty()) end.value = result.recording.rows.back()[result.recording.find(wanted_)];
    if ((status != Status::success && ends == nullptr) || !std::isfinite(end.value)) {
        const std::string of_model = end_of_model(result.outcome, system).doc;
        const std::string why = !of_model.empty() ? of_model : status == Status::success ? "not finite" : to_string(status);
        throw RunStopped(
            fmt::format("with {} = {:.6g} the run does not reach its end: {} at t = {:.6g} s", parameter_, value, why, end.t));
    }
    return end;
}

}  // namespace dalembert

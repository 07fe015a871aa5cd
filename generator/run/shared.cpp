// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/shared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <ostream>

#include "elements/model.hpp"
#include "run/settings.hpp"
#include "text/nearest.hpp"

namespace dalembert {

std::shared_ptr<const LoadedModel> loaded(const Options& options, Streams streams) {
    Diagnostics diagnostics;
    auto model = load(options.choice.model, diagnostics);
    for (const Diagnostic& warning : diagnostics.all()) streams.err << render(warning);
    constexpr std::array of_controllers{"check", "derive", "generate", "scenes"};
    if (model->model.sampling && std::find(of_controllers.begin(), of_controllers.end(), options.verb) == of_controllers.end())
        throw Failure(Diagnostic{Id::not_allowed_here, model->model.name_span,
                                 fmt::format("'{}' is a controller that samples, and '{}' is for machines; name it in [samplers] of the "
                                             "machine that it controls",
                                             model->model.name, options.verb),
                                 {{model->model.sampling->span, "it samples because of this section"}}});
    return model;
}

Machine derived(const Options& options, Streams streams) {
    Machine machine = derive_machine(loaded(options, streams), options.choice.scene, options.choice.sizes);
    show_warnings(machine, streams);
    return machine;
}

void show_warnings(const Machine& machine, Streams streams) {
    for (const Diagnostic& warning : machine.system->warnings) streams.err << render(warning);
    for (const Machine& other : machine.other_modes) show_warnings(other, streams);
}

void show_doubts(const Machine& machine, Streams streams) {
    streams.err << doubts_of_start(Values(machine.system->scene, machine.system->translate), *machine.system, false);
}

void ask_of_code(Machine& machine, const Options& options) {
    for (const Pass& pass : all_passes)
        machine.passes.*pass.is_on = std::find(options.without.begin(), options.without.end(), pass.name) == options.without.end();
    machine.trig = options.trig == "combined" ? Trig::combined : Trig::library;
    for (const auto& [function, is_asked_for] : options.wished)
        if (is_asked_for) machine.wished.insert(function);
    machine.language = &language_named(options.language);
}

const Machine& in_chosen_mode(const Machine& machine, const Options& options) {
    if (options.mode.empty()) return machine;
    const Scene& scene = machine.system->scene;
    std::vector<std::string> names;
    for (const SceneMode& mode : scene.modes) names.push_back(mode.name);
    if (names.empty())
        throw Failure(Diagnostic{Id::unknown_name, scene.model->name_span,
                                 fmt::format("scene '{}' has no modes, so it has no mode '{}'", scene.name, options.mode)});
    const auto found = std::find(names.begin(), names.end(), options.mode);
    if (found == names.end())
        throw Failure(
            Diagnostic{Id::unknown_name, scene.model->name_span,
                       fmt::format("scene '{}' has no mode '{}'; its modes are {}", scene.name, options.mode, quoted_list(names))});
    return found == names.begin() ? machine : machine.other_modes[static_cast<std::size_t>(found - names.begin()) - 1];
}

void refuse_fields(const System& system, const char* verb) {
    for (const CellField& field : system.heat.fields)
        throw Failure(Diagnostic{Id::too_large, field.body->span,
                                 fmt::format("the {} cells of {} are computed in a loop, and '{}' needs each cell separately; choose "
                                             "fewer cells, or set loops = false",
                                             field.cells, field.written(), verb)});
}

void tell_of_samplers(const System& system, Streams streams) {
    std::vector<std::string> names, inputs;
    for (const Sampler* sampler : system.scene.samplers) {
        names.push_back(sampler->name);
        for (const RunEntry& entry : sampler->sets) inputs.push_back(entry.value->name);
    }
    if (names.empty()) return;
    streams.err << fmt::format("dalembert: warning: this is the machine without its controllers {}; whoever runs it sets its inputs {}\n",
                               quoted_list(names), quoted_list(inputs));
}

void refuse_samplers(const System& system, const std::string& verb) {
    const std::vector<const Sampler*>& samplers = system.scene.samplers;
    if (samplers.empty()) return;
    throw Failure(Diagnostic{Id::not_allowed_here, samplers.front()->span,
                             fmt::format("scene '{}' has sampler '{}', and '{}' knows no controllers yet; leave it out by an effect, with "
                                         "`when`, and give the run its inputs",
                                         system.scene.name, samplers.front()->name, verb)});
}

void refuse_rest(const System& system, const char* verb) {
    const Scene& scene = system.scene;
    if (!scene.coordinates.empty() || !scene.states.empty()) return;
    throw Failure(Diagnostic{Id::nothing_left, scene.model->name_span,
                             fmt::format("scene '{}' has neither a coordinate nor a state, and '{}' needs one; 'evaluate' prints its "
                                         "outputs and the forces of its loads",
                                         scene.name, verb)});
}

}  // namespace dalembert

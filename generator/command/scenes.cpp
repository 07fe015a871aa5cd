// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/scenes.hpp"

#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "run/shared.hpp"

namespace dalembert {

ExitCode scenes_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    const auto names = [](const std::vector<const Effect*>& effects) {
        std::vector<std::string> list;
        for (const Effect* effect : effects) list.push_back(effect->name);
        return list;
    };
    ScenesResult result{model->model.name, model->model.default_scene, {}};
    for (const std::string& name : scene_names(model->model)) {
        const Scene scene = select_scene(model->model, model->names, name, options.choice.sizes);
        result.scenes.push_back({name, scene.doc, names(scene.effects_in), names(scene.effects_out), scene.coordinates.size(),
                                 scene.states.size(), scene.inputs.size(), scene.outputs.size(), scene.parameters.size(),
                                 header_name(scene)});
    }
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert

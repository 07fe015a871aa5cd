// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>

#include "report/json_output.hpp"
#include "run/shared.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

ExitCode scenes_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    nlohmann::ordered_json json = json_result("scenes", model->model);
    json["default"] = model->model.default_scene;
    json["scenes"] = nlohmann::ordered_json::array();
    std::string text;
    for (const std::string& name : scene_names(model->model)) {
        const Scene scene = select_scene(model->model, model->names, name, options.choice.sizes);
        std::vector<std::string> in, out;
        for (const Effect* effect : scene.effects_in) in.push_back(effect->name);
        for (const Effect* effect : scene.effects_out) out.push_back(effect->name);
        json["scenes"].push_back({{"scene", name},
                                  {"doc", scene.doc},
                                  {"effects_in", in},
                                  {"effects_out", out},
                                  {"coordinates", scene.coordinates.size()},
                                  {"states", 2 * scene.coordinates.size() + scene.states.size()},
                                  {"inputs", scene.inputs.size()},
                                  {"outputs", scene.outputs.size()},
                                  {"parameters", scene.parameters.size()},
                                  {"header", header_name(scene)}});
        text += fmt::format("{}{}{}\n", name, name == model->model.default_scene ? " (default)" : "", scene.doc.empty() ? "" : ": " + safe_line(scene.doc));
        text += fmt::format("  effects in:  {}\n", in.empty() ? "none" : fmt::format("{}", fmt::join(in, ", ")));
        text += fmt::format("  effects out: {}\n", out.empty() ? "none" : fmt::format("{}", fmt::join(out, ", ")));
        text += fmt::format("  {} coordinates, {} plain states, {} inputs, {} outputs, {} parameters; header {}\n", scene.coordinates.size(), scene.states.size(),
                            scene.inputs.size(), scene.outputs.size(), scene.parameters.size(), header_name(scene));
    }
    streams.out << (options.format == "json" ? printed(json) : text);
    return ExitCode::good;
}

}  // namespace dalembert

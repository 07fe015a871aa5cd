// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/effects.hpp"

#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "report/effects_plot.hpp"
#include "run/shared.hpp"

namespace dalembert {

ExitCode effects_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    EffectsResult result{model->model.name, {}, compare_scenes(model, options, streams), {}};
    result.sized_name = select_scene(model->model, model->names, result.against(), options.choice.sizes).sized_name();
    const std::filesystem::path base = std::filesystem::path(options.output) / (result.sized_name + "_effects");
    FileContents files{{base.string() + ".csv", effects_csv(result.comparison)}};
    if (!options.no_plot) {
        const std::string& title = model->model.title.empty() ? result.sized_name : model->model.title;
        for (auto& [ending, picture] : effects_plot(result.comparison, title)) files.emplace_back(base.string() + ending, picture);
    }
    write_files(files);
    result.files = paths_of(files);
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert

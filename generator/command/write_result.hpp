// SPDX-License-Identifier: GPL-3.0-or-later
// How every verb ends: its result, as `--format` asks for it.
#pragma once

#include <ostream>

#include "plant/library.hpp"
#include "report/generate.hpp"
#include "report/json_output.hpp"
#include "run/options.hpp"
#include "text/files.hpp"

namespace dalembert {

/// For results that tell which files were written.
inline std::vector<std::filesystem::path> paths_of(const FileContents& files) {
    std::vector<std::filesystem::path> paths;
    for (const auto& [path, content] : files) paths.push_back(path);
    return paths;
}

inline bool is_json(const Options& options) { return options.format == "json"; }

/// By as_text and as_json of the result's report, and as_latex where there is one.
template <class Result>
void write_result(const Result& result, const Options& options, Streams streams) {
    if (is_json(options)) {
        streams.out << printed(as_json(result));
        return;
    }
    if constexpr (requires { as_latex(result); })
        if (options.format == "latex") {
            streams.out << as_latex(result);
            return;
        }
    streams.out << as_text(result);
}

/// Of what runs a plant, where --explain asks for it: time and result of each stage, and where the plant came from.
inline void explain(std::vector<StageReport> stages, const PlantOrigin& plant, const Options& options, Streams streams) {
    if (!options.explain) return;
    stages.push_back({"plant", plant.seconds, plant.text});
    streams.err << stage_table(stages);
}

}  // namespace dalembert

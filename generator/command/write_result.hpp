// SPDX-License-Identifier: GPL-3.0-or-later
// How every verb ends: its result, as `--format` asks for it.
#pragma once

#include <ostream>

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

}  // namespace dalembert

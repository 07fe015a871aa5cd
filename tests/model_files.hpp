// SPDX-License-Identifier: GPL-3.0-or-later
// The models of the repository, for tests that take some of them in the quick tier and all in the full one.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Those that are wanted, or all; DALEMBERT_MODELS names others.
inline std::vector<std::filesystem::path> model_files(std::vector<std::string> wanted, bool all) {
    const char* named = std::getenv("DALEMBERT_MODELS");
    if (named != nullptr) {
        std::istringstream words(named);
        wanted.assign(std::istream_iterator<std::string>(words), {});
    }
    std::vector<std::filesystem::path> files;
    for (const std::string folder : {"systems/mechanics", "systems/hydraulics", "systems/pneumatics", "systems/heat", "systems/drives",
                                     "systems/parts", "tests/published", "tests/regressions", "tests/physics/switching"})
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SOURCE_DIR) / folder)) {
            const std::string stem = entry.path().stem().string();
            const bool is_long = stem == "three_tanks" && folder == "tests/regressions";  // millions of steps along a kink
            const bool is_meant = (all && named == nullptr) || std::count(wanted.begin(), wanted.end(), stem) > 0;
            if (entry.path().extension() == ".toml" && is_meant && !is_long) files.push_back(entry.path());
        }
    std::sort(files.begin(), files.end());
    return files;
}

/// Null for what is no model, or a bad one on purpose.
inline std::shared_ptr<const LoadedModel> loaded_if_good(const std::filesystem::path& file) {
    try {
        Diagnostics diagnostics;
        return load(file, diagnostics);
    } catch (const Failure&) {
        return nullptr;
    }
}

}  // namespace dalembert

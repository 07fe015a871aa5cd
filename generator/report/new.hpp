// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert new`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace dalembert {

struct NewResult {
    std::string project;  ///< its name, which is that of its model too
    std::string kind, doc;
    std::filesystem::path folder;
    std::vector<std::filesystem::path> files;
};

std::string as_text(const NewResult& result);
nlohmann::ordered_json as_json(const NewResult& result);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert export`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/subject.hpp"

namespace dalembert {

struct ExportResult {
    struct File {
        std::filesystem::path path;
        std::size_t bytes;
    };
    Subject subject;
    std::string target;
    bool all_proven;
    std::vector<File> files;         ///< that were written
    std::vector<std::string> notes;  ///< names that were mapped, and what the tool will not see
};

std::string as_text(const ExportResult& result);
nlohmann::ordered_json as_json(const ExportResult& result);

}  // namespace dalembert

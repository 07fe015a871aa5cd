// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert compile`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/subject.hpp"

namespace dalembert {

struct CompileResult {
    Subject subject;
    std::filesystem::path plant, header;  ///< what was written
    std::size_t bytes = 0;                ///< of the library
};

std::string as_text(const CompileResult& result);
nlohmann::ordered_json as_json(const CompileResult& result);

}  // namespace dalembert

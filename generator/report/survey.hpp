// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert survey`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "report/subject.hpp"

namespace dalembert {

struct SurveyRow {
    Subject subject;
    std::size_t degrees = 0;
    int operations = 0;           ///< of the right-hand side
    double generation_seconds = 0;
    std::size_t equations = 0;    ///< printed ones that were checked
    std::size_t as_expected = 0;  ///< of them
    std::size_t misprints = 0;    ///< of them
    bool all_proven = false;
    std::string status = {};      ///< of the run
    bool is_good = false;         ///< it came to its end
    bool keeps_energy = false;
    std::size_t steps = 0;
    double energy_error = 0;
    std::vector<std::filesystem::path> files = {};

    std::string name() const { return subject.sized_name + ", " + subject.scene; }
    bool failed() const { return as_expected != equations || (is_good && !keeps_energy); }
};

struct SurveyResult {
    std::filesystem::path folder;
    std::vector<SurveyRow> rows;
};

std::string as_text(const SurveyResult& result);
nlohmann::ordered_json as_json(const SurveyResult& result);

}  // namespace dalembert

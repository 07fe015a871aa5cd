// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert study`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/subject.hpp"
#include "study/run_file.hpp"
#include "study/statistics.hpp"

namespace dalembert {

/// A run with its value of what is observed.
struct OutstandingRun {
    std::size_t run;
    double value;
};

struct StudiedQuantity {
    Column column;
    SampleStatistics statistics;
    std::size_t missing = 0;  ///< good runs without a value, as of an event that did not happen
    std::vector<OutstandingRun> least, most;
    std::vector<SobolIndex> indices = {};  ///< in the order of what is varied; none where they are not asked for or do not exist
};

struct StudyResult {
    Subject subject;
    std::size_t runs = 0;             ///< of the whole study
    std::size_t first = 0, last = 0;  ///< those of the file, last behind it
    std::size_t found = 0;            ///< that were there before
    std::vector<Column> varied = {};
    std::vector<std::pair<std::string, std::size_t>> statuses = {};  ///< with their numbers of runs
    std::vector<std::size_t> left_out = {};                          ///< runs that did not come to an end; the first few
    std::size_t left_out_count = 0;
    bool has_indices = false;
    std::size_t groups_left_out = 0;  ///< with a run that did not come to an end
    std::vector<StudiedQuantity> observed = {};
    std::vector<std::filesystem::path> files;
};

/// Statistics of a table; `worst` runs are told at either end.
void fill(StudyResult& result, const RunTable& table, std::size_t worst);

std::string as_text(const StudyResult& result);
nlohmann::ordered_json as_json(const StudyResult& result);

/// One run of a study, made again.
struct RepeatedOfStudy {
    Subject subject;
    std::vector<Column> varied, observed;
    RowOfRun row;
    std::vector<std::filesystem::path> files;
};

std::string as_text(const RepeatedOfStudy& result);
nlohmann::ordered_json as_json(const RepeatedOfStudy& result);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts on printed equations as people and programs read them.
#pragma once

#include <nlohmann/json.hpp>

#include "book/printed_verdicts.hpp"

namespace dalembert {

/// How many rows have which verdict.
struct VerdictCounts {
    std::array<int, 6> of{};
    int entries = 0;

    void add(Verdict verdict);
    void add(const VerdictCounts& other);
    /// "12 printed equations: 10 proven, 2 wrong"
    std::string line(const char* what = "printed equations") const;
    nlohmann::ordered_json json() const;
};

/// Lines of text: the verdict, and what has to be said where it is not `proven`.
std::string report_text(const PrintedRow& row, std::size_t width);
/// How wide the column of these names is: as the longest, in limits.
std::size_t column_width(const std::vector<std::string>& names);

/// `source` is where it is printed if the entry does not say.
nlohmann::ordered_json report_json(const PrintedRow& row, const std::string& source);

}  // namespace dalembert

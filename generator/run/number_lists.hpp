// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as programs that were compiled print them: "1,2" and "1,2;3,4".
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace dalembert {

inline std::vector<double> number_list(const std::string& text, char separator) {
    std::vector<double> result;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, separator);) result.push_back(std::stod(part));
    return result;
}

/// As rows.
inline std::vector<std::vector<double>> matrix(const std::string& text) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    for (std::string row; std::getline(lines, row, ';');) rows.push_back(number_list(row, ','));
    return rows;
}

}  // namespace dalembert

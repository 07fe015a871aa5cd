// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/matrix_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dalembert {

std::string rows_text(const MatrixRows& rows, const std::vector<std::string>& row_names, const std::vector<std::string>& column_names) {
    std::size_t width = 0;
    for (const std::string& name : row_names) width = std::max(width, name.size());
    std::vector<std::size_t> widths;
    for (const std::string& name : column_names) widths.push_back(std::max<std::size_t>(12, name.size()));
    std::string text = fmt::format("  {:<{}}", "", width);
    for (std::size_t j = 0; j < column_names.size(); ++j) text += fmt::format(" {:>{}}", column_names[j], widths[j]);
    text += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += fmt::format("  {:<{}}", row_names[i], width);
        for (std::size_t j = 0; j < rows[i].size(); ++j) text += fmt::format(" {:>{}.5g}", rows[i][j] + 0.0, widths[j]);  // no -0
        text += "\n";
    }
    return text;
}

std::vector<std::string> names_of(const std::vector<ResultValue>& values, const std::string& prefix) {
    std::vector<std::string> names;
    for (const ResultValue& one : values) names.push_back(prefix + one.name);
    return names;
}

std::string values_text(const std::vector<ResultValue>& values) {
    std::string text;
    for (const ResultValue& one : values) text += fmt::format("  {:<16} {:>22} {}\n", one.name, one.value + 0.0, one.unit);  // no -0
    return text;
}

nlohmann::ordered_json complex_json(const Complex& value) { return {{"real", value.real() + 0.0}, {"imaginary", value.imag() + 0.0}}; }
nlohmann::ordered_json complex_json(const std::vector<Complex>& values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Complex& value : values) list.push_back(complex_json(value));
    return list;
}

}  // namespace dalembert

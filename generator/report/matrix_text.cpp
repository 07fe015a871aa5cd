// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/matrix_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace dalembert {

std::string rows_text(const MatrixRows& rows) {
    std::string text;
    for (const auto& row : rows) {
        text += " ";
        for (const double value : row) text += fmt::format(" {:>12.5g}", value + 0.0);  // no -0
        text += "\n";
    }
    return text;
}

std::string values_text(const std::vector<ResultValue>& values) {
    std::string text;
    for (const ResultValue& one : values) text += fmt::format("  {:<16} {:>22} {}\n", one.name, one.value, one.unit);
    return text;
}

nlohmann::ordered_json complex_json(const Complex& value) { return {{"real", value.real() + 0.0}, {"imaginary", value.imag() + 0.0}}; }
nlohmann::ordered_json complex_json(const std::vector<Complex>& values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Complex& value : values) list.push_back(complex_json(value));
    return list;
}

}  // namespace dalembert

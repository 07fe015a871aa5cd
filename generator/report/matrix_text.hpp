// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices, complex numbers and named values of results as text and JSON.
#pragma once

#include <complex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/subject.hpp"

namespace dalembert {

using Complex = std::complex<double>;
using MatrixRows = std::vector<std::vector<double>>;

/// A line with the names of the columns, then a line each row.
std::string rows_text(const MatrixRows& rows, const std::vector<std::string>& row_names, const std::vector<std::string>& column_names);
/// Each behind a prefix.
std::vector<std::string> names_of(const std::vector<ResultValue>& values, const std::string& prefix = "");
/// A line each.
std::string values_text(const std::vector<ResultValue>& values);

nlohmann::ordered_json complex_json(const Complex& value);
nlohmann::ordered_json complex_json(const std::vector<Complex>& values);

}  // namespace dalembert

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

/// A line each row.
std::string rows_text(const MatrixRows& rows);
/// A line each.
std::string values_text(const std::vector<ResultValue>& values);

nlohmann::ordered_json complex_json(const Complex& value);
nlohmann::ordered_json complex_json(const std::vector<Complex>& values);

}  // namespace dalembert

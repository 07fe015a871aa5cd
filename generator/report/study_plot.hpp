// SPDX-License-Identifier: GPL-3.0-or-later
// Histograms of what a study observed, and its scatter over what is varied.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/run_file.hpp"

namespace dalembert {

/// A row of panels for each quantity: its histogram, and its values over each that is varied; the first few of both. As ".svg" and
/// ".png"; none where gnuplot is missing or fails.
std::vector<std::pair<std::string, std::string>> study_plot(const RunTable& table, const std::string& title);

}  // namespace dalembert

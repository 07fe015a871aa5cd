// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision diagrams: error against time and against calls of the right-hand side.
#pragma once

#include "run/work_precision.hpp"

namespace dalembert {

/// A line across the diagram: an error that no integrator takes away.
struct Level {
    std::string title;
    double error;
};

/// Four panels, errors at the end and along the way, of runs up to `until` (s), as ".svg" and ".png" through gnuplot; none where gnuplot is
/// not there.
std::vector<std::pair<std::string, std::string>> precision_plot(const std::vector<WorkPoint>& measured, double until,
                                                                const std::vector<Level>& levels, const std::string& title);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// What was measured of accuracy and time: as CSV, which is also how a stopped measurement goes on, and as advice.
#pragma once

#include "run/work_precision.hpp"

namespace dalembert {

/// The titles of the columns, and one line of values.
std::string csv_titles();
std::string csv_line(const std::string& scene, const std::string& size, const WorkPoint& point);
/// What csv_line wrote; nothing where the line is not whole.
std::optional<WorkPoint> read_csv_line(const std::string& line);

/// The point that takes least time for an error on the way that is not larger; null where there is none. Times are those of the fastest
/// repetition, as others are slowed down by the rest of the machine.
const WorkPoint* cheapest(const std::vector<WorkPoint>& points, double error, const std::string& arithmetic = {},
                          const std::string& method = {});
/// The least error that is reached.
const WorkPoint* most_accurate(const std::vector<WorkPoint>& points, const std::string& arithmetic);

/// "double, dopri5 at 3e-08", "float, rk4 with steps of 0.001 s"
std::string name_of(const RunPlan& plan);

/// That of a reference: "3.6e-15", or where it is beyond the digits that are kept "below 1e-18".
std::string error_text(const ReferenceRun& reference);

/// What was asked for; everything, where nothing was said.
bool is_wanted(const std::vector<std::string>& wanted, const std::string& name);
/// The methods that are measured of a system: those that are wanted, and can integrate it.
std::vector<std::string> measured_methods(const std::vector<std::string>& wanted, const PreparedRun& run);

inline constexpr std::array wanted_errors{1e-3, 1e-6, 1e-9};

}  // namespace dalembert

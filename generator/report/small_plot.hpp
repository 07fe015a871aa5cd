// SPDX-License-Identifier: GPL-3.0-or-later
// Small pictures for pages that show many systems: SVG of 320 x 180 px and a few kB, in colours that are readable on white and on black.
#pragma once

#include <dalembert/plot.hpp>
#include <string>

namespace dalembert {

/// Curves over one column of a recording, in at most 120 points each. Names that the recording does not have are left out.
std::string small_plot(const Recording& recording, const Panel& panel);
/// A sentence in place of a plot.
std::string small_text(const std::string& sentence);

}  // namespace dalembert

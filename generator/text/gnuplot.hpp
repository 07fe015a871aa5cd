// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures through gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dalembert {

/// In single quotes nothing is special but the quote itself, which becomes typographic.
std::string gnuplot_quoted(const std::string& text);

/// What `draw` draws after the commands of `script`, as ".svg" and ".png"; none where gnuplot is missing or fails.
std::vector<std::pair<std::string, std::string>> gnuplot_pictures(const std::string& script, const std::string& draw, int width,
                                                                  int height);

}  // namespace dalembert

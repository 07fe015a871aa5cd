// SPDX-License-Identifier: GPL-3.0-or-later
// Curves with few points that look the same (Douglas and Peucker 1973).
#pragma once

#include <cstddef>
#include <vector>

namespace dalembert {

struct PicturePoint {
    double x, y;  ///< px
};

/// Leaves out points that lie within a tolerance of the line between their neighbours: the smallest with which at most so many are left.
/// Where it would be too coarse, lowest and highest points of groups of neighbours stay.
std::vector<std::vector<PicturePoint>> simplified(const std::vector<std::vector<PicturePoint>>& pieces, std::size_t most);

}  // namespace dalembert

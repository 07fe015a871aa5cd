// SPDX-License-Identifier: GPL-3.0-or-later
// Places for the nodes of a network and for a station on each of its edges, on a grid: edges lead from column to column, none of the
// places is taken twice, and a long network goes on in the other direction below. The same network has the same places always.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace dalembert {

/// In columns and rows; corners of paths may lie between them.
struct GridPoint {
    double column = 0, row = 0;
};

struct LayeredLayout {
    std::vector<GridPoint> nodes;               ///< in the order in which they are given
    std::vector<GridPoint> stations;            ///< one an edge
    std::vector<std::vector<GridPoint>> paths;  ///< of an edge, from its first node by its station to its second
    std::vector<int> headings;                  ///< 1: an edge leads through its station to the right; -1: to the left
    double columns = 0, rows = 0;
};

/// Edges lead from their first node to their second. `most_columns`: odd; nodes and stations take turns.
LayeredLayout layered_layout(std::size_t nodes, const std::vector<std::pair<std::size_t, std::size_t>>& edges, std::size_t most_columns);

}  // namespace dalembert

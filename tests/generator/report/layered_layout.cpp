// SPDX-License-Identifier: GPL-3.0-or-later
// Places of networks: nothing lies upon anything else, lines lead through their stations, and rings and long chains have a picture too.
#include "report/layered_layout.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace dalembert;

namespace {

using Edges = std::vector<std::pair<std::size_t, std::size_t>>;

bool is_at(const GridPoint& a, const GridPoint& b) { return a.column == b.column && a.row == b.row; }

/// Of all networks, however they are joined.
void check_layout(std::size_t nodes, const Edges& edges, std::size_t most_columns) {
    const LayeredLayout layout = layered_layout(nodes, edges, most_columns);
    std::vector<GridPoint> all = layout.nodes;
    all.insert(all.end(), layout.stations.begin(), layout.stations.end());
    REQUIRE(all.size() == nodes + edges.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        CHECK(all[i].column >= 0);
        CHECK(all[i].column <= static_cast<double>(most_columns) - 1);
        CHECK(all[i].row >= 0);
        CHECK(all[i].row <= layout.rows - 1);
        for (std::size_t j = 0; j < i; ++j) CHECK((all[i].column != all[j].column || std::fabs(all[i].row - all[j].row) > 1 - 1e-9));
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::vector<GridPoint>& path = layout.paths[e];
        REQUIRE(path.size() >= 3);
        CHECK(is_at(path.front(), layout.nodes[edges[e].first]));
        CHECK(is_at(path.back(), layout.nodes[edges[e].second]));
        CHECK(std::any_of(path.begin() + 1, path.end() - 1, [&](const GridPoint& p) { return is_at(p, layout.stations[e]); }));
    }
}

}  // namespace

TEST_CASE("a chain of a network stands in a row, and goes on below in the other direction") {
    const LayeredLayout layout = layered_layout(4, {{0, 1}, {1, 2}, {2, 3}}, 5);
    CHECK(is_at(layout.nodes[0], {0, 0}));
    CHECK(is_at(layout.stations[0], {1, 0}));
    CHECK(is_at(layout.nodes[2], {4, 0}));
    CHECK(is_at(layout.stations[2], {4, 1}));
    CHECK(is_at(layout.nodes[3], {3, 1}));
    CHECK(layout.headings == std::vector<int>{1, 1, -1});
    CHECK(layout.rows == 2);
}

TEST_CASE("what flows against the way of a network has the other heading") {
    const LayeredLayout ring = layered_layout(2, {{0, 1}, {1, 0}}, 5);
    CHECK(ring.headings == std::vector<int>{1, -1});
    CHECK(ring.stations[0].row != ring.stations[1].row);
}

TEST_CASE("parts of networks that nothing joins stand side by side while there is room") {
    const LayeredLayout layout = layered_layout(3, {}, 2);
    CHECK(is_at(layout.nodes[1], {1, 0}));
    CHECK(is_at(layout.nodes[2], {0, 1}));
}

TEST_CASE("nothing of a network lies upon anything else") {
    std::mt19937 random(7);
    for (int run = 0; run < 60; ++run) {
        const std::size_t nodes = 1 + random() % 9, count = nodes < 2 ? 0 : random() % 12;
        Edges edges;
        while (edges.size() < count) {
            const std::size_t from = random() % nodes, to = random() % nodes;
            if (from != to) edges.emplace_back(from, to);
        }
        check_layout(nodes, edges, run % 2 == 0 ? 3 : 5);
    }
}

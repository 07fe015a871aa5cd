// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/layered_layout.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace dalembert {

namespace {

using Edge = std::pair<std::size_t, std::size_t>;

/// A connected part of a network: nodes stand in even layers, stations in odd ones, and where an edge passes a layer it has a place there.
class PartLayout {
public:
    PartLayout(const std::vector<std::size_t>& nodes, const std::vector<Edge>& edges, const std::vector<std::size_t>& own_edges)
        : nodes_(nodes), edges_(edges), own_edges_(own_edges) {}

    void run() {
        find_layers();
        add_places();
        order();
        find_rows();
    }

    void write(LayeredLayout& layout, std::size_t most_columns, GridPoint& corner) const {
        const std::size_t across = std::min(most_columns, layers_.size());
        std::vector<double> above((layers_.size() + across - 1) /
                                  across);  // what a band adds to its rows, to stand below the one before it
        double below = corner.row;
        for (std::size_t band = 0; band < above.size(); ++band) {
            double least = std::numeric_limits<double>::infinity(), most = -least;
            for (std::size_t place = 0; place < rows_.size(); ++place)
                if (layer_[place] / across == band) {
                    least = std::min(least, rows_[place]);
                    most = std::max(most, rows_[place]);
                }
            above[band] = below - least;
            below += most - least + 1;
        }
        const auto point = [&](std::size_t place) {
            const std::size_t band = layer_[place] / across, step = layer_[place] % across;
            return GridPoint{corner.column + static_cast<double>(band % 2 == 0 ? step : across - 1 - step), above[band] + rows_[place]};
        };
        for (std::size_t i = 0; i < nodes_.size(); ++i) layout.nodes[nodes_[i]] = point(i);
        for (std::size_t e = 0; e < own_edges_.size(); ++e) {
            const std::size_t edge = own_edges_[e], station = chains_[e][1];
            layout.stations[edge] = point(station);
            layout.headings[edge] = ((layer_[station] / across) % 2 == 0) == !is_reversed_[e] ? 1 : -1;
            std::vector<GridPoint> path{point(chains_[e][0])};
            for (std::size_t i = 1; i < chains_[e].size(); ++i) {
                const GridPoint from = path.back(), to = point(chains_[e][i]);
                const std::size_t band = layer_[chains_[e][i]] / across;
                if (band != layer_[chains_[e][i - 1]] / across) {  // round the end of the band, each edge on its own way
                    const double out = (0.5 + 0.02 * static_cast<double>(e % 5)) * (band % 2 == 1 ? 1 : -1);
                    path.push_back({from.column + out, from.row});
                    path.push_back({from.column + out, to.row});
                }
                path.push_back(to);
            }
            if (is_reversed_[e]) std::reverse(path.begin(), path.end());
            layout.paths[edge] = std::move(path);
        }
        const double right = corner.column + static_cast<double>(across);
        layout.columns = std::max(layout.columns, right);
        layout.rows = std::max(layout.rows, below);
        corner.column = right;
    }

    std::size_t columns() const { return layers_.size(); }

private:
    std::size_t local(std::size_t node) const {
        return static_cast<std::size_t>(std::find(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
    }

    /// The longest way to each node, after edges that close a ring are turned round; what nothing leads to stands next to where it leads.
    void find_layers() {
        const std::size_t n = nodes_.size();
        std::vector<std::vector<std::size_t>> leaving(n);
        for (std::size_t e = 0; e < own_edges_.size(); ++e) {
            ends_.emplace_back(local(edges_[own_edges_[e]].first), local(edges_[own_edges_[e]].second));
            leaving[ends_[e].first].push_back(e);
        }
        is_reversed_.assign(own_edges_.size(), false);
        std::vector<int> seen(n, 0);
        const auto visit = [&](const auto& self, std::size_t node) -> void {
            seen[node] = 1;
            for (const std::size_t e : leaving[node]) {
                const std::size_t next = ends_[e].second;
                if (seen[next] == 1)
                    is_reversed_[e] = true;
                else if (seen[next] == 0)
                    self(self, next);
            }
            seen[node] = 2;
        };
        for (std::size_t i = 0; i < n; ++i)
            if (seen[i] == 0) visit(visit, i);
        for (std::size_t e = 0; e < ends_.size(); ++e)
            if (is_reversed_[e]) std::swap(ends_[e].first, ends_[e].second);
        layer_.assign(n, 0);
        for (std::size_t round = 0; round < n; ++round)
            for (const Edge& end : ends_) layer_[end.second] = std::max(layer_[end.second], layer_[end.first] + 2);
        for (std::size_t i = 0; i < n; ++i) {
            std::size_t nearest = std::numeric_limits<std::size_t>::max();
            bool has_before = false;
            for (const Edge& end : ends_) {
                has_before = has_before || end.second == i;
                if (end.first == i) nearest = std::min(nearest, layer_[end.second]);
            }
            if (!has_before && nearest != std::numeric_limits<std::size_t>::max()) layer_[i] = nearest - 2;
        }
    }

    void add_places() {
        for (const auto& [from, to] : ends_) {
            std::vector<std::size_t> chain{from};
            for (std::size_t layer = layer_[from] + 1; layer < layer_[to]; ++layer) {
                chain.push_back(layer_.size());
                layer_.push_back(layer);
            }
            chain.push_back(to);
            chains_.push_back(std::move(chain));
        }
        before_.resize(layer_.size());
        after_.resize(layer_.size());
        for (const auto& chain : chains_)
            for (std::size_t i = 1; i < chain.size(); ++i) {
                after_[chain[i - 1]].push_back(chain[i]);
                before_[chain[i]].push_back(chain[i - 1]);
            }
        layers_.resize(layer_.empty() ? 0 : 1 + *std::max_element(layer_.begin(), layer_.end()));
        for (std::size_t place = 0; place < layer_.size(); ++place) layers_[layer_[place]].push_back(place);
    }

    std::vector<double> ranks() const {
        std::vector<double> rank(layer_.size());
        for (const auto& layer : layers_)
            for (std::size_t i = 0; i < layer.size(); ++i) rank[layer[i]] = static_cast<double>(i);
        return rank;
    }

    std::size_t crossings() const {
        const std::vector<double> rank = ranks();
        std::size_t count = 0;
        for (const auto& layer : layers_) {
            std::vector<std::pair<double, double>> lines;
            for (const std::size_t place : layer)
                for (const std::size_t next : after_[place]) lines.emplace_back(rank[place], rank[next]);
            for (std::size_t a = 0; a < lines.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    count += (lines[a].first - lines[b].first) * (lines[a].second - lines[b].second) < 0 ? 1 : 0;
        }
        return count;
    }

    static double mean(const std::vector<std::size_t>& places, const std::vector<double>& values, double otherwise) {
        double sum = 0;
        for (const std::size_t place : places) sum += values[place];
        return places.empty() ? otherwise : sum / static_cast<double>(places.size());
    }

    /// By the means of neighbours, forwards and back, as long as lines cross less often.
    void order() {
        auto best = layers_;
        std::size_t fewest = crossings();
        for (int sweep = 0; sweep < 8 && fewest > 0; ++sweep) {
            const bool is_forward = sweep % 2 == 0;
            for (std::size_t step = 0; step < layers_.size(); ++step) {
                auto& layer = layers_[is_forward ? step : layers_.size() - 1 - step];
                const std::vector<double> rank = ranks();
                const auto wished = [&](std::size_t place) { return mean((is_forward ? before_ : after_)[place], rank, rank[place]); };
                std::stable_sort(layer.begin(), layer.end(), [&](std::size_t a, std::size_t b) { return wished(a) < wished(b); });
            }
            if (const std::size_t now = crossings(); now < fewest) {
                fewest = now;
                best = layers_;
            }
        }
        layers_ = best;
    }

    /// As near to the means of neighbours as the order and a distance of one row allow: of all such rows those with the least squares,
    /// by pooling neighbours that would come too near.
    void find_rows() {
        rows_ = ranks();
        for (int sweep = 0; sweep < 6; ++sweep)
            for (std::size_t step = 0; step < layers_.size(); ++step) {
                const auto& layer = layers_[sweep % 2 == 0 ? step : layers_.size() - 1 - step];
                struct Pool {
                    double sum;
                    std::size_t count;
                    double mean() const { return sum / static_cast<double>(count); }
                };
                std::vector<Pool> pools;
                for (std::size_t i = 0; i < layer.size(); ++i) {
                    const auto& near = sweep == 5 ? layer_pair(layer[i]) : (sweep % 2 == 0 ? before_ : after_)[layer[i]];
                    pools.push_back({mean(near, rows_, rows_[layer[i]]) - static_cast<double>(i), 1});
                    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
                        pools[pools.size() - 2].sum += pools.back().sum;
                        pools[pools.size() - 2].count += pools.back().count;
                        pools.pop_back();
                    }
                }
                std::size_t i = 0;
                for (const Pool& pool : pools)
                    for (std::size_t k = 0; k < pool.count; ++k, ++i) rows_[layer[i]] = pool.mean() + static_cast<double>(i);
            }
        const double least = *std::min_element(rows_.begin(), rows_.end());
        for (double& row : rows_) row -= least;
    }

    const std::vector<std::size_t>& layer_pair(std::size_t place) {
        both_ = before_[place];
        both_.insert(both_.end(), after_[place].begin(), after_[place].end());
        return both_;
    }

    const std::vector<std::size_t>& nodes_;
    const std::vector<Edge>& edges_;
    const std::vector<std::size_t>& own_edges_;
    std::vector<Edge> ends_;  // places
    std::vector<bool> is_reversed_;
    std::vector<std::size_t> layer_;  // of places: nodes first
    std::vector<std::vector<std::size_t>> chains_, before_, after_, layers_;
    std::vector<std::size_t> both_;
    std::vector<double> rows_;
};

/// The nodes of each connected part, in order of their first nodes.
std::vector<std::vector<std::size_t>> connected_parts(std::size_t nodes, const std::vector<Edge>& edges) {
    std::vector<std::size_t> root(nodes);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::size_t node) {
        while (root[node] != node) node = root[node];
        return node;
    };
    for (const auto& [a, b] : edges) {
        const std::size_t first = find(a), second = find(b);
        root[std::max(first, second)] = std::min(first, second);
    }
    std::vector<std::vector<std::size_t>> parts;
    std::vector<std::size_t> part_of(nodes, nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
        std::size_t& part = part_of[find(i)];
        if (part == nodes) {
            part = parts.size();
            parts.emplace_back();
        }
        parts[part].push_back(i);
    }
    return parts;
}

}  // namespace

LayeredLayout layered_layout(std::size_t nodes, const std::vector<Edge>& edges, std::size_t most_columns) {
    LayeredLayout layout;
    layout.nodes.resize(nodes);
    layout.stations.resize(edges.size());
    layout.paths.resize(edges.size());
    layout.headings.assign(edges.size(), 1);
    GridPoint corner;
    for (const std::vector<std::size_t>& part : connected_parts(nodes, edges)) {
        std::vector<std::size_t> own;
        for (std::size_t e = 0; e < edges.size(); ++e)
            if (std::find(part.begin(), part.end(), edges[e].first) != part.end()) own.push_back(e);
        PartLayout made(part, edges, own);
        made.run();
        if (corner.column > 0 && corner.column + static_cast<double>(made.columns()) > static_cast<double>(most_columns))
            corner = {0, layout.rows};
        made.write(layout, most_columns, corner);
    }
    return layout;
}

}  // namespace dalembert

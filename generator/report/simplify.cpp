// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/simplify.hpp"

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// From a point to the line between two others, of no length: to these.
double distance(const PicturePoint& point, const PicturePoint& from, const PicturePoint& to) {
    const double x = to.x - from.x, y = to.y - from.y, length = x * x + y * y;
    const double share = length > 0 ? std::clamp(((point.x - from.x) * x + (point.y - from.y) * y) / length, 0.0, 1.0) : 0;
    return std::hypot(point.x - from.x - share * x, point.y - from.y - share * y);
}

std::vector<PicturePoint> simplified_piece(const std::vector<PicturePoint>& piece, double tolerance) {
    std::vector<bool> is_kept(piece.size(), false);
    is_kept.front() = is_kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, piece.size() - 1}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        std::size_t farthest = from;
        double most = tolerance;
        for (std::size_t i = from + 1; i < to; ++i)
            if (const double d = distance(piece[i], piece[from], piece[to]); d > most) {
                most = d;
                farthest = i;
            }
        if (farthest == from) continue;
        is_kept[farthest] = true;
        open.emplace_back(from, farthest);
        open.emplace_back(farthest, to);
    }
    std::vector<PicturePoint> kept;
    for (std::size_t i = 0; i < piece.size(); ++i)
        if (is_kept[i]) kept.push_back(piece[i]);
    return kept;
}

/// The lowest and the highest of each group of neighbours: of a curve that swings too often to be drawn, what its envelope spans.
std::vector<PicturePoint> extremes(const std::vector<PicturePoint>& piece, std::size_t length) {
    const auto is_lower = [](const PicturePoint& a, const PicturePoint& b) { return a.y < b.y; };
    std::vector<PicturePoint> kept;
    for (std::size_t begin = 0; begin < piece.size(); begin += length) {
        const auto from = piece.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto to = piece.begin() + static_cast<std::ptrdiff_t>(std::min(begin + length, piece.size()));
        auto [low, high] = std::minmax_element(from, to, is_lower);
        if (high < low) std::swap(low, high);
        kept.push_back(*low);
        if (high != low) kept.push_back(*high);
    }
    return kept;
}

}  // namespace

std::vector<std::vector<PicturePoint>> simplified(const std::vector<std::vector<PicturePoint>>& pieces, std::size_t most) {
    constexpr double finest = 0.15, coarsest = 5;  // px
    for (double tolerance = finest;; tolerance *= 1.4) {
        std::vector<std::vector<PicturePoint>> kept;
        std::size_t points = 0;
        for (const std::vector<PicturePoint>& piece : pieces) {
            kept.push_back(simplified_piece(piece, tolerance));
            points += kept.back().size();
        }
        if (points <= most) return kept;
        if (tolerance < coarsest) continue;
        std::size_t all = 0;
        for (const std::vector<PicturePoint>& piece : pieces) all += piece.size();
        kept.clear();
        for (const std::vector<PicturePoint>& piece : pieces) kept.push_back(extremes(piece, 2 * all / most + 1));
        return kept;
    }
}

}  // namespace dalembert

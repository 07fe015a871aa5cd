// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/crossed_strings.hpp"

#include <cln/rational.h>

#include <algorithm>
#include <map>

#include "balance/view_factors.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using cln::cl_R;
using GiNaC::ex;
using GiNaC::pow;

namespace {

/// The ends of a straight piece of string, the smaller number first.
using Piece = std::pair<std::size_t, std::size_t>;

class Strings {
public:
    Strings(const std::vector<Corner>& corners, const std::vector<PlanePoint>& numbers, Steps& steps)
        : corners_(corners), numbers_(numbers), steps_(steps) {}

    /// Half of what some pieces are longer than others. What occurs on both sides is gone.
    ex half_excess(const std::map<Piece, int>& count) {
        std::vector<Piece> longer, shorter;
        for (const auto& [piece, n] : count)
            for (int i = std::abs(n); i > 0; --i) (n > 0 ? longer : shorter).push_back(piece);
        if (longer.empty() && shorter.empty()) return 0;
        if (longer.size() == 2 && shorter.size() == 1)
            if (const auto apex = shared(longer[0], longer[1])) return wedge(*apex, other(longer[0], *apex), other(longer[1], *apex));
        if (longer.size() == 2 && shorter.size() == 2)
            if (const auto excess = crossing(longer[0], longer[1], shorter[0], shorter[1])) return *excess;
        ex sum = 0;
        for (const Piece& piece : longer) sum += length(piece);
        for (const Piece& piece : shorter) sum -= length(piece);
        return sum / 2;
    }

    ex length(const Piece& piece) {
        const auto [known, is_new] = lengths_.emplace(piece, 0);
        if (!is_new) return known->second;
        const auto [dx, dy] = between(piece.first, piece.second);
        const ex value = dx.is_zero() ? magnitude(dy) : dy.is_zero() ? magnitude(dx) : GiNaC::sqrt(pow(dx, 2) + pow(dy, 2));
        return known->second = steps_.staying("distance", {piece.first, piece.second}, value);
    }

    static Piece piece(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

private:
    std::pair<ex, ex> between(std::size_t a, std::size_t b) const {
        return {whole(corners_[b].x - corners_[a].x), whole(corners_[b].y - corners_[a].y)};
    }
    ex dot(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
        const auto [x, y] = between(a, b);
        const auto [u, v] = between(c, d);
        return whole(x * u + y * v);
    }
    ex cross(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
        const auto [x, y] = between(a, b);
        const auto [u, v] = between(c, d);
        return whole(x * v - y * u);
    }
    bool is_acute(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
        const cl_R product = (numbers_[b][0] - numbers_[a][0]) * (numbers_[d][0] - numbers_[c][0]) +
                             (numbers_[b][1] - numbers_[a][1]) * (numbers_[d][1] - numbers_[c][1]);
        return !cln::minusp(product);
    }
    int side(std::size_t a, std::size_t b, std::size_t c) const {
        const cl_R area = (numbers_[b][0] - numbers_[a][0]) * (numbers_[c][1] - numbers_[a][1]) -
                          (numbers_[b][1] - numbers_[a][1]) * (numbers_[c][0] - numbers_[a][0]);
        return cln::zerop(area) ? 0 : cln::minusp(area) ? -1 : 1;
    }

    static std::optional<std::size_t> shared(const Piece& a, const Piece& b) {
        if (a.first == b.first || a.first == b.second) return a.first;
        if (a.second == b.first || a.second == b.second) return a.second;
        return std::nullopt;
    }
    static std::size_t other(const Piece& piece, std::size_t end) { return piece.first == end ? piece.second : piece.first; }

    /// (a + b - c)/2 of a triangle with a and b at the apex: (a*b + a.b)/(a + b + c), where a*b + a.b = (a x b)^2/(a*b - a.b).
    ex wedge(std::size_t apex, std::size_t p, std::size_t q) {
        const ex a = length(piece(apex, p));
        const ex b = length(piece(apex, q));
        const ex perimeter = whole(a + b + length(piece(p, q)));
        if (is_acute(apex, p, apex, q)) return whole(a * b + dot(apex, p, apex, q)) / perimeter;
        return pow(cross(apex, p, apex, q), 2) / (whole(a * b - dot(apex, p, apex, q)) * perimeter);
    }

    /// Half of what the diagonals p and q of a convex quadrangle are longer than two opposite sides. They cross at X, which divides
    /// them as the areas on both sides of the other: two triangles with their apex at X, each as in wedge().
    std::optional<ex> crossing(const Piece& p, const Piece& q, const Piece& b, const Piece& d) {
        const std::size_t p1 = p.first, p3 = p.second;
        std::size_t p2 = q.first, p4 = q.second;
        if (piece(p2, p3) != b && piece(p2, p3) != d) std::swap(p2, p4);
        const bool fits = (piece(p2, p3) == b && piece(p1, p4) == d) || (piece(p2, p3) == d && piece(p1, p4) == b);
        if (!fits || side(p1, p3, p2) * side(p1, p3, p4) >= 0 || side(p2, p4, p1) * side(p2, p4, p3) >= 0) return std::nullopt;
        const ex alpha = cross(p1, p2, p1, p4);
        const ex beta = cross(p3, p4, p3, p2);
        const ex gamma = cross(p2, p3, p2, p1);
        const ex delta = cross(p4, p1, p4, p3);
        const ex both = steps_("crossing", {p1, p2, p3, p4}, alpha + beta);
        const ex& P = length(p);
        const ex& Q = length(q);
        const ex near = gamma * beta / ((Q * gamma + P * beta) / both + length(piece(p2, p3)));
        const ex far = alpha * delta / ((P * alpha + Q * delta) / both + length(piece(p1, p4)));
        // P*Q*(1 + cos) of the angle between the halves of the diagonals, over both^2.
        const ex scalar = dot(p1, p3, p4, p2);
        if (is_acute(p1, p3, p4, p2)) return whole(near + far) * whole(P * Q + scalar) / pow(both, 2);
        return whole(near + far) / whole(P * Q - scalar);
    }

    const std::vector<Corner>& corners_;
    const std::vector<PlanePoint>& numbers_;
    Steps& steps_;
    std::map<Piece, ex> lengths_;
};

}  // namespace

PrismAreas crossed_strings(const std::vector<Corner>& corners, const Polygon& polygon, const std::vector<PlanePoint>& numbers,
                           const ex& height, Steps& steps) {
    const std::size_t n = corners.size();
    const auto courses = polygon.strings();
    Strings strings(corners, numbers, steps);
    PrismAreas result{std::vector<ex>(n), std::vector<std::vector<ex>>(n, std::vector<ex>(n, 0))};
    for (std::size_t i = 0; i < n; ++i) result.areas[i] = steps("area", {i}, height * strings.length(Strings::piece(i, polygon.next(i))));
    std::map<Pair, ex> values;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            std::map<Piece, int> count;
            const auto add = [&](std::size_t a, std::size_t b, int sign) {
                const Course& course = courses[a][b];
                for (std::size_t k = 0; k + 1 < course.size(); ++k) count[Strings::piece(course[k], course[k + 1])] += sign;
            };
            add(i, j, 1);
            add(polygon.next(i), polygon.next(j), 1);
            add(polygon.next(i), j, -1);
            add(i, polygon.next(j), -1);
            const ex excess = strings.half_excess(count);
            if (!excess.is_zero()) values[{i, j}] = height * excess;
        }
    // The strings telescope, so that rows add up to A_i (4.47): in proofs some of the areas seen are what the others leave.
    std::vector<Pair> left;
    for (const auto& [pair, value] : values) {
        left.push_back(pair);
        if (left.size() > n || solve_rows(result.areas, result.direct, left).undetermined) left.pop_back();
    }
    const auto set = [&](const Pair& pair, const ex& e) {
        result.direct[pair.first][pair.second] = result.direct[pair.second][pair.first] = e;
    };
    for (const auto& [pair, value] : values)
        if (std::find(left.begin(), left.end(), pair) == left.end())
            set(pair, steps.staying("view_area", {pair.first, pair.second}, value));
    const SolvedRows solved = solve_rows(result.areas, result.direct, left);
    for (std::size_t u = 0; u < left.size(); ++u)
        set(left[u], steps.staying("view_area", {left[u].first, left[u].second}, values.at(left[u]), solved.values[u]));
    return result;
}

}  // namespace dalembert

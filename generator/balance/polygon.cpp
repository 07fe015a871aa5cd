// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/polygon.hpp"

#include <cln/rational.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <tuple>

namespace dalembert {

using cln::cl_R;

namespace {

cl_R cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
cl_R distance(const PlanePoint& a, const PlanePoint& b) {
    static const cln::float_format_t precision = cln::float_format(60);
    return cln::sqrt(cln::cl_float(cln::square(a[0] - b[0]) + cln::square(a[1] - b[1]), precision));
}

}  // namespace

Polygon::Polygon(std::vector<PlanePoint> corners) : corners_(std::move(corners)) {
    cl_R area = 0;
    cl_R size_squared = 0;
    for (std::size_t i = 0; i < size(); ++i) {
        area = area + cross(corners_[0], corners_[i], corners_[next(i)]);
        for (std::size_t j = 0; j < i; ++j)
            size_squared =
                cln::max(size_squared, cln::square(corners_[i][0] - corners_[j][0]) + cln::square(corners_[i][1] - corners_[j][1]));
    }
    // Corners with roots or pi have 60 digits; exact ones lose nothing by a margin of forty.
    tiny_ = size_squared * cln::expt(cln::cl_RA(10), -40);
    orientation_ = cln::minusp(area) ? -1 : 1;
}

/// Of the way a, b, c: 1 to the inside, -1 to the outside, 0 straight or back.
int Polygon::turn(std::size_t a, std::size_t b, std::size_t c) const {
    const cl_R area = cross(corners_[a], corners_[b], corners_[c]);
    if (cln::abs(area) <= tiny_) return 0;
    return cln::minusp(area) ? -orientation_ : orientation_;
}

/// Whether c lies on the line from a to b, ends excluded.
bool Polygon::is_between(std::size_t a, std::size_t c, std::size_t b) const {
    if (turn(a, b, c) != 0) return false;
    const auto& [A, B, C] = std::tie(corners_[a], corners_[b], corners_[c]);
    const cl_R along = (C[0] - A[0]) * (B[0] - A[0]) + (C[1] - A[1]) * (B[1] - A[1]);
    const cl_R whole = cln::square(B[0] - A[0]) + cln::square(B[1] - A[1]);
    return along > tiny_ && along < whole - tiny_;
}

std::optional<std::pair<std::size_t, std::size_t>> Polygon::problem() const {
    for (std::size_t i = 0; i < size(); ++i)
        if (cln::square(corners_[i][0] - corners_[next(i)][0]) + cln::square(corners_[i][1] - corners_[next(i)][1]) <= tiny_)
            return std::pair(i, i);
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t j = i + 1; j < size(); ++j) {
            const std::size_t a = i, b = next(i), c = j, d = next(j);
            // Neighbours share a corner, but nothing else.
            for (const auto& [p, q, corner] : {std::tuple(a, b, c), std::tuple(a, b, d), std::tuple(c, d, a), std::tuple(c, d, b)})
                if (is_between(p, corner, q)) return std::pair(i, j);
            const bool are_neighbours = b == c || d == a;
            if (are_neighbours) continue;
            const bool same_corner = a == c || distance(corners_[a], corners_[c]) * distance(corners_[a], corners_[c]) <= tiny_;
            if (same_corner || (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)) return std::pair(i, j);
        }
    return std::nullopt;
}

/// Whether the way from a to b begins inside.
bool Polygon::is_inward(std::size_t a, std::size_t b) const {
    const std::size_t before = (a + size() - 1) % size();
    const std::size_t behind = next(a);
    if (turn(before, a, behind) >= 0) return turn(a, b, before) > 0 && turn(b, a, behind) > 0;
    return !(turn(a, b, behind) >= 0 && turn(b, a, before) >= 0);
}

bool Polygon::see_each_other(std::size_t a, std::size_t b) const {
    if (next(a) == b || next(b) == a) return true;
    for (std::size_t c = 0; c < size(); ++c) {
        if (c != a && c != b && is_between(a, c, b)) return false;
        const std::size_t d = next(c);
        if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return false;
    }
    return is_inward(a, b);
}

/// Shortest ways in the graph of corners that see each other. In a simple polygon there is one shortest way.
std::vector<std::vector<Course>> Polygon::strings() const {
    const std::size_t n = size();
    std::vector<std::vector<std::optional<cl_R>>> length(n, std::vector<std::optional<cl_R>>(n));
    std::vector<std::vector<std::size_t>> first(n, std::vector<std::size_t>(n));  // the corner behind i on the way to j
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (i == j) length[i][j] = cl_R(0);
            else if (see_each_other(i, j)) length[i][j] = distance(corners_[i], corners_[j]);
            first[i][j] = j;
        }
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                if (k == i || k == j || !length[i][k] || !length[k][j]) continue;
                const cl_R by_k = *length[i][k] + *length[k][j];
                if (length[i][j] && *length[i][j] <= by_k) continue;
                length[i][j] = by_k;
                first[i][j] = first[i][k];
            }
    std::vector<std::vector<Course>> courses(n, std::vector<Course>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            courses[i][j] = {i};
            while (courses[i][j].back() != j) courses[i][j].push_back(first[courses[i][j].back()][j]);
        }
    return courses;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/curvilinear.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_lines = 3;

}  // namespace

CurvilinearCoordinates::CurvilinearCoordinates(const BodyMotion& body, const Translator& translate, const Span& place)
    : symbols_(translate.symbols()), squares_(PositiveByRange(translate)) {
    const std::string name = body.member.name();
    if (!body.has_position)
        throw Failure(Diagnostic{Id::not_allowed_here,
                                 place,
                                 fmt::format("body '{}' has no position, so no coordinate moves it along a line", name),
                                 {{body.member.item->span, "the body is defined here"}}});
    for (std::size_t j = 0; j < symbols_.degrees(); ++j) {
        SpaceVector tangent = body.along(j, symbols_);
        for (ex& component : tangent) component = squares_.shortened(component);
        if (is_zero(tangent)) continue;
        if (!symbols_.has_value(j))
            throw Failure(
                Diagnostic{Id::not_allowed_here,
                           place,
                           fmt::format("the position of body '{}' turns with a quaternion, whose '{}' has no value and therefore no line",
                                       name, symbols_.all(SymbolKind::coordinate)[j].name),
                           {{body.member.item->span, "the body is defined here"}}});
        lines_.push_back(j);
        tangents_.push_back(tangent);
    }
    if (lines_.size() > most_lines)
        throw Failure(Diagnostic{Id::not_allowed_here,
                                 place,
                                 fmt::format("the position of body '{}' depends on {} coordinates; a point in space has at most {}", name,
                                             lines_.size(), most_lines),
                                 {{body.member.item->span, "the body is defined here"}}});
    by_time_ = partial(body.position, symbols_.time());
    for (std::size_t a = 0; a < lines_.size(); ++a) {
        metric_.emplace_back();
        for (std::size_t b = 0; b < lines_.size(); ++b)
            metric_[a].push_back(b < a ? metric_[b][a] : squares_.shortened(dot(tangents_[a], tangents_[b])));
    }
    const std::size_t n = lines_.size();
    GiNaC::matrix g(static_cast<unsigned>(n), static_cast<unsigned>(n));
    for (unsigned a = 0; a < n; ++a)
        for (unsigned b = 0; b < n; ++b) g(a, b) = metric_[a][b];
    determinant_ = n == 0 ? ex(0) : squares_.shortened(g.determinant(GiNaC::determinant_algo::laplace));
}

std::size_t CurvilinearCoordinates::at(std::size_t coordinate) const {
    return static_cast<std::size_t>(std::find(lines_.begin(), lines_.end(), coordinate) - lines_.begin());
}

ex CurvilinearCoordinates::scale_factor(std::size_t i) const { return at(i) == lines_.size() ? ex(0) : squares_.root(metric(i, i)); }

ex CurvilinearCoordinates::drift(std::size_t a, const SpaceVector& v) const {
    return is_zero(v) ? ex(0) : squares_.shortened(dot(tangents_[a], v));
}

/// v = (dr/dq_j) qd_j + dr/dt, of which dr/dq_j . e_i is left for j = i alone.
ex CurvilinearCoordinates::velocity_along(std::size_t i) const {
    const ex h = scale_factor(i);
    return h * symbols_.get(SymbolKind::velocity, i) + drift(at(i), by_time_) / h;
}

/// a.dr/dq_i = g_ij qdd_j + [jk, i] qd_j qd_k + (2 d(dr/dt)/dq_j qd_j + d2r/dt2).dr/dq_i
ex CurvilinearCoordinates::acceleration_along(std::size_t i) const {
    const ex h = scale_factor(i);
    ex sum = h * symbols_.get(SymbolKind::acceleration, i);
    const auto qd = [&](std::size_t a) { return symbols_.get(SymbolKind::velocity, lines_[a]); };
    for (std::size_t a = 0; a < lines_.size(); ++a) {
        for (std::size_t b = a; b < lines_.size(); ++b)
            sum += (a == b ? 1 : 2) * christoffel_first(i, lines_[a], lines_[b]) / h * qd(a) * qd(b);
        sum += 2 * drift(at(i), partial(by_time_, symbols_.get(SymbolKind::coordinate, lines_[a]))) / h * qd(a);
    }
    return sum + drift(at(i), partial(by_time_, symbols_.time())) / h;
}

ex CurvilinearCoordinates::christoffel_first(std::size_t k, std::size_t i, std::size_t j) const {
    const auto slope = [&](std::size_t a, std::size_t b, std::size_t by) {
        return partial(metric(a, b), symbols_.get(SymbolKind::coordinate, by));
    };
    return squares_.shortened((slope(j, k, i) + slope(i, k, j) - slope(i, j, k)) / 2);
}

/// The determinant of what is left of the metric without a row and a column.
ex CurvilinearCoordinates::minor_of(std::size_t a, std::size_t b) const {
    std::vector<std::size_t> rows, columns;
    for (std::size_t c = 0; c < lines_.size(); ++c) {
        if (c != a) rows.push_back(c);
        if (c != b) columns.push_back(c);
    }
    if (rows.empty()) return 1;
    if (rows.size() == 1) return metric_[rows[0]][columns[0]];
    return metric_[rows[0]][columns[0]] * metric_[rows[1]][columns[1]] - metric_[rows[0]][columns[1]] * metric_[rows[1]][columns[0]];
}

/// g^ab, by minors: of three rows at most, and one over the diagonal where lines are at right angles.
ex CurvilinearCoordinates::inverse(std::size_t a, std::size_t b) const {
    bool is_diagonal = true;
    for (std::size_t c = 0; c < lines_.size(); ++c)
        for (std::size_t d = 0; d < c; ++d) is_diagonal = is_diagonal && metric_[c][d].is_zero();
    if (is_diagonal) return a == b ? 1 / metric_[a][a] : ex(0);
    return ((a + b) % 2 == 0 ? 1 : -1) * squares_.shortened(minor_of(a, b)) / determinant_;
}

ex CurvilinearCoordinates::christoffel_second(std::size_t k, std::size_t i, std::size_t j) const {
    ex sum = 0;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
        const ex factor = inverse(at(k), l);
        if (!factor.is_zero()) sum += factor * christoffel_first(lines_[l], i, j);
    }
    return sum;
}

}  // namespace dalembert

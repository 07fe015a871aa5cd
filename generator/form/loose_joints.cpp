// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/loose_joints.hpp"

#include <algorithm>
#include <cmath>

#include "form/random_points.hpp"

namespace dalembert {

namespace {

using Rows = std::vector<std::vector<double>>;

/// The factors at the first point where all of them have a value.
std::optional<Rows> numbers(const System& system, const std::vector<JointBalance>& balances) {
    RandomPoints points(system);
    constexpr int tries = 10;
    for (int i = 0; i < tries; ++i) {
        const Point point = points.next();
        Rows rows;
        bool has_values = true;
        for (const JointBalance& balance : balances) {
            rows.emplace_back();
            for (const GiNaC::ex& factor : balance.factors) {
                const auto value = value_at(factor, system.symbols, point, 30);
                has_values = has_values && value;
                rows.back().push_back(value ? cln::double_approx(*value) : 0);
            }
        }
        if (has_values) return rows;
    }
    return std::nullopt;
}

double largest(const std::vector<double>& row, std::size_t count) {
    double result = 0;
    for (std::size_t j = 0; j < count; ++j) result = std::max(result, std::fabs(row[j]));
    return result;
}

}  // namespace

LooseJoints loose_joints(const System& system, const std::vector<JointBalance>& balances) {
    std::optional<Rows> found = balances.empty() ? std::nullopt : numbers(system, balances);
    if (!found) return {};
    Rows& rows = *found;
    const std::size_t n = rows.size(), unknowns = rows[0].size();
    double scale = 0;
    for (std::size_t i = 0; i < n; ++i) {
        scale = std::max(scale, largest(rows[i], unknowns));
        rows[i].resize(unknowns + n, 0);  // behind the factors: which balances a row is the sum of
        rows[i][unknowns + i] = 1;
    }
    const double nothing = 1e-9 * scale;
    std::size_t next = 0;
    for (std::size_t j = 0; j < unknowns && next < n; ++j) {
        for (std::size_t i = next + 1; i < n; ++i)
            if (std::fabs(rows[i][j]) > std::fabs(rows[next][j])) std::swap(rows[i], rows[next]);
        if (std::fabs(rows[next][j]) <= nothing) continue;
        for (std::size_t i = next + 1; i < n; ++i) {
            const double factor = rows[i][j] / rows[next][j];
            for (std::size_t k = j; factor != 0 && k < rows[i].size(); ++k) rows[i][k] -= factor * rows[next][k];
        }
        ++next;
    }
    if (next == n) return {};
    LooseJoints result;
    const std::vector<double> motion(rows[next].begin() + static_cast<std::ptrdiff_t>(unknowns), rows[next].end());
    const double least = 1e-9 * largest(motion, n);
    std::size_t moves = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (std::fabs(motion[i]) <= least) continue;
        ++moves;
        result.axis = balances[i].axis;
        if (std::find(result.names.begin(), result.names.end(), balances[i].joint) == result.names.end())
            result.names.push_back(balances[i].joint);
    }
    if (moves != 1) result.axis.reset();
    std::sort(result.names.begin(), result.names.end());
    return result;
}

}  // namespace dalembert

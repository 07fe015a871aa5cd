// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/on_constraints.hpp"

#include <algorithm>

namespace dalembert {

using cln::cl_R;
using GiNaC::ex;

namespace {

constexpr int digits = 40;
constexpr int most_steps = 60;
constexpr int met_digits = digits - 5;  ///< where Newton's steps end
/// Where constraints depend on each other Newton's steps only halve the distance, whose square is what is left: so many digits tell that
/// they do.
constexpr int dependent_digits = 14;

/// Beside which something counts as zero.
cl_R tenth_to(unsigned exponent) { return cln::recip(cl_R(cln::expt_pos(cln::cl_I(10), exponent))); }

cl_R product(const std::vector<cl_R>& a, const std::vector<cl_R>& b) {
    cl_R sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum = sum + a[i] * b[i];
    return sum;
}

/// Rows made orthogonal one after the other, each with the right side that it gets on the way. Rows of which nothing is left are zero.
struct Orthogonal {
    std::vector<std::vector<cl_R>> rows;
    std::vector<cl_R> right, squares;
    std::vector<bool> is_dependent;

    Orthogonal(std::vector<std::vector<cl_R>> factors, std::vector<cl_R> rest)
        : Orthogonal(factors, std::move(rest), digits / 2, factors) {}
    /// A row counts as zero beside its own size, and that of the same row elsewhere.
    Orthogonal(std::vector<std::vector<cl_R>> factors, std::vector<cl_R> rest, int zero_digits,
               const std::vector<std::vector<cl_R>>& elsewhere) {
        const cl_R nothing = tenth_to(zero_digits);
        for (std::size_t i = 0; i < factors.size(); ++i) {
            std::vector<cl_R> row = factors[i];
            const cl_R before = cln::max(product(row, row), product(elsewhere[i], elsewhere[i]));
            cl_R value = rest[i];
            for (int twice = 0; twice < 2; ++twice)
                for (std::size_t k = 0; k < rows.size(); ++k) {
                    if (is_dependent[k]) continue;
                    const cl_R factor = product(row, rows[k]) / squares[k];
                    for (std::size_t j = 0; j < row.size(); ++j) row[j] = row[j] - factor * rows[k][j];
                    value = value - factor * right[k];
                }
            const cl_R left = product(row, row);
            is_dependent.push_back(left <= nothing * nothing * before);
            rows.push_back(std::move(row));
            right.push_back(value);
            squares.push_back(left);
        }
    }

    /// The least x with rows*x = right, as far as they are independent.
    std::vector<cl_R> least(std::size_t n) const {
        std::vector<cl_R> x(n, 0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (is_dependent[i]) continue;
            const cl_R factor = right[i] / squares[i];
            for (std::size_t j = 0; j < n; ++j) x[j] = x[j] + factor * rows[i][j];
        }
        return x;
    }
};

}  // namespace

ConstraintPoints::ConstraintPoints(const System& system, std::vector<std::size_t> order, const Values& values)
    : system_(system), order_(std::move(order)), values_(values), start_(values.substitution()) {
    add_steps(start_, system.symbols, digits);
    for (auto& [letter, value] : start_)
        if (const auto number = value_at(value, {}, digits)) value = GiNaC::numeric(*number);
}

cl_R ConstraintPoints::value(const ex& e, const GiNaC::exmap& point) const { return value_at(e, point, digits).value_or(0); }

/// Zero but for a billionth of the terms that it is made of, all of which may be zero, or as far as Newton's steps go.
bool ConstraintPoints::is_met(const ex& e, const FloatPoint& at) const {
    const ex sum = system_.symbols.without_definitions(e).expand();
    cl_R whole = 0, size = 0;
    const bool is_sum = GiNaC::is_exactly_a<GiNaC::add>(sum);
    for (std::size_t i = 0; i < (is_sum ? sum.nops() : 1); ++i) {
        const auto term = at.value(is_sum ? sum.op(i) : sum);
        if (!term) return false;
        whole = whole + *term;
        size = size + cln::abs(*term);
    }
    return cln::abs(whole) <= size * tenth_to(9) + tenth_to(met_digits);
}

/// The slopes of a row that are not zero; of positions they are derived once.
const ConstraintPoints::Slopes& ConstraintPoints::slopes(std::size_t constraint, bool of_rates) const {
    const auto [entry, is_new] = slopes_.try_emplace({constraint, of_rates});
    if (!is_new) return entry->second;
    const ConstraintEquation& c = system_.constraints[constraint];
    for (std::size_t j = 0; j < system_.symbols.degrees(); ++j)
        if (const ex slope = of_rates ? c.rate.jacobian[j] : system_.symbols.along(*c.position, j); !slope.is_zero())
            entry->second.emplace_back(j, slope);
    return entry->second;
}

/// Positions and their derivatives by the coordinates, or rates and theirs by the velocities.
std::optional<ConstraintPoints::Rows> ConstraintPoints::rows(const GiNaC::exmap& point, bool of_rates) const {
    Rows result;
    const FloatPoint at(point, digits);
    for (const std::size_t i : order_) {
        const ConstraintEquation& c = system_.constraints[i];
        if (!of_rates && !c.position) continue;
        Row row(system_.symbols.degrees(), 0);
        for (const auto& [j, e] : slopes(i, of_rates)) {
            const auto slope = at.value(e);
            if (!slope) return std::nullopt;
            row[j] = *slope;
        }
        const auto rest = at.value(of_rates ? c.whole_rate : *c.position);
        if (!rest) return std::nullopt;
        result.factors.push_back(std::move(row));
        result.rest.push_back(*rest);
    }
    return result;
}

/// Of an attitude: turned a little, with the norm kept.
void ConstraintPoints::displace(GiNaC::exmap& point, std::size_t coordinate, const cl_R& step) const {
    const Symbols& symbols = system_.symbols;
    if (symbols.has_value(coordinate)) {
        ex& q = point[symbols.get(SymbolKind::coordinate, coordinate)];
        q = q + GiNaC::numeric(step);
        return;
    }
    for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes())
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (attitude.coordinates[axis] != coordinate) continue;
            std::array<ex, 4> turned;
            ex square = 0;
            for (std::size_t part = 0; part < 4; ++part) {
                turned[part] =
                    point.at(symbols.get(SymbolKind::state, attitude.parts[part])) +
                    symbols.quaternion_slope(attitude, part, axis).subs(point, GiNaC::subs_options::no_pattern) * GiNaC::numeric(step);
                square += GiNaC::pow(turned[part], 2);
            }
            for (std::size_t part = 0; part < 4; ++part)
                point[symbols.get(SymbolKind::state, attitude.parts[part])] = (turned[part] / GiNaC::sqrt(square)).evalf();
        }
}

/// Newton's method with the least step of what is free, halved until it helps.
void ConstraintPoints::meet_positions(GiNaC::exmap& point, const std::vector<bool>& is_free) const {
    const std::size_t n = system_.symbols.degrees();
    const auto size_of = [](const Rows& r) { return product(r.rest, r.rest); };
    auto here = rows(point, false);
    for (int step = 0; here && step < most_steps; ++step) {
        const cl_R size = size_of(*here);
        if (size <= tenth_to(2 * met_digits)) return;
        for (Row& row : here->factors)
            for (std::size_t j = 0; j < n; ++j)
                if (!is_free[j]) row[j] = 0;
        const std::vector<cl_R> x = Orthogonal(here->factors, here->rest).least(n);
        cl_R length = 1;
        bool is_better = false;
        for (int half = 0; half < 20 && !is_better; ++half, length = length / 2) {
            GiNaC::exmap next = point;
            for (std::size_t j = 0; j < n; ++j) displace(next, j, -length * x[j]);
            auto there = rows(next, false);
            is_better = there && size_of(*there) < size;
            if (!is_better) continue;
            point = std::move(next);
            here = std::move(there);
        }
        if (!is_better) return;
    }
}

void ConstraintPoints::meet_rates(GiNaC::exmap& point, const std::vector<bool>& is_free) const {
    const std::size_t n = system_.symbols.degrees();
    auto here = rows(point, true);
    if (!here) return;
    for (Row& row : here->factors)
        for (std::size_t j = 0; j < n; ++j)
            if (!is_free[j]) row[j] = 0;
    const std::vector<cl_R> x = Orthogonal(here->factors, here->rest).least(n);
    for (std::size_t j = 0; j < n; ++j) {
        ex& v = point[system_.symbols.get(SymbolKind::velocity, j)];
        v = v - GiNaC::numeric(x[j]);
    }
}

ConstrainedPoint ConstraintPoints::find(GiNaC::exmap point, const std::vector<bool>& free_positions,
                                        const std::vector<bool>& free_velocities) const {
    meet_positions(point, free_positions);
    meet_rates(point, free_velocities);
    ConstrainedPoint result;
    const FloatPoint at(point, digits);
    for (const std::size_t i : order_) {
        const ConstraintEquation& c = system_.constraints[i];
        if (c.position && !is_met(*c.position, at)) result.broken.push_back(i);
        if (!is_met(c.whole_rate, at)) result.broken_rates.push_back(i);
    }
    if (const auto r = rows(point, true)) {
        const auto at_start = rows(start_, true);
        const Orthogonal orthogonal(r->factors, r->rest, dependent_digits, at_start ? at_start->factors : r->factors);
        for (std::size_t i = 0; i < order_.size(); ++i)
            if (orthogonal.is_dependent[i]) result.dependent.push_back(order_[i]);
    }
    result.values = std::move(point);
    return result;
}

ConstrainedPoint ConstraintPoints::near_start(bool keeps_written) const {
    std::vector<bool> positions, velocities;
    for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) {
        // The start of an attitude is always given.
        positions.push_back(!keeps_written || (system_.symbols.has_value(j) && !values_.is_written(SymbolKind::coordinate, j)));
        velocities.push_back(!keeps_written || !values_.is_written(SymbolKind::velocity, j));
    }
    return find(start_, positions, velocities);
}

std::vector<std::size_t> ConstraintPoints::redundant() const {
    constexpr int points = 6;
    const std::vector<bool> all(system_.symbols.degrees(), true);
    std::vector<std::vector<std::size_t>> dependent;
    std::uint64_t seed = 88172645463325252ULL;
    for (int i = 0; i < points; ++i) {
        GiNaC::exmap near = start_;
        for (const Variable& q : system_.symbols.all(SymbolKind::coordinate)) {
            if (!system_.symbols.has_value(q.position)) continue;
            seed ^= seed << 13U, seed ^= seed >> 7U, seed ^= seed << 17U;  // xorshift
            const GiNaC::numeric share(static_cast<long>(seed % 2001U) - 1000, 5000);
            near[q.symbol] =
                near.at(q.symbol) + share * (GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(near.at(q.symbol))) + GiNaC::numeric(1, 10));
        }
        const ConstrainedPoint point = find(std::move(near), all, all);
        if (!point.broken.empty()) continue;
        dependent.push_back(point.dependent);
    }
    // Singular positions, where more depend on each other than elsewhere, tell nothing.
    std::size_t least = order_.size();
    for (const auto& here : dependent) least = std::min(least, here.size());
    std::erase_if(dependent, [&](const auto& here) { return here.size() > least; });
    std::vector<std::size_t> result = order_;
    for (const auto& here : dependent)
        std::erase_if(result, [&](std::size_t c) { return std::find(here.begin(), here.end(), c) == here.end(); });
    return dependent.size() >= 2 ? result : std::vector<std::size_t>();
}

bool holds_in(const Scene& scene, const ConstraintEquation& constraint, std::size_t mode) {
    return !constraint.item->share && scene.holds(constraint.item->when, mode);
}

bool holds_in_all_modes(const Scene& scene, const ConstraintEquation& constraint) {
    for (std::size_t mode = 0; mode < scene.modes.size(); ++mode)
        if (!holds_in(scene, constraint, mode)) return false;
    return true;
}

}  // namespace dalembert

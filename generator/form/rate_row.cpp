// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/rate_row.hpp"

#include <algorithm>
#include <numeric>

#include "balance/steps.hpp"
#include "symbolic/squares.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Columns in which the rows are independent, the first ones that are.
std::vector<std::size_t> independent_columns(const std::vector<RateRow>& rows, std::size_t count) {
    std::vector<std::size_t> columns;
    const auto determinant = [&] {
        const auto size = static_cast<unsigned>(columns.size());
        GiNaC::matrix m(size, size);
        for (unsigned i = 0; i < size; ++i)
            for (unsigned k = 0; k < size; ++k) m(i, k) = rows[i].factors[columns[k]];
        return m.determinant();
    };
    // Of the first rows: what is found for them may not serve for the next one, and is given up then.
    const auto find = [&](const auto& again, std::size_t from) -> bool {
        if (columns.size() == rows.size()) return true;
        for (std::size_t j = from; j < count; ++j) {
            columns.push_back(j);
            if (columns.size() < rows.size() ? again(again, j + 1) : !vanishes(determinant())) return true;
            columns.pop_back();
        }
        return false;
    };
    find(find, 0);
    return columns;
}

}  // namespace

RateRow row_of(const System& system, std::size_t constraint) {
    const ConstraintEquation& c = system.constraints[constraint];
    RateRow row{c.rate.jacobian, c.rate.drift, std::vector<ex>(system.constraints.size(), 0), 0, constraint, c.item};
    for (ex& factor : row.factors) factor = factor.expand();
    row.made_of[constraint] = 1;
    return row;
}

void take(RateRow& from, const ex& times, const RateRow& row) {
    const ex factor = times;
    if (factor.is_zero()) return;
    const auto less = [&](ex& a, const ex& b) { a = (a - factor * b).expand(); };
    for (std::size_t j = 0; j < from.factors.size(); ++j) less(from.factors[j], row.factors[j]);
    less(from.drift, row.drift);
    for (std::size_t i = 0; i < from.made_of.size(); ++i) less(from.made_of[i], row.made_of[i]);
}

bool is_zero(const RateRow& row) {
    return std::all_of(row.factors.begin(), row.factors.end(), [](const ex& factor) { return factor.is_zero(); });
}

bool vanishes(const ex& e) { return e.is_zero() || in_cosines(e.normal().numer()).is_zero(); }

std::optional<ex> multiple_of(const RateRow& row, const RateRow& other, const Symbols& symbols) {
    std::optional<ex> factor;
    const std::size_t n = row.factors.size();
    for (std::size_t j = 0; j < n && !factor; ++j)
        if (!other.factors[j].is_zero()) factor = ex(row.factors[j] / other.factors[j]).normal();
    if (!factor || factor->is_zero() || !is_of_parameters(*factor, symbols)) return std::nullopt;
    for (std::size_t j = 0; j < n; ++j)
        if (!ex(row.factors[j] - *factor * other.factors[j]).expand().is_zero()) return std::nullopt;
    return factor;
}

std::optional<RateRow> what_follows(const RateRow& row, const std::vector<RateRow>& others) {
    constexpr std::size_t most = 3;
    if (others.empty() || others.size() > most) return std::nullopt;
    const std::vector<std::size_t> columns = independent_columns(others, row.factors.size());
    if (columns.empty()) return std::nullopt;
    const auto size = static_cast<unsigned>(others.size());
    GiNaC::matrix factors(size, size), wanted(size, 1), unknown(size, 1);
    for (unsigned k = 0; k < size; ++k) {
        wanted(k, 0) = row.factors[columns[k]];
        unknown(k, 0) = GiNaC::symbol();
        for (unsigned i = 0; i < size; ++i) factors(k, i) = others[i].factors[columns[k]];
    }
    const GiNaC::matrix times = factors.solve(unknown, wanted);
    RateRow left = row;
    for (unsigned i = 0; i < size; ++i) take(left, times(i, 0), others[i]);
    if (!std::all_of(left.factors.begin(), left.factors.end(), [](const ex& factor) { return vanishes(factor); })) return std::nullopt;
    std::fill(left.factors.begin(), left.factors.end(), ex(0));
    for (ex& factor : left.made_of) factor = factor.normal();
    return left;
}

}  // namespace dalembert

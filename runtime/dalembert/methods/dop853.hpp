// SPDX-License-Identifier: BSL-1.0
// The Runge-Kutta method of Dormand and Prince of order 8 with error estimates of orders 5 and 3 and dense output of order 7: Hairer,
// Norsett, Wanner: Solving Ordinary Differential Equations I, 2nd edition, sections II.5, II.6 and II.10. A step costs twelve calls of the
// right-hand side, its dense output three more, made when something asks for a state within it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "dalembert/methods/dop853_coefficients.hpp"
#include "dalembert/methods/stepper.hpp"

/// The loop that follows writes to no array that it reads; a compiler that cannot see so makes no vectors of it.
#if defined(__GNUC__) && !defined(__clang__)
#define DALEMBERT_NO_ALIAS _Pragma("GCC ivdep")
#else
#define DALEMBERT_NO_ALIAS
#endif

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Equation (10.17): of the estimates of orders 5 and 3 that which shrinks like h^8, here state by state. Of norms of all states it would
/// be no larger: where one of them has the largest estimate of order 5, none need have a larger one of order 3.
template <class Scalar>
Scalar dop853_error(const Scalar& fifth, const Scalar& third) {
    using std::abs;
    using std::max;
    using std::sqrt;
    const Scalar a = abs(fifth);
    const Scalar b = abs(third) / Scalar(10);
    const Scalar largest = max(a, b);
    if (!(largest > Scalar(0))) return a * b;  // zero, or no number
    const Scalar ratio = (a < b ? a : b) / largest;  // so that no square vanishes
    return (a < b ? a * ratio : a) / sqrt(Scalar(1) + ratio * ratio);
}

/// The last stage of a step is the first of the next.
template <class State, class Rhs>
class DormandPrince853 final : public Stepper<State> {
    using Scalar = typename State::value_type;
    using Table = Dop853Coefficients;

public:
    explicit DormandPrince853(Rhs rhs) : rhs_(rhs) {}

    int order() const override { return 8; }

    void take(const Point<State>& from, Candidate<State>& c) override {
        is_dense_ = false;
        k_[0] = from.dxdt;
        make_stages(from, c, std::make_index_sequence<11>{});
        const Scalar h = c.length;
        State& third = d_[0];  // no dense output is made yet
        DALEMBERT_NO_ALIAS
        for (std::size_t i = 0; i < c.y.size(); ++i) {
            const Scalar rate = sum<Table::result>(i);
            c.y[i] = from.x[i] + h * rate;
            c.error[i] = h * sum<Table::fifth>(i);
            third[i] = h * (rate - sum<Table::third>(i));
        }
        for (std::size_t i = 0; i < c.y.size(); ++i) c.error[i] = dop853_error(c.error[i], third[i]);
        rhs_(c.y, c.dydt, c.end);
        c.has_derivative = true;
        c.finite = are_finite(c.y, c.error) && are_finite(c.dydt, c.dydt);
    }

    /// With s from 0 to 1 and r = 1 - s: x + s (a + r (b + s (c + r (d0 + s (d1 + r (d2 + s d3)))))); without d it is Hermite's cubic.
    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override {
        if (!is_dense_) make_dense(from, c);
        const Scalar s = (t - from.t) / c.length;
        const Scalar r = Scalar(1) - s;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Scalar change = c.y[i] - from.x[i];
            const Scalar begin = c.length * from.dxdt[i] - change;
            const Scalar end = change - c.length * c.dydt[i] - begin;
            const Scalar higher = c.length * (d_[0][i] + s * (d_[1][i] + r * (d_[2][i] + s * d_[3][i])));
            x[i] = from.x[i] + s * (change + r * (begin + s * (end + r * higher)));
        }
    }

private:
    /// Sums of a short state stay scalar: their terms have just been stored one by one, and vectors of them would wait for that.
    static constexpr bool is_short = has_fixed_size<State> && size_of<State>() <= 8;

    /// The weighted sum of a row of the table, entry i. From the first stage to the last, so that nothing waits for that but the last
    /// addition.
    template <std::size_t row>
    Scalar sum(std::size_t i) const {
        constexpr std::size_t first = Table::begin(row);
        return sum<first>(i, std::make_index_sequence<Table::begin(row + 1) - first>{});
    }
    template <std::size_t first, std::size_t... j>
    Scalar sum(std::size_t i, std::index_sequence<j...>) const {
        return (... + (numbers_.table.factors[first + j] * k_[Table::entries[first + j].stage - 1][i]));
    }

    template <std::size_t row>
    void make_stage(const Point<State>& from, const Candidate<State>& c) {
        const Scalar h = c.length;
        State x;
        if constexpr (is_short) {
            x = from.x;
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * sum<row>(i);
        } else {
            DALEMBERT_NO_ALIAS
            for (std::size_t i = 0; i < x.size(); ++i) x[i] = from.x[i] + h * sum<row>(i);
        }
        rhs_(x, k_[row - 1], row == 12 ? c.end : from.t + numbers_.table.times[row - 1] * h);
    }

    template <std::size_t... i>
    void make_stages(const Point<State>& from, const Candidate<State>& c, std::index_sequence<i...>) {
        (make_stage<i + 2>(from, c), ...);
    }

    void make_dense(const Point<State>& from, const Candidate<State>& c) {
        k_[12] = c.dydt;
        make_stage<14>(from, c);
        make_stage<15>(from, c);
        make_stage<16>(from, c);
        for (std::size_t i = 0; i < c.y.size(); ++i) {
            d_[0][i] = sum<Table::dense>(i);
            d_[1][i] = sum<Table::dense + 1>(i);
            d_[2][i] = sum<Table::dense + 2>(i);
            d_[3][i] = sum<Table::dense + 3>(i);
        }
        // A good step keeps its cubic, whatever lies on the way of these stages.
        if (!std::all_of(d_.begin(), d_.end(), [](const State& term) { return are_finite(term, term); }))
            for (State& term : d_) term.fill(Scalar(0));
        is_dense_ = true;
    }

    Rhs rhs_;
    Dop853Numbers<Scalar> numbers_;
    std::array<State, Table::stages> k_{};  ///< the derivatives of the stages
    std::array<State, Table::dense_terms> d_{};
    bool is_dense_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

#undef DALEMBERT_NO_ALIAS

// SPDX-License-Identifier: BSL-1.0
// Rodas5P, a Rosenbrock method for stiff problems: it solves linear systems with the Jacobian, and no others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/methods/rodas5p_coefficients.hpp"
#include "dalembert/status.hpp"
#include "dalembert/methods/stepper.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {

/// All entries are stored, column by column.
struct DensePattern {
    static constexpr bool is_sparse = false;
};

/// The derivatives of a right-hand side f(x, t): jacobian(x, t, values) writes df/dx in the order of the pattern, which is a
/// DensePattern or, as in generated headers, compressed columns; time_derivative(x, t, dfdt) writes df/dt at fixed x.
template <class State, class PatternOfJacobian, class Jacobian, class TimeDerivative>
class Derivatives {
    using Scalar = typename State::value_type;

public:
    using Pattern = PatternOfJacobian;
    using DifferentiatedState = State;
    static constexpr std::size_t states = detail::size_of<State>();

    Derivatives(Jacobian jacobian, TimeDerivative rate) : jacobian_(jacobian), rate_(rate) {}

    // What follows is what the method asks for, of this class or another. A state of the run may have more entries than `states`: those
    // behind are integrals, and the right-hand side does not depend on them.

    /// Computes the Jacobian at a point.
    void prepare(const State& x, Scalar t) { jacobian_(x, t, values_); }
    /// Calls add(row, column, value) for its entries; those of one place are added up.
    template <class Add>
    void for_each_entry(Add add) const {
        for (std::size_t column = 0; column < states; ++column)
            detail::for_each_in_column<Pattern>(values_, states, column, [&](std::size_t row, const Scalar& value) { add(row, column, value); });
    }
    /// df/dt at that point, for a step of this length.
    void time_derivative(const State& x, Scalar t, Scalar /*length*/, State& dfdt) const { rate_(x, t, dfdt); }

private:
    static constexpr std::size_t entries() {
        if constexpr (Pattern::is_sparse) return Pattern::row_indices.size();
        else return states * states;
    }
    Jacobian jacobian_;
    TimeDerivative rate_;
    std::array<Scalar, entries()> values_{};
};

template <class State, class Pattern = DensePattern, class Jacobian, class TimeDerivative>
Derivatives<State, Pattern, Jacobian, TimeDerivative> derivatives(Jacobian jacobian, TimeDerivative time_derivative) {
    return {jacobian, time_derivative};
}

namespace detail {

/// Hairer, Wanner: Solving Ordinary Differential Equations II, section IV.7 on implementation: with W = 1/(h gamma) - J the stages are
/// W u_i = f(t + time_i h, x + sum a_ij u_j) + sum c_ij/h u_j + gradient_i h df/dt, and y = (the last stage's state) + u_8, of which u_8
/// is the error.
template <class State, class Rhs, class Derivatives>
class Rodas5p final : public Stepper<State> {
    using Scalar = typename State::value_type;
    using Table = Rodas5pCoefficients;
    using Increment = typename Derivatives::DifferentiatedState;
    using Matrix = MatrixOf<Increment, typename Derivatives::Pattern>;
    static constexpr std::size_t integrals = EntriesMore<State, Increment>::value;

public:
    Rodas5p(Rhs rhs, Derivatives& derivatives) : rhs_(rhs), derivatives_(derivatives) {}

    static constexpr std::size_t n() noexcept { return size_of<Increment>(); }

    int order() const override { return 5; }

    void take(const Point<State>& from, Candidate<State>& c) override {
        c.has_derivative = false;
        c.finite = false;
        if (!factor(from, c.length)) return c.y.fill(std::numeric_limits<Scalar>::quiet_NaN());
        derivatives_.time_derivative(from.x, from.t, c.length, dfdt_);
        c.y = from.x;
        c.dydt = from.dxdt;
        make_stages(from, c, Scalar(1) / c.length, std::make_index_sequence<Table::stages>{});
        c.error.fill(Scalar(0));
        for (std::size_t r = 0; r < n(); ++r) {
            c.y[r] += u_.back()[r];
            c.error[r] = u_.back()[r];
        }
        if (!are_finite(c.y, c.error)) return;
        rhs_(c.y, c.dydt, c.end);
        if constexpr (integrals > 0) integrate_over(from, c);
        c.has_derivative = true;
        c.finite = are_finite(c.y, c.dydt);
    }

    /// The estimate of the error is that of the Jacobian at the start. Where that is much larger than at the end, as for a flow like a root
    /// that leaves balance, every increment is small, and so is the estimate. There the rate at the end does not fit the step, by more
    /// than the Jacobian at the end allows for.
    void check(const Point<State>& from, Candidate<State>& c) override {
        using std::abs;
        prepare(c.y, c.end);
        Increment diagonal{};
        derivatives_.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) {
            if (row == column) diagonal[row] = value;
        });
        const Scalar rate = Scalar(1) / c.length;
        for (std::size_t r = 0; r < n(); ++r) {
            Scalar slope = c.y[r] - from.x[r];
            for (std::size_t j = 0; j < Table::stages; ++j) slope -= Scalar(Table::dense[0][j] + Table::dense[1][j] + Table::dense[2][j]) * u_[j][r];
            const Scalar unfit = abs(c.dydt[r] - rate * slope) / (rate / Scalar(Table::gamma) + abs(diagonal[r]));
            if (unfit > Scalar(20) * abs(c.error[r])) c.error[r] = unfit / Scalar(20);
        }
    }

    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override {
        const Scalar s = (t - from.t) / c.length;
        interpolate(from, c, s, x);
        for (std::size_t i = n(); i < n() + integrals; ++i) x[i] = integral(from, c, s, i);
    }

private:
    /// Events repeat steps from one point, and the end of a step is the next start: the Jacobian is computed there once.
    void prepare(const State& x, const Scalar& t) {
        if (is_prepared_ && prepared_t_ == t && prepared_x_ == x) return;
        derivatives_.prepare(x, t);
        is_prepared_ = true;
        prepared_t_ = t;
        prepared_x_ = x;
    }

    bool factor(const Point<State>& from, Scalar length) {
        prepare(from.x, from.t);
        if (fill(length) && W_.factor()) return true;
        // A flow like a root at balance has an infinite slope: one a little further on serves, with short steps, or in very short ones none.
        State ahead = from.x;
        for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] += length * from.dxdt[i];
        prepare(ahead, from.t + length);
        (void)fill(length);
        return W_.factor();
    }

    /// W = 1/(length gamma) - J without infinite entries; false where there are such.
    bool fill(const Scalar& length) {
        using std::isinf;
        bool is_finite = true;
        W_.clear();
        derivatives_.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) {
            if (!isinf(value)) W_.add(row, column, -value);
            else is_finite = false;
        });
        const Scalar diagonal = Scalar(1) / (length * Scalar(Table::gamma));
        for (std::size_t i = 0; i < n(); ++i) W_.add(i, i, diagonal);
        return is_finite;
    }

    template <std::size_t... i>
    void make_stages(const Point<State>& from, Candidate<State>& c, const Scalar& rate, std::index_sequence<i...>) {
        (..., make_stage<i>(from, c, rate));
    }

    /// `rate` is 1/h. All of a row of the tables is known here, and sums need no memory between.
    template <std::size_t i>
    void make_stage(const Point<State>& from, Candidate<State>& c, const Scalar& rate) {
        constexpr auto before = std::make_index_sequence<i>{};
        if constexpr (i > 5) {
            for (std::size_t r = 0; r < n(); ++r) c.y[r] += u_[i - 1][r];
        } else if constexpr (i > 0) {
            for (std::size_t r = 0; r < n(); ++r) c.y[r] = from.x[r] + state_sum<i>(r, before);
        }
        if constexpr (i > 0) rhs_(c.y, c.dydt, Table::time[i] == 1 ? c.end : from.t + Scalar(Table::time[i]) * c.length);
        Increment& u = u_[i];
        std::copy_n(c.dydt.begin(), n(), u.begin());
        if constexpr (i > 0)
            for (std::size_t r = 0; r < n(); ++r) u[r] += rate * increment_sum<i>(r, before);
        if constexpr (Table::gradient[i] != 0) {
            const Scalar gradient = Scalar(Table::gradient[i]) * c.length;
            for (std::size_t r = 0; r < n(); ++r) u[r] += gradient * dfdt_[r];
        }
        W_.solve(u);
    }

    template <std::size_t i, std::size_t... j>
    Scalar state_sum(std::size_t r, std::index_sequence<j...>) const {
        return (... + (Scalar(Table::a[i][j]) * u_[j][r]));
    }
    template <std::size_t i, std::size_t... j>
    Scalar increment_sum(std::size_t r, std::index_sequence<j...>) const {
        return (... + (Scalar(Table::c[i][j]) * u_[j][r]));
    }

    /// The dense output, s from 0 to 1.
    void interpolate(const Point<State>& from, const Candidate<State>& c, Scalar s, State& x) const {
        for (std::size_t r = 0; r < n(); ++r) x[r] = from.x[r] + s * (c.y[r] - from.x[r]);
        for (std::size_t j = 0; j < Table::stages; ++j) {
            const Scalar d = Scalar(Table::dense[0][j]) + s * (Scalar(Table::dense[1][j]) + s * Scalar(Table::dense[2][j]));
            const Scalar factor = s * (Scalar(1) - s) * d;
            for (std::size_t r = 0; r < n(); ++r) x[r] += factor * u_[j][r];
        }
    }

    /// Integrals over the step: Lobatto's rule with four points, order 6, on the dense output, whose error h^5 becomes h^6. Their error is
    /// told by the difference from Simpson's rule: a rate may need shorter steps than the states, as a flow like a root does near balance.
    void integrate_over(const Point<State>& from, Candidate<State>& c) {
        using std::sqrt;
        const Scalar half_distance = Scalar(1) / (Scalar(2) * sqrt(Scalar(5)));
        State x = from.x;
        State rate;
        const auto rate_at = [&](const Scalar& s) {
            interpolate(from, c, s, x);
            rhs_(x, rate, from.t + s * c.length);
        };
        for (std::size_t k = 0; k < 2; ++k) {
            rate_at(Scalar(1) / Scalar(2) + (k == 0 ? -half_distance : half_distance));
            std::copy(rate.begin() + n(), rate.end(), rates_[k].begin());
        }
        rate_at(Scalar(1) / Scalar(2));
        for (std::size_t i = n(); i < n() + integrals; ++i) {
            c.y[i] = integral(from, c, Scalar(1), i);
            c.error[i] = from.x[i] + c.length / Scalar(6) * (from.dxdt[i] + Scalar(4) * rate[i] + c.dydt[i]) - c.y[i];
        }
    }

    /// Up to s: that of the cubic polynomial through the rates at Lobatto's points -1, -1/sqrt(5), 1/sqrt(5), 1 of z = 2 s - 1, whose
    /// even part is even[0] + even[1] z^2 and whose odd part is odd[0] z + odd[1] z^3.
    Scalar integral(const Point<State>& from, const Candidate<State>& c, Scalar s, std::size_t i) const {
        using std::sqrt;
        const Scalar two = Scalar(2);
        const Scalar inner_even = (rates_[1][i - n()] + rates_[0][i - n()]) / two;
        const Scalar inner_odd = (rates_[1][i - n()] - rates_[0][i - n()]) / two * sqrt(Scalar(5));
        const Scalar outer_even = (c.dydt[i] + from.dxdt[i]) / two;
        const Scalar outer_odd = (c.dydt[i] - from.dxdt[i]) / two;
        const Scalar even = Scalar(5) / Scalar(4) * (outer_even - inner_even);
        const Scalar odd = Scalar(5) / Scalar(4) * (outer_odd - inner_odd);
        const Scalar z = two * s - Scalar(1);
        const Scalar of_even = (z + Scalar(1)) * (outer_even - even) + (z * z * z + Scalar(1)) / Scalar(3) * even;
        const Scalar of_odd = (z * z - Scalar(1)) * ((outer_odd - odd) / two + (z * z + Scalar(1)) / Scalar(4) * odd);
        return from.x[i] + c.length / two * (of_even + of_odd);
    }

    Rhs rhs_;
    Derivatives& derivatives_;
    typename Matrix::type W_;
    std::array<Increment, Table::stages> u_{};
    Increment dfdt_{};
    std::array<std::array<Scalar, integrals>, 2> rates_{};  ///< at the inner points of Lobatto's rule
    bool is_prepared_ = false;
    State prepared_x_{};
    Scalar prepared_t_ = Scalar(0);
};

/// A matrix that is too large to be stored is refused.
template <class Run, class Derivatives>
Outcome run_rodas5p(Run& run, Derivatives& derivatives) {
    using State = typename Run::State;
    using Matrix = MatrixOf<typename Derivatives::DifferentiatedState, typename Derivatives::Pattern>;
    using Method = Rodas5p<State, typename Run::RightHandSide, Derivatives>;
    if constexpr (!has_fixed_size<State>) return Matrix::fits() ? run_with<Method>(run, Steps::dense, derivatives) : run.refuse();
    else if constexpr (Matrix::fits()) return run_with<Method>(run, Steps::dense, derivatives);
    else return run.refuse();
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

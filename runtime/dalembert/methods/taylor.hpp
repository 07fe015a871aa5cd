// SPDX-License-Identifier: BSL-1.0
// The method of Taylor series, with coefficients that the header of a system computes: one expansion a step, of the order that the
// tolerance asks for, and its polynomial is the dense output. Jorba, Zou: A software package for the numerical integration of ODEs by means
// of high-order Taylor methods, Experimental Mathematics 14 (2005), 99-117.
//
// note [trust]: The step follows from the last coefficients. These do not show what lies on the way: an input that jumps, a singular point.
// So the polynomial must also satisfy the equation where it ends: its derivative there and the right-hand side differ by about (p + 1)/h
// times the error of the step.
//
// note [short series]: Next to a singular point, as a flow that begins like a root, coefficients grow so fast that a lower order reaches
// further, or they are no numbers. Where an order below five would be best, a step of Dormand and Prince is made instead.
//
// note [behind events]: A guard has changed its sign there by rounding alone, and what the right-hand side compares may round the other
// way: the series would be that of the side where the run comes from. Other methods have one stage there, a series all of its coefficients.
// So it is one about a point a little further on, so little that the way there is straight to the last digit. A run that starts on a zero
// at rest has no such point: there the end of the step tells, also of one that an event cuts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "dalembert/methods/explicit_steppers.hpp"
#include "dalembert/integration_options.hpp"
#include "dalembert/methods/stepper.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// With steps of 1/e^2 of the radius of convergence, the cheapest ones where coefficients are all that costs, the error is as large as the
/// tolerance at the order 1 - ln(tolerance)/2. See also note [trust]: the right-hand side once a step, and the polynomial at output points,
/// make some four orders more the cheapest.
template <class Scalar>
std::size_t order_of_series(const Scalar& tolerance) {
    using std::ceil;
    using std::log;
    const Scalar least = std::numeric_limits<Scalar>::epsilon();
    const Scalar order = ceil(Scalar(5) - log(tolerance < least ? least : tolerance) / Scalar(2));
    return order < Scalar(8) ? 8 : static_cast<std::size_t>(order);
}

/// `series(t, order, x, work)` sets x[1] to x[order]; see SystemSeries.
template <class State, class Rhs, class Series>
class Taylor final : public Stepper<State> {
    using Scalar = typename State::value_type;

public:
    Taylor(Rhs rhs, const Series& series, const IntegrationOptions<State>& options)
        : rhs_(rhs), other_(rhs), series_(series), options_(options),
          most_(options.order > 0 ? options.order : order_of_series(options.tolerance)), x_(most_ + 1),
          work_(2 * Series::rows() * most_) {}

    int order() const override { return is_series_ ? static_cast<int>(order_) : other_.order(); }

    Scalar suggested(const Point<State>& from, Scalar h) override {
        expand(from);
        return is_series_ ? reach_ : h;
    }

    void take(const Point<State>& from, Candidate<State>& c) override {
        expand(from);
        if (!is_series_) return other_.take(from, c);
        using std::abs;
        using std::pow;
        c.y = at(c.length);
        const Scalar last = Scalar(pow(c.length, static_cast<int>(order_)));
        for (std::size_t i = 0; i < c.y.size(); ++i) c.error[i] = abs(x_[order_][i]) * last;
        c.has_derivative = false;
        c.finite = are_finite(c.y, c.error);
    }

    /// See note [trust].
    void check(const Point<State>&, Candidate<State>& c) override {
        if (!is_series_) return;
        using std::abs;
        using std::max;
        rhs_(c.y, c.dydt, c.end);
        c.has_derivative = true;
        c.finite = are_finite(c.dydt, c.dydt);
        State slope{};
        const Scalar s = c.length - ahead_;
        for (std::size_t m = order_; m > 0; --m)
            for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = slope[i] * s + Scalar(static_cast<double>(m)) * x_[m][i];
        const Scalar share = c.length / Scalar(static_cast<double>(order_ + 1));
        for (std::size_t i = 0; i < slope.size(); ++i) c.error[i] = max(c.error[i], Scalar(share * abs(slope[i] - c.dydt[i])));
    }

    void check_cut(const Point<State>& from, Candidate<State>& c) override {
        Candidate<State> judged = c;
        check(from, judged);
        if (judged.finite) c.error = judged.error;
    }

    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override {
        if (is_series_) x = at(t - from.t);
        else other_.between(from, c, t, x);
    }

private:
    /// The polynomial, so long behind the start of the step.
    State at(const Scalar& length) const {
        const Scalar s = length - ahead_;
        State y = x_[order_];
        for (std::size_t m = order_; m-- > 0;)
            for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] * s + x_[m][i];
        return y;
    }

    void expand(const Point<State>& from) {
        if (is_expanded_ && from.number == number_) return;
        is_expanded_ = true;
        number_ = from.number;
        if (wait_ > 0) {
            --wait_;
            is_series_ = false;
            return;
        }
        expand_about(from, Scalar(0));
        if (from.is_behind_event && is_series_) expand_about(from, next_to(from));
        patience_ = is_series_ ? 1 : std::min(2 * patience_, 16);
        wait_ = is_series_ ? 0 : patience_ - 1;
    }

    /// See note [behind events]. A series that ends reaches everywhere, but the state must stay what it is to all digits.
    Scalar next_to(const Point<State>& from) const {
        using std::abs;
        Scalar time = reach_;
        for (std::size_t i = 0; i < from.x.size(); ++i) {
            const Scalar size = scale_of(from, i), rate = abs(from.dxdt[i]);
            if (time * rate > size) time = size / rate;
        }
        return time < std::numeric_limits<Scalar>::max() ? Scalar(time / Scalar(10000000000.0)) : Scalar(0);
    }

    Scalar scale_of(const Point<State>& from, std::size_t i) const {
        using std::abs;
        using std::max;
        return max(options_.scale[i], Scalar(abs(from.x[i])));
    }

    void expand_about(const Point<State>& from, const Scalar& ahead) {
        ahead_ = ahead;
        for (std::size_t i = 0; i < from.x.size(); ++i) x_[0][i] = from.x[i] + ahead * from.dxdt[i];
        series_(from.t + ahead, most_, x_.data(), work_.data());
        order_ = most_;
        while (order_ > 0 && !are_finite(x_[order_], x_[order_])) order_ = first_broken();
        choose(from);
        is_series_ = order_ >= std::min<std::size_t>(most_, 5);
    }

    /// The highest order up to which all coefficients are numbers.
    std::size_t first_broken() const {
        std::size_t m = 0;
        while (m + 1 <= most_ && are_finite(x_[m + 1], x_[m + 1])) ++m;
        return m;
    }

    /// How far the series reaches, and the order that reaches furthest; see note [short series].
    void choose(const Point<State>& from) {
        using std::abs;
        using std::exp;
        using std::log;
        using std::max;
        State size;
        for (std::size_t i = 0; i < size.size(); ++i) size[i] = scale_of(from, i);
        // The logarithm of 1/|x_m|^(1/m), by which the radius of convergence is estimated.
        const auto radius = [&](std::size_t m) {
            Scalar largest = Scalar(0);
            for (std::size_t i = 0; i < size.size(); ++i) largest = max(largest, Scalar(abs(x_[m][i]) / size[i]));
            return largest > Scalar(0) ? Scalar(-log(largest) / Scalar(static_cast<double>(m))) : std::numeric_limits<Scalar>::infinity();
        };
        const Scalar tolerance = log(options_.tolerance);
        const auto reach = [&](std::size_t m) {
            using std::min;
            Scalar result = radius(m);
            if (m > 1) result = min(result, radius(m - 1));
            // Both zero: the next ones that are not.
            for (std::size_t j = m - 1; j-- > 1 && !(result < std::numeric_limits<Scalar>::infinity());) result = radius(j);
            return result + tolerance / Scalar(static_cast<double>(m));
        };
        if (order_ == 0) return;
        Scalar best = reach(order_);
        if (order_ > 3 && reach(order_ / 2) > best)
            for (std::size_t m = order_ - 1; m > 0; --m)
                if (const Scalar other = reach(m); other > best) best = other, order_ = m;
        reach_ = best < std::numeric_limits<Scalar>::infinity() ? Scalar(safety() * exp(best)) : std::numeric_limits<Scalar>::max();
    }

    static Scalar safety() { return Scalar(9) / Scalar(10); }

    Rhs rhs_;
    DormandPrince5<State, Rhs> other_;
    const Series& series_;
    const IntegrationOptions<State>& options_;
    std::size_t most_;
    std::vector<State> x_;      ///< normalised coefficients
    std::vector<Scalar> work_;
    std::size_t order_ = 0;     ///< that is used
    Scalar reach_ = Scalar(0);  ///< s
    Scalar ahead_ = Scalar(0);  ///< s, from the start of the step to the point of the expansion
    std::size_t number_ = 0;    ///< of the point of the expansion
    bool is_expanded_ = false, is_series_ = false;
    int wait_ = 0, patience_ = 1;  ///< points at which no expansion is tried
};

template <class Run, class Series>
Outcome run_taylor(Run& run, const Series& series) {
    return run_with<Taylor<typename Run::State, typename Run::RightHandSide, Series>>(run, Steps::dense, series, run.options());
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

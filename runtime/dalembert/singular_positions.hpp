// SPDX-License-Identifier: BSL-1.0
// Positions where constraints depend on each other, as a parallelogram with all bars in one line.
//
// note [singular positions]: The motion goes through such a position smoothly, but its equations cannot be solved there: at a distance d,
// forces of constraints lose the share 1/d of their digits, and velocities that are brought back to the constraints 1/d^2. So no step may
// end there.
// A run watches how independent the constraints are, sees the position come, and makes one long step of Gauss's collocation over it. Its
// stages lie some way off, are brought back to the constraints, and are solved for together, so that errors across the constraints do not
// spread.
//
// note [choice]: Of constraints that follow from each other wherever they hold a header solves for as many as are independent. Any choice
// of them has singular positions of its own, where the machine has none. So at the beginning of a step a run compares it with the best
// pivots that elimination finds there, and chooses anew where what the chosen rows span has become small beside those. Within a step the
// choice stays: on the constraints the motion is the same with each, and off them, by the error of a stage, it stays smooth.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

#include "dalembert/api.hpp"
#include "dalembert/constraints.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// How independent constraints are: 1 at their best, falling to 0 in proportion to the distance from a singular position.
template <class Scalar>
struct Independence {
    Scalar value = Scalar(1);
    std::size_t constraint = static_cast<std::size_t>(-1);  ///< that depends most on the others
    std::size_t rank = 0;
    bool is_chosen_anew = false;  ///< other constraints are to be solved for from now on
};

/// Whether a system solves for some of its constraints, as a run chooses them: note [choice].
template <class System, class = void>
inline constexpr bool chooses_constraints = false;
template <class System>
inline constexpr bool chooses_constraints<System, std::void_t<decltype(System::constraint_rank)>> = true;

/// The system of a run: the given one, or a copy where the run chooses what it solves for.
template <class System, bool = chooses_constraints<System>>
struct SystemOfRun {
    const System& system;
};
template <class System>
struct SystemOfRun<System, true> {
    System system;
};

/// Measures the independence: the smallest pivot of A D^-1 A', where D is the diagonal of M, each row beside its largest size so far.
/// Constraints that follow from others everywhere do not count. Chooses those that are solved for, where a system leaves that to the run.
template <class System>
class IndependenceOf {
    using Scalar = typename System::scalar_type;
    using Rows = typename System::Constraints;  // a number for each constraint
    using Flags = Like<Rows, bool>;

public:
    /// `learns`: the state is one of the motion.
    template <class... Mode>
    Independence<Scalar> operator()(const System& system, const typename System::State& x, Scalar t, bool learns, Mode... mode) {
        using std::max;
        using std::sqrt;
        if constexpr (!chooses_constraints<System>)
            if (learns) see_used(system, x, t, mode...);
        const std::vector<Scalar> rows = weighted_rows(system, x, t, mode...);
        const std::size_t m = size_of<Rows>(), n = size_of<typename System::Generalised>();
        std::vector<Scalar> gram(m * m);
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t k = 0; k <= i; ++k) {
                Scalar sum(0);
                for (std::size_t j = 0; j < n; ++j) sum += rows[i * n + j] * rows[k * n + j];
                gram[i * m + k] = gram[k * m + i] = sum;
            }
        Rows sizes = sizes_;
        for (std::size_t i = 0; i < m; ++i) sizes[i] = max(sizes[i], gram[i * m + i]);
        if (learns) sizes_ = sizes;
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t k = 0; k < m; ++k) {
                const bool is_there = sizes[i] > Scalar(0) && sizes[k] > Scalar(0);
                gram[i * m + k] = is_there ? Scalar(gram[i * m + k] / sqrt(sizes[i] * sizes[k])) : Scalar(0);
            }
        return smallest_pivot(std::move(gram), learns);
    }

    /// Those that are solved for.
    const Flags& chosen() const { return chosen_; }

private:
    /// Constraints that follow from others were left out of the equations: their residuals correct nothing. One that is dependent at the
    /// start alone does later.
    template <class... Mode>
    void see_used(const System& system, const typename System::State& x, Scalar t, Mode... mode) {
        if (looks_ == 20) return;
        ++looks_;
        for (std::size_t i = 0; i < is_used_.size(); ++i) {
            if (is_used_[i]) continue;
            typename System::Constraints residual{};
            typename System::Generalised step{};
            residual[i] = Scalar(1);
            system.correction(mode..., x, t, residual, step);
            for (const Scalar& entry : step) is_used_[i] = is_used_[i] || entry != Scalar(0);
        }
    }

    /// A D^(-1/2), row by row.
    template <class... Mode>
    std::vector<Scalar> weighted_rows(const System& system, const typename System::State& x, Scalar t, Mode... mode) const {
        using std::abs;
        using std::max;
        using std::sqrt;
        typename System::ConstraintJacobian A{};
        typename System::MassMatrix M{};
        system.constraint_jacobian(mode..., x, t, A);
        system.mass_matrix(x, t, M);
        const std::size_t m = size_of<Rows>(), n = size_of<typename System::Generalised>();
        Scalar heaviest(0);
        for (std::size_t j = 0; j < n; ++j) heaviest = max(heaviest, Scalar(abs(M[j * n + j])));
        std::vector<Scalar> rows(m * n);
        for (std::size_t j = 0; j < n; ++j) {
            const Scalar least = heaviest * std::numeric_limits<Scalar>::epsilon();
            const Scalar weight = Scalar(1) / sqrt(max(Scalar(abs(M[j * n + j])), least));
            for (std::size_t i = 0; i < m; ++i) rows[i * n + j] = is_used_[i] ? Scalar(A[j * m + i] * weight) : Scalar(0);
        }
        return rows;
    }

    struct Pivots {
        Rows values{};
        Like<Rows, std::size_t> order{};
        std::size_t rank = 0;
        /// Of the first ones: the square of what these rows span.
        Scalar product(std::size_t count) const {
            Scalar result(1);
            for (std::size_t i = 0; i < count; ++i) result *= values[i];
            return result;
        }
    };

    /// Elimination with the largest pivot first, of those rows that come first.
    static Pivots eliminate(std::vector<Scalar> g, const Flags& comes_first) {
        Pivots result;
        Flags is_done{};
        const std::size_t m = size_of<Rows>();
        for (std::size_t step = 0; step < m; ++step) {
            std::size_t p = m;
            for (std::size_t i = 0; i < m; ++i)
                if (!is_done[i] && (p == m || (comes_first[i] == comes_first[p] ? g[i * m + i] > g[p * m + p] : comes_first[i]))) p = i;
            const Scalar pivot = g[p * m + p];
            is_done[p] = true;
            result.order[step] = p;
            result.values[step] = pivot > Scalar(0) ? pivot : Scalar(0);
            if (pivot > Scalar(1e-10)) ++result.rank;
            if (!(pivot > Scalar(0))) continue;
            for (std::size_t i = 0; i < m; ++i) {
                if (is_done[i]) continue;
                const Scalar factor = g[i * m + p] / pivot;
                for (std::size_t k = 0; k < m; ++k)
                    if (!is_done[k]) g[i * m + k] -= factor * g[p * m + k];
            }
        }
        return result;
    }

    /// By elimination of as many as there have ever been, or as the system solves for.
    Independence<Scalar> smallest_pivot(std::vector<Scalar> g, bool learns) {
        using std::sqrt;
        Independence<Scalar> result;
        const Pivots best = eliminate(g, held_);
        if constexpr (chooses_constraints<System>) {
            rank_ = System::constraint_rank;
            if (learns) result.is_chosen_anew = choose(best, eliminate(std::move(g), chosen_));
        } else if (learns && best.rank > rank_) {
            rank_ = best.rank;
        }
        result.rank = rank_;
        if (rank_ == 0) return result;
        result.value = sqrt(best.values[rank_ - 1]);
        result.constraint = best.order[rank_ - 1];
        return result;
    }

    /// Whether the choice changes: what the chosen rows span has fallen to half of the best.
    bool choose(const Pivots& best, const Pivots& now) {
        if (!(now.product(rank_) < best.product(rank_) / Scalar(4))) return false;
        chosen_.fill(false);
        for (std::size_t i = 0; i < rank_; ++i) chosen_[best.order[i]] = true;
        return true;
    }

    static Flags at_start() {
        Flags result{};
        if constexpr (chooses_constraints<System>)
            for (std::size_t i = 0; i < result.size(); ++i) result[i] = System::solved_for_at_start[i];
        return result;
    }
    static Flags all(bool value) {
        Flags result{};
        result.fill(value);
        return result;
    }
    /// Those that are never left out.
    static Flags held() {
        Flags result{};
        if constexpr (chooses_constraints<System>)
            for (std::size_t i = 0; i < result.size(); ++i) result[i] = !System::can_be_left_out[i];
        return result;
    }

    Rows sizes_{};
    Flags is_used_ = all(chooses_constraints<System>);
    Flags chosen_ = at_start();
    Flags held_ = held();
    int looks_ = 0;
    std::size_t rank_ = 0;
};

/// Whether how independent constraints are is measured. Each mode has constraints of its own, and none is known as the usual one.
template <class System, class = void>
inline constexpr bool can_be_singular = false;
template <class System>
inline constexpr bool can_be_singular<System, std::void_t<typename System::Constraints>> = has_constraints<System> && !is_switching<System>;

template <class System, bool = can_be_singular<System>>
struct MeasureChoice {
    using type = NoMeasure;
};
template <class System>
struct MeasureChoice<System, true> {
    using type = IndependenceOf<System>;
};
template <class System>
using MeasureOf = typename MeasureChoice<System>::type;

/// Points and weights of Gauss's quadrature on [0, 1].
template <class Scalar>
struct GaussPoints {
    explicit GaussPoints(std::size_t count) : points(count), weights(count) {
        for (std::size_t i = 0; i < count; ++i) {
            const double turned = (static_cast<double>(count - i) - 0.25) / (static_cast<double>(count) + 0.5);
            Scalar x = Scalar(std::cos(3.14159265358979323846 * turned));
            Scalar slope(0);
            for (int k = 0; k < 8; ++k) {  // Newton's method on Legendre's polynomial
                Scalar before(1), value = x;
                for (std::size_t d = 2; d <= count; ++d) {
                    const Scalar order = Scalar(static_cast<double>(d));
                    const Scalar next = ((Scalar(2) * order - Scalar(1)) * x * value - (order - Scalar(1)) * before) / order;
                    before = value;
                    value = next;
                }
                slope = Scalar(static_cast<double>(count)) * (x * value - before) / (x * x - Scalar(1));
                x -= value / slope;
            }
            points[i] = (x + Scalar(1)) / Scalar(2);
            weights[i] = Scalar(1) / ((Scalar(1) - x * x) * slope * slope);
        }
    }
    std::vector<Scalar> points, weights;
};

/// x(s) = x(0) + h times the integral of the polynomial that has given slopes at some points, from 0 to s; s = 1 is a time h behind s = 0.
template <class State>
class SlopePolynomial {
    using Scalar = typename State::value_type;

public:
    SlopePolynomial(const State& x, Scalar h, std::vector<Scalar> points)
        : slopes(points.size()), x_(x), h_(h), points_(std::move(points)), quadrature_(points_.size()) {}

    std::size_t size() const { return points_.size(); }
    const Scalar& point(std::size_t i) const { return points_[i]; }

    State at(const Scalar& s) const {
        State x = x_;
        for (std::size_t j = 0; j < size(); ++j) add(x, h_ * weight(j, s), slopes[j]);
        return x;
    }
    State slope(const Scalar& s) const {
        State result{};
        for (std::size_t j = 0; j < size(); ++j) add(result, lagrange(j, s), slopes[j]);
        return result;
    }

    std::vector<State> slopes;

private:
    static void add(State& x, const Scalar& factor, const State& slope) {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * slope[i];
    }
    Scalar lagrange(std::size_t j, const Scalar& s) const {
        Scalar product(1);
        for (std::size_t k = 0; k < size(); ++k)
            if (k != j) product *= (s - points_[k]) / (points_[j] - points_[k]);
        return product;
    }
    Scalar weight(std::size_t j, const Scalar& s) const {
        Scalar sum(0);
        for (std::size_t k = 0; k < size(); ++k) sum += quadrature_.weights[k] * lagrange(j, s * quadrature_.points[k]);
        return s * sum;
    }

    State x_;
    Scalar h_;
    std::vector<Scalar> points_;
    GaussPoints<Scalar> quadrature_;
};

/// Solves for the slopes of a step of collocation from a guess, by iteration. slope(s, x, dxdt) is that of the state x, brought back to
/// what constraints hold; norm(x, y) is how far states are apart beside the tolerance, at the end after bring_back(x). False where the
/// iteration does not settle.
template <class State, class Slope, class Norm, class BringBack>
bool collocate(SlopePolynomial<State>& step, const Slope& slope, const Norm& norm, const BringBack& bring_back) {
    using Scalar = typename State::value_type;
    State before = step.at(Scalar(1));
    bring_back(before);
    Scalar last = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 40; ++k) {
        for (std::size_t i = 0; i < step.size(); ++i) {
            State dxdt;
            if (!slope(step.point(i), step.at(step.point(i)), dxdt)) return false;
            step.slopes[i] = dxdt;
        }
        State now = step.at(Scalar(1));
        if (!bring_back(now)) return false;
        const Scalar change = norm(before, now);
        if (change <= Scalar(1) / Scalar(100)) return true;
        if (!(change < std::numeric_limits<Scalar>::infinity()) || (k > 3 && !(change < last))) return change <= Scalar(1);
        before = now;
        last = change;
    }
    return false;
}

/// Where a function that falls and rises again is least between 0 and `end`, by golden sections.
template <class Scalar, class Function>
Scalar place_of_least(const Function& f, const Scalar& end) {
    const Scalar ratio = Scalar(0.6180339887498949);
    Scalar a(0), b = end, c = b - ratio * (b - a), d = a + ratio * (b - a), at_c = f(c), at_d = f(d);
    for (int k = 0; k < 20; ++k) {
        if (at_c < at_d) {
            b = d, d = c, at_d = at_c;
            c = b - ratio * (b - a), at_c = f(c);
        } else {
            a = c, c = d, at_c = at_d;
            d = a + ratio * (b - a), at_d = f(d);
        }
    }
    return at_c < at_d ? c : d;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

// SPDX-License-Identifier: BSL-1.0
// The method by default: explicit as long as accuracy decides how long a step may be, Rodas5P where stability would.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <variant>

#include "dalembert/methods/bulirsch_stoer.hpp"
#include "dalembert/methods/explicit_steppers.hpp"
#include "dalembert/methods/rosenbrock.hpp"
#include "dalembert/methods/symplectic.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// For right-hand sides without a Jacobian, and those whose Jacobian is too large to be factored.
struct HasNoJacobian {};
template <class State>
struct NoDerivativesOf : HasNoJacobian {
    using DifferentiatedState = State;
};
using NoDerivatives = NoDerivativesOf<std::array<double, 0>>;
template <class Derivatives>
inline constexpr bool can_be_implicit =
    !std::is_base_of_v<HasNoJacobian, Derivatives> && may_have_entries<typename Derivatives::DifferentiatedState>;

/// The magnitude of the largest eigenvalue of a Jacobian by the power method. Its vector stays from one call to the next, as the
/// Jacobian changes little in between.
template <class Vector>
class SpectralRadius {
    using Scalar = typename Vector::value_type;

public:
    /// `size` is the scale of each state. NaN if the Jacobian is not finite.
    template <class Derivatives, class Size>
    Scalar operator()(const Derivatives& jacobian, const Size& size) {
        using std::sqrt;
        Scalar growth = Scalar(0);
        // Of two complex conjugate eigenvalues the growth of one product swings about their magnitude; that of two does so less.
        for (int k = is_begun_ ? 4 : 16; k > 0; k -= 2) {
            if (!is_begun_) begin(size);
            const Scalar one = multiply(jacobian, size);
            const Scalar two = one == Scalar(0) ? one : multiply(jacobian, size);
            growth = sqrt(one * two);
            is_begun_ = growth > Scalar(0);  // false for NaN too: the next one begins anew
            if (!is_begun_) break;
        }
        return growth;
    }

private:
    template <class Size>
    void begin(const Size& size) {
        for (std::size_t i = 0; i < v_.size(); ++i)
            v_[i] = size[i] / Scalar(static_cast<double>(1 + i * 7 % 11)) * Scalar(i % 3 == 1 ? -1 : 1);
        normalise(v_, size);
        is_begun_ = true;
    }

    template <class Derivatives, class Size>
    Scalar multiply(const Derivatives& jacobian, const Size& size) {
        Vector product{};
        jacobian.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) { product[row] += value * v_[column]; });
        v_ = product;
        return normalise(v_, size);
    }

    template <class Size>
    static Scalar normalise(Vector& v, const Size& size) {
        using std::abs;
        Scalar norm = Scalar(0);
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Scalar entry = abs(v[i]) / size[i];
            if (!(entry <= norm)) norm = entry;
        }
        if (norm > Scalar(0))
            for (Scalar& entry : v) entry /= norm;
        return norm;
    }

    Vector v_{};
    bool is_begun_ = false;
};

/// Experience from one part of a run, for the next one.
template <class Scalar, class DifferentiatedState>
struct Choice {
    using State = DifferentiatedState;
    enum Kind : std::size_t { dopri5, dop853, rodas5p };
    Kind kind = dopri5;
    /// Long steps are wanted, whatever it is that keeps explicit ones short: Rodas5P is tried a decade before stability limits them.
    bool is_eager = false;
    bool is_smooth = true;             ///< in this part: dop853 has not had most of its steps rejected
    std::size_t patience = 2;          ///< number of times in succession that stability must limit the steps
    Scalar implicit_pace = Scalar(0);  ///< s for each step of an explicit method in the same time, when Rodas5P ran last
    std::array<std::size_t, 3> steps{};
    SpectralRadius<DifferentiatedState> radius;
};

template <class State, class Rhs, class Derivatives>
class Automatic final : public Stepper<State> {
    using Scalar = typename State::value_type;
    static constexpr bool has_implicit = can_be_implicit<Derivatives>;

public:
    using Memory = Choice<Scalar, typename Derivatives::DifferentiatedState>;

    Automatic(Rhs rhs, Derivatives& derivatives, const IntegrationOptions<State>& options, Memory& memory)
        : rhs_(rhs), options_(options), derivatives_(derivatives), memory_(memory) {
        // What was rejected before an event says little of what comes after it.
        memory_.is_smooth = true;
        take_up(memory_.kind == Memory::rodas5p ? memory_.kind : explicit_kind());
    }

    int order() const override { return now_->order(); }

    void take(const Point<State>& from, Candidate<State>& c) override {
        if (tried_ > 0 && from.number != number_) {
            ++memory_.steps[memory_.kind];
            ++accepted_;
            ++good_;
            longest_ = std::max(longest_, length_);
        }
        number_ = from.number;
        if (tried_ == window) reconsider(from);
        if (tried_ == 0) window_begin_ = from.t;
        if (stint_ == 0) stint_begin_ = from.t;
        ++tried_;
        ++stint_;
        length_ = c.length;
        now_->take(from, c);
    }

    /// Steps that only look for the time of an event are not judged.
    void check(const Point<State>& from, Candidate<State>& c) override {
        ++all_;
        now_->check(from, c);
    }

    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override { now_->between(from, c, t, x); }

private:
    static constexpr std::size_t window = 8, long_window = 32;

    void take_up(typename Memory::Kind kind) {
        memory_.kind = kind;
        stint_ = 0;
        if (kind == Memory::dopri5) now_ = &stepper_.template emplace<Dopri5>(rhs_);
        if (kind == Memory::dop853) now_ = &stepper_.template emplace<Dop853>(rhs_);
        if constexpr (has_implicit)
            if (kind == Memory::rodas5p) now_ = &stepper_.template emplace<Implicit>(rhs_, derivatives_);
    }

    /// From about 1e-6 on the higher order is worth its stages.
    typename Memory::Kind explicit_kind() const {
        return memory_.is_smooth && options_.tolerance * Scalar(1000000) <= Scalar(1) ? Memory::dop853 : Memory::dopri5;
    }

    /// h times the spectral radius up to which an explicit method is stable on the negative real axis, a little less.
    Scalar limit() const {
        const Scalar stable = explicit_kind() == Memory::dop853 ? Scalar(5) : Scalar(28) / Scalar(10);
        return memory_.is_eager ? stable / Scalar(10) : stable;
    }

    /// How many explicit steps cost as much as an implicit one: four, or more where linear systems are what takes the time. Entries of a
    /// Jacobian tell how long the right-hand side is: some eight operations each.
    static constexpr double explicit_steps_for_one() {
        if constexpr (has_implicit) {
            using Increment = typename Derivatives::DifferentiatedState;
            using Pattern = typename Derivatives::Pattern;
            constexpr double stages = 8, explicit_stages = 6, operations = 8;
            const double systems = MatrixOf<Increment, Pattern>::multiplications(stages) /
                                   (operations * static_cast<double>(entries_of<Pattern>(size_of<Increment>()) + 1));
            return std::max(4.0, (2 * stages + systems) / explicit_stages);
        } else {
            return 4;
        }
    }

    void reconsider(const Point<State>& from) {
        if (all_ >= long_window) {
            if (memory_.kind == Memory::dop853 && 2 * good_ < all_) {
                // Its long steps meet kinks.
                memory_.is_smooth = false;
                take_up(Memory::dopri5);
            }
            all_ = good_ = 0;
        }
        if constexpr (has_implicit) {
            if (accepted_ > 0) weigh(from);
        }
        tried_ = accepted_ = 0;
        longest_ = Scalar(0);
    }

    void weigh(const Point<State>& from) {
        using std::abs;
        using std::max;
        derivatives_.prepare(from.x, from.t);
        State size = options_.scale;
        for (std::size_t i = 0; i < size.size(); ++i) size[i] = max(size[i], Scalar(abs(from.x[i])));
        const Scalar reach = longest_ * memory_.radius(derivatives_, size);
        if (memory_.kind != Memory::rodas5p) {
            often_ = reach > limit() ? often_ + 1 : 0;
            const Scalar pace = (from.t - window_begin_) / Scalar(static_cast<double>(tried_));
            if (often_ < memory_.patience && !(often_ > 1 && Scalar(8) * pace < memory_.implicit_pace)) return;
            take_up(Memory::rodas5p);
            often_ = 0;
        } else {
            // Where an implicit step is not worth what it costs, it is not tried again so soon.
            often_ = reach > Scalar(explicit_steps_for_one()) * limit() ? 0 : often_ + 1;
            if (often_ < 2) return;
            if (reach > limit() || memory_.is_eager) memory_.patience = std::min<std::size_t>(4 * memory_.patience, 1000);
            memory_.implicit_pace = (from.t - stint_begin_) / Scalar(static_cast<double>(stint_) * explicit_steps_for_one());
            take_up(explicit_kind());
            often_ = 0;
        }
    }

    using Dopri5 = DormandPrince5<State, Rhs>;
    using Dop853 = DormandPrince853<State, Rhs>;
    using Implicit = std::conditional_t<has_implicit, Rodas5p<State, Rhs, Derivatives>, std::monostate>;

    Rhs rhs_;
    const IntegrationOptions<State>& options_;
    Derivatives& derivatives_;
    std::variant<std::monostate, Dopri5, Dop853, Implicit> stepper_;  ///< one at a time: states may be long
    Stepper<State>* now_ = nullptr;
    Memory& memory_;
    std::size_t number_ = 0;                                     ///< of the point that the last step was tried from
    std::size_t tried_ = 0, accepted_ = 0;                       ///< steps in the present window
    std::size_t all_ = 0, good_ = 0;                             ///< in the long one
    std::size_t often_ = 0;                                      ///< windows in succession that speak for another method
    Scalar length_ = Scalar(0), longest_ = Scalar(0);            ///< s, of steps
    std::size_t stint_ = 0;                                      ///< steps tried since the present method was taken up
    Scalar stint_begin_ = Scalar(0), window_begin_ = Scalar(0);  ///< s
};

/// Those with which a linear system can be solved: the given ones or none, where that is known when code is compiled.
template <class Derivatives, bool = can_be_implicit<Derivatives>>
struct ChosenDerivatives {
    using type = NoDerivatives;
};
template <class Derivatives>
struct ChosenDerivatives<Derivatives, true> {
    using State = typename Derivatives::DifferentiatedState;
    static constexpr bool may_fit() {
        if constexpr (has_fixed_size<State>)
            return MatrixOf<State, typename Derivatives::Pattern>::fits();
        else
            return true;
    }
    using type = std::conditional_t<may_fit(), Derivatives, NoDerivatives>;
};
/// What Method::automatic remembers in a run with these derivatives.
template <class Scalar, class Derivatives>
using ChoiceOf = Choice<Scalar, typename ChosenDerivatives<Derivatives>::type::DifferentiatedState>;

/// Whether Method::automatic may take Rodas5P.
template <class Derivatives>
bool may_become_implicit() {
    if constexpr (can_be_implicit<typename ChosenDerivatives<Derivatives>::type>) {
        using Increment = typename Derivatives::DifferentiatedState;
        return has_fixed_size<Increment> || MatrixOf<Increment, typename Derivatives::Pattern>::fits();
    } else {
        return false;
    }
}

template <class Run, class Derivatives, class Memory>
Outcome run_automatic(Run& run, Derivatives& derivatives, const IntegrationOptions<typename Run::State>& options, Memory& memory) {
    const auto before = memory.steps;
    Outcome outcome =
        run_with<Automatic<typename Run::State, typename Run::RightHandSide, Derivatives>>(run, Steps::dense, derivatives, options, memory);
    // Behind the last step there is no other that would show that it was taken.
    std::size_t seen = 0;
    for (std::size_t k = 0; k < before.size(); ++k) seen += memory.steps[k] - before[k];
    memory.steps[memory.kind] += outcome.steps - std::min(outcome.steps, seen);
    outcome.steps_by = memory.steps;
    return outcome;
}

/// What the method of the options says; `choice` is remembered from part to part of a run.
template <class Run, class Derivatives, class Choice>
Outcome run_by_method(Run& run, Derivatives& derivatives, const IntegrationOptions<typename Run::State>& options, Choice& choice) {
    if (options.method == Method::automatic && options.is_fixed) return run_explicit(run, Method::dopri5);
    if (options.method == Method::automatic) {
        if constexpr (can_be_implicit<typename ChosenDerivatives<Derivatives>::type>)
            if (may_become_implicit<Derivatives>()) return run_automatic(run, derivatives, options, choice);
        NoDerivativesOf<typename Choice::State> none;
        return run_automatic(run, none, options, choice);
    }
    if (options.method == Method::bulirsch_stoer)
        return run_with<BulirschStoer<typename Run::State, typename Run::RightHandSide>>(run, Steps::to_outputs, options.tolerance);
    using Coordinates = typename SeparableCoordinates<typename Run::GivenRhs>::type;
    if constexpr (may_have_entries<Coordinates>)
        if (options.method == Method::symplectic && size_of<Coordinates>() > 0)
            return run_with<Symplectic<typename Run::State, typename Run::RightHandSide, Coordinates>>(run, Steps::fixed);
    if constexpr (can_be_implicit<Derivatives>)
        if (options.method == Method::rodas5p) return run_rodas5p(run, derivatives);
    return run_explicit(run, options.method);
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

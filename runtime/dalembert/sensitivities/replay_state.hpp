// SPDX-License-Identifier: BSL-1.0
// A state and its sensitivities at one point of a run: the rates of both, what constraints hold of them, and how they jump.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/integrate.hpp"
#include "dalembert/sensitivities/differences.hpp"
#include "dalembert/sensitivities/known_kinks.hpp"
#include "dalembert/sensitivities/moded.hpp"
#include "dalembert/sensitivities/options.hpp"
#include "dalembert/sensitivities/projected_columns.hpp"
#include "dalembert/singular_positions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <class System, class Inputs, class List>
class ReplayState {
public:
    using Scalar = typename System::scalar_type;
    using Plain = typename System::State;
    using Asked = Moded<System>;
    template <class T>
    using ColumnsOf = typename Columns<List>::template Of<T>;
    using Mode = typename Asked::Mode;
    using Sensitivities = ColumnsOf<Plain>;
    using KinksOfInputs = KnownKinks<Scalar, ColumnsOf<Scalar>>;

    /// Refers to all of them but S. `options` are those of the run; with controls = false the steps follow the error of the state.
    ReplayState(const System& system, const Inputs& inputs, const List& varied, const Plain& x, const Sensitivities& S, Scalar from,
                Scalar to, const IntegrationOptions<Plain>& options, bool controls = true)
        : own_{system},
          system_(own_.system),
          inputs_(inputs),
          varied_(varied),
          moved_(own_.system, varied),
          scale_(options.scale),
          known_kinks_(options.kinks, to - from),
          x_(x),
          S_(S),
          t_(from),
          from_(from),
          span_(to - from),
          controls_(controls) {
        copy_options(options_, options);
        options_.kinks.clear();
        options_.intervals = 1;
    }

    /// Those of the options that move: see KnownKinks.
    template <class Kinks>
    void take_moving_kinks(const Kinks& kinks) {
        known_kinks_.take_moving(kinks);
    }

    const Sensitivities& S() const { return S_; }
    /// The state that comes with it.
    const Plain& x() const { return x_; }
    /// How the integration went; with Status::not_finite and a guard, that event or kink only touches zero, and S has no value behind it.
    const Outcome& outcome() const { return outcome_; }

    /// How inputs follow one that is varied, along the motion.
    typename System::Input slopes_of_inputs(std::size_t c) const {
        if (InputSlopes<Inputs, Scalar> known; known.take(inputs_, x_, t_))
            return known.template along<typename System::Input>(varied_[c], S_[c]);
        const int side = this->side(c, t_);
        return here().along(c, S_[c], Scalar(0),
                            [&](const System& a, const Plain& ahead, const Scalar& t, const System& b, const Plain& behind, const Scalar&,
                                const Scalar& step) {
                                auto slopes = side < 0 ? inputs_(x_, t) : inputs_with(inputs_, a)(ahead, t);
                                const auto other = side > 0 ? inputs_(x_, t) : inputs_with(inputs_, b)(behind, t);
                                for (std::size_t j = 0; j < slopes.size(); ++j)
                                    slopes[j] = (slopes[j] - other[j]) / (Scalar(side == 0 ? 2 : 1) * step);
                                return slopes;
                            });
    }

protected:
    /// See Variational.
    struct Sides {
        const ReplayState* replay;
        int operator()(std::size_t c, const Scalar& t) const { return replay->side(c, t); }
        bool mirror(Plain& x, const typename System::Input& u, const Scalar& t) const { return replay->mirror(x, u, t); }
    };
    using Motion = Variational<System, Inputs, List, typename Asked::View, Sides>;
    using All = typename Motion::State;
    using Kinks = typename Asked::Kinks;

    Scalar instant(const Scalar& t) const { return known_kinks_.instant(t); }
    Plain rate(Mode mode, const Plain& x, const Scalar& t) const {
        Plain dxdt;
        Asked::view(mode)(system_).rhs(x, inputs_(x, t), t, dxdt);
        return dxdt;
    }
    void fail(Status status, std::size_t guard = Outcome::none) {
        outcome_.status = status;
        outcome_.t = static_cast<double>(t_);
        outcome_.guard = guard;
    }

    Kinks kinks_at(Mode mode, const Plain& x, const Scalar& t) const {
        Kinks k;
        Asked::kinks(system_, mode, x, inputs_(x, t), t, k);
        return k;
    }
    /// Whether one of them changes its sign between two states.
    bool lies_between(const Plain& ahead, const Plain& behind, const typename System::Input& u, const Scalar& t) const {
        if constexpr (may_have_entries<Kinks>) {
            Kinks a, b;
            Asked::kinks(system_, mode_, ahead, u, t, a);
            Asked::kinks(system_, mode_, behind, u, t, b);
            for (std::size_t k = 0; k < a.size(); ++k)
                if ((a[k] < Scalar(0)) != (b[k] < Scalar(0))) return true;
        }
        return false;
    }
    /// Along the state that moves a kink most.
    bool mirror(Plain& x, const typename System::Input& u, const Scalar& t) const {
        using std::abs;
        bool is_moved = false;
        if constexpr (may_have_entries<Kinks>) {
            Kinks values;
            if (values.size() == 0) return false;
            Asked::kinks(system_, mode_, x, u, t, values);
            for (std::size_t k = 0; k < values.size(); ++k) {
                if (!Asked::is_kink(k) || sides_[k] == 0 || values[k] * Scalar(sides_[k]) > Scalar(0)) continue;
                Kinks ahead, behind;
                std::size_t along = 0;
                Scalar most = Scalar(0), slope = Scalar(0);
                for (std::size_t i = 0; i < x.size(); ++i) {
                    const Scalar h = step_of_differences<Scalar>() * std::max(Scalar(abs(x[i])), scale_[i]);
                    Plain there = x;
                    there[i] = x[i] + h;
                    Asked::kinks(system_, mode_, there, u, t, ahead);
                    there[i] = x[i] - h;
                    Asked::kinks(system_, mode_, there, u, t, behind);
                    const Scalar change = ahead[k] - behind[k];
                    if (!(abs(change) > most)) continue;
                    most = abs(change);
                    slope = change / (Scalar(2) * h);
                    along = i;
                }
                if (!(most > Scalar(0))) continue;  // it is one of time
                const Scalar roundings = Scalar(4) * std::numeric_limits<Scalar>::epsilon() * abs(x[along]);
                const Scalar way = (slope > Scalar(0) ? roundings : -roundings) * Scalar(sides_[k]) - Scalar(2) * values[k] / slope;
                if (!(abs(way) <= std::max(Scalar(abs(x[along])), scale_[along]) / Scalar(1000))) continue;  // straight so far?
                x[along] += way;
                is_moved = true;
            }
        }
        return is_moved;
    }
    int side(std::size_t c, const Scalar& t) const { return known_kinks_.side(c, t, moved_.distance[c]); }

    DifferencesAt<System, List> here() const { return {system_, varied_, moved_, scale_, x_, t_, span_, known_kinks_.free_time(t_)}; }

    /// Sizes of S for a part of the run that begins here.
    void set_scales() {
        const auto size = [&](std::size_t c) { return size_of_varied(system_, varied_[c], scale_); };
        set_scales_of_columns(options_.scale, scale_, x_, options_.tolerance, varied_.size(), size, controls_);
    }

    All together() const {
        All all;
        Motion::put(all, 0, x_);
        for (std::size_t c = 0; c < varied_.size(); ++c) Motion::put(all, c + 1, S_[c]);
        return all;
    }
    Motion motion_here() { return Motion(system_, inputs_, varied_, moved_, scale_, Asked::view(mode_), Sides{this}); }

    void take(const All& all, const Scalar& t) {
        x_ = Motion::part(all, 0);
        for (std::size_t c = 0; c < varied_.size(); ++c) S_[c] = Motion::part(all, c + 1);
        t_ = t;
    }

    void jump(const Plain& before, const Plain& behind, const ColumnsOf<Scalar>& shift) {
        for (std::size_t c = 0; c < varied_.size(); ++c)
            for (std::size_t i = 0; i < before.size(); ++i) S_[c][i] += (before[i] - behind[i]) * shift[c];
    }

    /// How the time follows what is varied at which a function that is zero here, and whose rate is given, is zero.
    template <class Value>
    ColumnsOf<Scalar> times_of_zero(const Value& value, const Scalar& slope, std::size_t number) {
        ColumnsOf<Scalar> shift = Columns<List>::filled(varied_, Scalar(0));
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            const auto central = [&](const System& a, const Plain& ahead, const Scalar& later, const System& b, const Plain& behind,
                                     const Scalar& earlier, const Scalar& step) {
                return Scalar((value(a, ahead, later) - value(b, behind, earlier)) / (Scalar(2) * step));
            };
            const Scalar by = of_order_four<Scalar>([&](const Scalar& times) { return here().along(c, S_[c], Scalar(0), central, times); });
            if (by == Scalar(0)) continue;
            shift[c] = -by / slope;
            if (!(shift[c] - shift[c] == Scalar(0))) fail(Status::not_finite, number);
        }
        return shift;
    }

    /// Rates of what constraints hold: see ProjectedRhs.
    template <class Rates>
    auto held(const Rates& rates) {
        if constexpr (needs_projection<System>) {
            const auto back = [this](All& all, Scalar t) {
                Plain x = Motion::part(all, 0);
                const std::size_t broken = in_mode([&](auto... mode) { return project(system_, x, t, mode...).broken; });
                Motion::put(all, 0, x);
                const DifferencesAt<System, List> at{system_, varied_, moved_, scale_, x, t, span_, known_kinks_.free_time(t)};
                const auto has_kink = [&](const Plain& ahead, const Plain& behind) {
                    return lies_between(ahead, behind, inputs_(x, t), t);
                };
                for (std::size_t c = 0; c < varied_.size(); ++c) {
                    Plain s = Motion::part(all, c + 1);
                    in_mode([&](auto... mode) { bring_back(system_, at, c, x, t, s, has_kink, mode...); });
                    Motion::put(all, c + 1, s);
                }
                return broken;
            };
            if constexpr (can_be_singular<System>) {
                const auto measure = [this](const All& all, Scalar t, bool learns) {
                    const auto independence =
                        in_mode([&](auto... mode) { return independence_(system_, Motion::part(all, 0), t, learns, mode...); });
                    if constexpr (chooses_constraints<System>)
                        if (independence.is_chosen_anew) solve_for(independence_.chosen());
                    return independence;
                };
                return ProjectedRhs{rates, back, measure, size_of<Plain>()};
            } else {
                return ProjectedRhs{rates, back};
            }
        } else {
            return rates;
        }
    }
    /// On the constraints S is the same with each choice of those that are solved for, as the motion is.
    template <class Flags>
    void solve_for(const Flags& chosen) {
        own_.system.solve_for(chosen);
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            moved_.ahead[c].solve_for(chosen);
            moved_.behind[c].solve_for(chosen);
        }
    }
    template <class Call>
    auto in_mode(const Call& call) const {
        if constexpr (is_switching<System>)
            return call(mode_);
        else
            return call();
    }

    SystemOfRun<System> own_;
    const System& system_;
    const Inputs& inputs_;
    const List& varied_;
    MeasureOf<System> independence_;
    MovedSystems<System, List> moved_;
    Plain scale_;
    KinksOfInputs known_kinks_;
    IntegrationOptions<All> options_;
    Plain x_;
    Sensitivities S_;
    Scalar t_, from_, span_;
    bool controls_;
    Mode mode_{};
    Like<Kinks, int> sides_{};  ///< the signs of kinks; 0 before they are known
    Outcome outcome_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

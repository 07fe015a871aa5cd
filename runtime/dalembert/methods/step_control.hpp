// SPDX-License-Identifier: BSL-1.0
// How long a step may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/integration_options.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Output points divide a run into equal parts, or are at given times.
template <class State>
struct OutputPoints {
    using Scalar = typename State::value_type;
    /// Refers to the options.
    OutputPoints(const IntegrationOptions<State>& options, Scalar begin, Scalar end)
        : from(begin),
          to(end),
          intervals(options.output_count()),
          times(options.output_times.empty() ? nullptr : options.output_times.data()) {}
    Scalar from, to;  ///< s
    std::size_t intervals;
    const Scalar* times;  ///< s; null: equal parts

    Scalar time(std::size_t i) const {
        if (times != nullptr && i > 0 && i < intervals) return times[i - 1];
        return i == intervals ? to : from + (to - from) * (Scalar(static_cast<double>(i)) / Scalar(static_cast<double>(intervals)));
    }
};

template <class State>
class StepControl {
    using Scalar = typename State::value_type;

public:
    StepControl(const IntegrationOptions<State>& options, Scalar from, Scalar to)
        : options_(options), from_(from), to_(to), outputs_(options, from, to) {}

    bool are_options_good() const {
        using std::isfinite;
        return to_ >= from_ && isfinite(from_) && isfinite(to_) && options_.intervals > 0 && are_output_times_good() &&
               options_.tolerance > Scalar(0) && options_.step >= Scalar(0) && options_.max_step >= Scalar(0) &&
               std::all_of(options_.scale.begin(), options_.scale.end(), [](const Scalar& scale) { return scale > Scalar(0); }) &&
               (!options_.has_fixed_steps() || options_.step > Scalar(0));
    }

    /// The last one is the end of the run, also where it is a part of a longer one that has `outputs`.
    Scalar output_time(std::size_t i) const { return i == options_.output_count() ? to_ : outputs_.time(i); }
    void set_outputs(const OutputPoints<State>& outputs) { outputs_ = outputs; }

    /// A step that changes nothing any more at t.
    Scalar smallest(Scalar t) const {
        using std::abs;
        using std::max;
        return Scalar(16) * std::numeric_limits<Scalar>::epsilon() * max(abs(t), abs(to_ - from_) * std::numeric_limits<Scalar>::epsilon());
    }
    /// One so short that it does no harm when its stages lie on both sides of a jump.
    Scalar tiny(Scalar t) const { return Scalar(64) * smallest(t); }
    /// The next time at which the right-hand side is known to have a kink, with room before and behind it; the end of the run where there
    /// is none. Behind a jump at the end of the run is only its end.
    struct Kink {
        Scalar before, behind;
    };
    Kink next_kink(Scalar t) const {
        const Kink known = next_known_kink(t);
        if (options_.clock == nullptr) return known;
        const Scalar instant = options_.clock->next();
        const Scalar room = smallest(instant);
        const bool is_ahead = instant - room > t && instant + room < to_;
        return is_ahead && instant - room < known.before ? Kink{instant - room, instant + room} : known;
    }
    /// Of those in the options.
    Kink next_known_kink(Scalar t) const {
        for (auto kink = std::upper_bound(options_.kinks.begin(), options_.kinks.end(), t); kink != options_.kinks.end(); ++kink) {
            const Scalar room = smallest(*kink);
            if (*kink - room > t && *kink - room < to_) return {*kink - room, std::min(Scalar(*kink + room), to_)};
        }
        return {to_, to_};
    }
    /// The least distance of two times near t.
    Scalar resolution(Scalar t) const {
        using std::abs;
        using std::max;
        const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
        return epsilon * max(Scalar(abs(t)), Scalar(epsilon * (to_ - from_)));
    }

    /// Largest error of a step from x to y relative to what is allowed; NaN counts as infinite.
    Scalar error_norm(const State& x, const State& y, const State& error) const {
        using std::abs;
        using std::max;
        Scalar largest = Scalar(0);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Scalar size = max(options_.scale[i], max(Scalar(abs(x[i])), Scalar(abs(y[i]))));
            const Scalar ratio = abs(error[i]) / (options_.tolerance * size);
            if (!(ratio <= largest)) largest = ratio;
            if (!(largest == largest)) return std::numeric_limits<Scalar>::infinity();
        }
        return largest;
    }

    /// The state with the largest error, measured in the same way.
    std::size_t worst(const State& x, const State& y, const State& error) const {
        using std::abs;
        using std::max;
        Scalar largest = Scalar(-1);
        std::size_t worst = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Scalar ratio = abs(error[i]) / max(options_.scale[i], max(Scalar(abs(x[i])), Scalar(abs(y[i]))));
            if (!(ratio > largest)) continue;
            largest = ratio;
            worst = i;
        }
        return worst;
    }

    /// Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.4: a first step from the sizes of x and dx/dt.
    Scalar first(const State& x, const State& dxdt, int order) const {
        using std::abs;
        using std::max;
        using std::min;
        using std::pow;
        if (options_.step > Scalar(0)) return min(options_.step, to_ - from_);
        Scalar d0 = Scalar(0);
        Scalar d1 = Scalar(0);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Scalar size = max(options_.scale[i], Scalar(abs(x[i])));
            d0 = max(d0, Scalar(abs(x[i]) / size));
            d1 = max(d1, Scalar(abs(dxdt[i]) / size));
        }
        const Scalar guess = d1 > Scalar(0) ? Scalar(max(d0, Scalar(1) / Scalar(100)) / d1) : to_ - from_;
        return min(Scalar(pow(options_.tolerance, Scalar(1) / Scalar(order + 1)) * guess), to_ - from_);
    }

    /// The factor for the next step after one with this error (Gustafsson's PI controller): 0.9 e^(-0.7/k) e_last^(0.4/k), by logarithms,
    /// which cost less than powers.
    Scalar factor(Scalar error, int order) {
        using std::exp;
        using std::log;
        using std::max;
        using std::min;
        const Scalar e = log(max(error, least_error()));
        const Scalar factor = Scalar(9) / Scalar(10) * exp((Scalar(4) * last_error_ - Scalar(7) * e) / Scalar(10 * order));
        last_error_ = e;
        return min(Scalar(5), max(Scalar(1) / Scalar(5), factor));
    }

    /// The factor for another try after an error that is too large.
    static Scalar factor_of_failure(Scalar error, int order) {
        using std::max;
        using std::pow;
        return max(Scalar(1) / Scalar(10), Scalar(9) / Scalar(10) * pow(error, -Scalar(1) / Scalar(order)));
    }

    void forget() { last_error_ = Scalar(0); }

private:
    bool are_output_times_good() const {
        const auto& times = options_.output_times;
        const auto falls = [](const Scalar& a, const Scalar& b) { return !(a < b); };
        return times.empty() ||
               (times.front() > from_ && times.back() < to_ && std::adjacent_find(times.begin(), times.end(), falls) == times.end());
    }

    static Scalar least_error() { return Scalar(1) / Scalar(10000); }

    const IntegrationOptions<State>& options_;
    Scalar from_, to_;
    OutputPoints<State> outputs_;
    Scalar last_error_ = Scalar(0);  ///< the logarithm of that of the step before
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

// SPDX-License-Identifier: BSL-1.0
// Times at which inputs have kinks or jumps, as sensitivities follow a run past them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "dalembert/sensitivities/varied.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// `Slopes` holds dt/d(varied) of a time for each that is varied.
template <class Scalar, class Slopes>
class KnownKinks {
public:
    /// A time that moves, in s.
    struct Moving {
        Scalar t;
        Slopes slope;
    };

    /// `times` rise; `span` is the length of the run. In s.
    KnownKinks(std::vector<Scalar> times, const Scalar& span) : times_(std::move(times)), span_(span) {}

    /// Those that move, rising. They must stay where they are until the run has ended.
    template <class Kinks>
    void take_moving(const Kinks& kinks) {
        begin_ = kinks.data();
        end_ = begin_ + kinks.size();
    }

    /// What passes for no time at all: an event may be passed an instant later.
    Scalar instant(const Scalar& t) const {
        using std::abs;
        return Scalar(4096) * std::numeric_limits<Scalar>::epsilon() * std::max(Scalar(abs(t)), Scalar(span_ / Scalar(1000)));
    }
    /// The next one whose instant is not over; null behind the last one.
    const Scalar* next(const Scalar& t) const {
        const auto found = first([&](const Scalar& k) { return k + instant(k) <= t; });
        return found != times_.end() ? &*found : nullptr;
    }
    bool is_at_one(const Scalar& t) const {
        const Scalar near = Scalar(2) * instant(t);
        const auto found = first([&](const Scalar& k) { return k < t - near; });
        return found != times_.end() && *found <= t + near;
    }
    /// The one here that moves, or null.
    const Moving* moving(const Scalar& t) const {
        using std::abs;
        const Moving* found = first_moving_from(t - instant(t));
        return found != end_ && abs(t - found->t) <= instant(t) ? found : nullptr;
    }
    /// Which of the systems whose parameter is moved by +-distance has the same inputs at t but for their slope. See Variational.
    int side(std::size_t c, const Scalar& t, const Scalar& distance) const {
        using std::abs;
        const Moving* behind = first_moving_from(t);
        for (const Moving* kink : {behind == begin_ ? end_ : behind - 1, behind}) {
            if (kink == end_) continue;
            const Scalar way = Scalar(2) * kink->slope[c] * distance;
            if (abs(t - kink->t) <= abs(way) && way != Scalar(0)) return (t < kink->t) == (way > Scalar(0)) ? 1 : -1;
        }
        return 0;
    }
    /// For steps of differences on both sides of t: inputs are smooth there, but perhaps at t. Shorter steps would leave too few digits.
    Scalar free_time(const Scalar& t) const {
        const Scalar shortest = Scalar(8) * step_of_differences<Scalar>() * span_ / Scalar(1000);
        const auto later = first([&](const Scalar& k) { return k < t + shortest; });
        const auto now = first([&](const Scalar& k) { return k < t - shortest; });
        Scalar free = span_;
        if (later != times_.end()) free = std::min(free, Scalar(*later - t));
        if (now != times_.begin()) free = std::min(free, Scalar(t - *(now - 1)));
        return std::max(shortest, Scalar(free / Scalar(2)));
    }

private:
    template <class IsBefore>
    auto first(const IsBefore& is_before) const {
        return std::partition_point(times_.begin(), times_.end(), is_before);
    }
    const Moving* first_moving_from(const Scalar& t) const {
        return std::partition_point(begin_, end_, [&](const Moving& kink) { return kink.t < t; });
    }

    std::vector<Scalar> times_;
    Scalar span_;
    const Moving* begin_ = nullptr;
    const Moving* end_ = nullptr;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

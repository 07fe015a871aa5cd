// SPDX-License-Identifier: BSL-1.0
// The search for the first zero of several functions in an interval.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A closing bracket around the first time at which one of several functions is negative; at `near` none is, at `far` one is.
/// ITP: Oliveira, Takahashi: An enhancement of the bisection method average performance preserving minmax optimality, ACM TOMS 47
/// (2020), article 5: regula falsi, drawn a little to the middle so that both ends move, and kept so close to the middle that a few
/// evaluations more than those of bisection are enough for whatever function.
template <class Values>
class Bracket {
    using Scalar = typename Values::value_type;

public:

    Bracket(Scalar near, const Values& at_near, Scalar far, const Values& at_far)
        : near_(near), far_(far), at_near_(at_near), at_far_(at_far), width_(far - near), reach_(Scalar(slack) * width_) {}

    Scalar near() const { return near_; }
    Scalar far() const { return far_; }
    Scalar middle() const { return near_ + (far_ - near_) / Scalar(2); }
    bool is_closed(Scalar resolution) const { return !(far_ - near_ > resolution) || !(middle() > near_ && middle() < far_); }

    void put_near(Scalar t, const Values& values) { near_ = t, at_near_ = values; }
    void put_far(Scalar t, const Values& values) { far_ = t, at_far_ = values; }

    /// The next time to look at, strictly between.
    Scalar next(Scalar resolution) {
        using std::abs;
        using std::max;
        const Scalar half = middle();
        const Scalar width = far_ - near_;
        reach_ /= Scalar(2);
        const Scalar zero = first_zero();
        const Scalar drawn = max(resolution, Scalar(width * (width / width_) / Scalar(100)));
        Scalar t = half;
        if (abs(half - zero) > drawn) t = zero < half ? zero + drawn : zero - drawn;  // not so when the zero is no number
        const Scalar radius = max(Scalar(0), Scalar(reach_ - width / Scalar(2)));
        if (abs(t - half) > radius) t = t < half ? half - radius : half + radius;
        return t > near_ && t < far_ ? t : half;
    }

private:
    static constexpr int slack = 8;  // three evaluations more than bisection at most

    /// By regula falsi: of each function that changes its sign, the first of all.
    Scalar first_zero() const {
        Scalar first = far_;
        for (std::size_t i = 0; i < at_far_.size(); ++i) {
            if (!(at_far_[i] <= Scalar(0) && at_near_[i] > at_far_[i])) continue;
            const Scalar zero = near_ + (far_ - near_) * (at_near_[i] / (at_near_[i] - at_far_[i]));
            if (!(zero >= first)) first = zero;
        }
        return first;
    }

    Scalar near_, far_;
    Values at_near_, at_far_;
    Scalar width_, reach_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

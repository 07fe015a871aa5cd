// SPDX-License-Identifier: BSL-1.0
// How many digits rates of sensitivities have.
//
// note [few digits]: The rate of S is a sum, J S + df/dp. Where a parameter hardly matters, as the volume at rest of a stiff chamber that
// is filled up to it, the terms cancel, and what rounding leaves of them may be more than the tolerance asks for: no step is so short that
// its error is small enough. What rounding leaves of a rate, over the time in which it adds up, is an error that no method can avoid; the
// scale of that entry of S must not be so small that it counts. It adds up over a step, or until the entry decays by itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Raises the entries of `scale` behind the first `states`, those of S, where the rates at (all, t) have too few digits. `longest`: a
/// step, in s.
template <class All, class Rates, class Motion>
void keep_to_digits(All& scale, const All& all, const typename All::value_type& t, std::size_t states, const Rates& rates, Motion& motion,
                    const typename All::value_type& longest, const typename All::value_type& tolerance) {
    using Scalar = typename All::value_type;
    using std::abs;
    using std::max;
    using std::min;
    All here, there, decay{};
    rates(all, t, here);
    All noise{};
    for (const std::size_t period : {1U, 2U}) {
        All moved = all;
        for (std::size_t i = 0; i < moved.size(); ++i)
            moved[i] += Scalar(i / period % 2 == 0 ? 2 : -2) * std::numeric_limits<Scalar>::epsilon() * moved[i];
        rates(moved, t, there);
        for (std::size_t i = states; i < all.size(); ++i) noise[i] = max(noise[i], Scalar(abs(there[i] - here[i])));
    }
    motion.prepare(all, t);
    motion.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) {
        if (row == column) decay[row] = max(Scalar(0), Scalar(-value));
    });
    for (std::size_t i = states; i < all.size(); ++i) {
        const Scalar time = longest * decay[i] > Scalar(1) ? Scalar(1) / decay[i] : longest;
        const Scalar least = Scalar(8) * noise[i] * time / tolerance;
        if (least > scale[i] && least < std::numeric_limits<Scalar>::max()) scale[i] = least;
    }
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

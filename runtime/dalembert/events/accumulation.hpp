// SPDX-License-Identifier: BSL-1.0
// Events that accumulate: a ball bounces infinitely often before it rests, at intervals that shrink like a geometric sequence.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Watches the times of one event. Where its intervals shrink by a steady ratio, the time at which they vanish is the sum of a geometric
/// series. It is used when what is left of that sum is less than the root of a rounding of the whole: then whatever makes the sequence
/// only nearly geometric does no harm, and the rounding of times not yet.
template <class Scalar>
class Accumulation {
public:
    /// The event happens at t; `again`: the last event was the same one. `instant` is the time that counts as none.
    void add(Scalar t, Scalar instant, bool again) {
        const Scalar interval = t - time(0);
        // Where a place has roundings, the last bounces are no shorter than these allow. Longer ones begin anew.
        if (count_ > 0 && interval > (t - origin_) / Scalar(10'000)) has_sum_ = false;
        stalls_ = again && count_ > 0 && interval <= instant ? stalls_ + 1 : 0;
        // Two of the same length, but for rounding, may belong to a ratio next to one.
        if (count_ > 1 && interval > time(0) - time(1) + instant) {
            begin_ = time(0);
            count_ = 1;
        }
        if (count_ == 0) begin_ = t;
        newest_ = (newest_ + 1) % kept;
        times_[newest_] = t;
        ++count_;
        if (is_steady() && remaining() <= (t - begin_) / Scalar(1000)) {
            if (!has_sum_) origin_ = begin_;
            has_sum_ = true;
            sum_ = t + remaining();
        }
    }

    /// The interval that begins now is too short to be seen.
    void stall() { stalls_ = enough_stalls; }

    void forget() {
        count_ = stalls_ = 0;
        has_sum_ = false;
    }

    /// Whether the end is near enough to be believed.
    bool is_certain() const {
        using std::sqrt;
        return is_stalled() || (is_steady() && remaining() <= sqrt(std::numeric_limits<Scalar>::epsilon()) * (time(0) - begin_));
    }

    /// Between the last two.
    Scalar interval() const { return time(0) - time(1); }
    /// Whether the last two are no further apart than `most`.
    bool is_repeated(Scalar longest) const { return count_ > 1 && interval() <= longest; }

    /// Whether it has happened between the last two times of the other one.
    bool is_between(const Accumulation& other) const { return count_ > 1 && other.count_ > 1 && time(0) >= other.time(1) && time(0) <= other.time(0); }

    /// Too close together to be told apart, or beyond the sum that they had while they shrank steadily.
    bool is_stalled() const { return stalls_ >= enough_stalls || (has_sum_ && !is_steady() && time(0) >= sum_); }

    /// The time at which the intervals vanish, in s.
    Scalar end() const { return is_steady() ? Scalar(time(0) + remaining()) : time(0); }

private:
    static constexpr std::size_t most = 8;  // intervals that are taken together
    static constexpr std::size_t enough_stalls = 3;
    static constexpr std::size_t kept = 3 * most + 1;

    Scalar time(std::size_t ago) const { return times_[(newest_ + kept - ago) % kept]; }

    /// The length of a block of intervals, of which `size` are taken together.
    Scalar block(std::size_t ago, std::size_t size) const { return time(ago * size) - time((ago + 1) * size); }

    /// How many intervals make a block that is at most half of the one before: with ratios next to one the sum would be known badly.
    std::size_t block_size() const {
        std::size_t size = 1;
        while (2 * size <= most && count_ > 6 * size && Scalar(2) * block(0, size) > block(1, size)) size *= 2;
        return size;
    }

    bool is_steady() const {
        using std::abs;
        if (count_ < 4) return false;
        const std::size_t size = block_size();
        const Scalar last = block(0, size);
        const Scalar before = block(1, size);
        const Scalar first = block(2, size);
        if (!(last > Scalar(0) && last < before && before < first)) return false;
        const Scalar ratio = last / before;
        return abs(ratio - before / first) <= std::min(ratio, Scalar(Scalar(1) - ratio)) / Scalar(8);
    }

    Scalar remaining() const {
        const std::size_t size = block_size();
        return block(0, size) * block(0, size) / (block(1, size) - block(0, size));
    }

    std::array<Scalar, kept> times_{};
    std::size_t newest_ = 0;
    std::size_t count_ = 0;   ///< events in a row whose intervals do not grow
    std::size_t stalls_ = 0;  ///< in a row
    Scalar begin_ = Scalar(0);
    bool has_sum_ = false;     ///< the end was near, and known
    Scalar sum_ = Scalar(0), origin_ = Scalar(0);  ///< where it was, and where the sequence began
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

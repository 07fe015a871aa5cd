// SPDX-License-Identifier: BSL-1.0
// What acts on a run at instants, as a controller that samples.
#pragma once

#include <cstddef>

namespace dalembert {
inline namespace v1 {

/// Steps of a run end on the instants of its clock: see IntegrationOptions::clock.
template <class State>
class Clock {
public:
    using Scalar = typename State::value_type;
    virtual ~Clock() = default;
    /// The first instant that is not over yet, in s; infinity if there is none.
    virtual Scalar next() const = 0;
    /// Does what is due up to `until`, which is t but for roundings. The run is at (x, t), in a mode of the machine by number. What it
    /// changes, such as inputs, acts from then on.
    virtual void act(const State& x, Scalar t, Scalar until, std::size_t mode) = 0;
};

/// When a controller takes samples, and when what it computed takes effect: at first + k*period, and `delay` later. Instants are products,
/// so that they do not drift.
class SampleClock {
public:
    /// In s; delay <= period.
    SampleClock(double period, double first = 0, double delay = 0) : period_(period), first_(first), delay_(delay) {}

    /// The next instant, in s.
    double next() const { return is_pending_ ? effect() : sample(); }
    /// Up to a time. A sample takes effect before the next one is taken.
    bool is_effect_due(double until) const { return is_pending_ && effect() <= until; }
    bool is_sample_due(double until) const { return !is_pending_ && sample() <= until; }
    void take_sample() {
        ++taken_;
        is_pending_ = true;
    }
    void take_effect() { is_pending_ = false; }

private:
    double sample() const { return first_ + static_cast<double>(taken_) * period_; }
    double effect() const { return first_ + static_cast<double>(taken_ - 1) * period_ + delay_; }

    double period_, first_, delay_;
    unsigned long long taken_ = 0;
    bool is_pending_ = false;  ///< the last sample has not taken effect yet
};

}  // namespace v1
}  // namespace dalembert

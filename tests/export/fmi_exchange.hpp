// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of an FMU: model exchange with a Runge-Kutta method, or for stiff models an extrapolated linearly implicit one, and events found by
// bisection; co-simulation in equal steps.
#pragma once

#include <cmath>

#include "fmi_unit.hpp"

namespace fmi_test {

struct ModeChange {
    double t;
    long from, to;
};

struct Trajectory {
    Vector t;
    std::vector<Vector> x;
    std::vector<ModeChange> changes;
    bool is_over = false;       ///< the model ended
    std::string failure;        ///< empty: none
    std::size_t steps = 0, events = 0;
    bool is_stiff = false;
};

struct RunWish {
    double until = 1;
    std::size_t intervals = 50;
    double tolerance = 1e-10;
    bool is_stiff = false;
};

/// From the end of initialization to the end of the run. The instance is in event mode.
Trajectory run_exchange(Instance& fmu, const Description& description, const RunWish& wish);
/// The same, by the other method if the first one takes too many steps; resets the instance in between. `prepare` sets it up.
template <class Prepare>
Trajectory run_exchange(Instance& fmu, const Description& description, RunWish wish, const Prepare& prepare) {
    prepare(fmu);
    Trajectory result = run_exchange(fmu, description, wish);
    if (result.failure != "too many steps" || wish.is_stiff) return result;
    fmu.reset();
    prepare(fmu);
    wish.is_stiff = true;
    return run_exchange(fmu, description, wish);
}
Trajectory run_steps(Instance& fmu, const Description& description, const RunWish& wish);

}  // namespace fmi_test

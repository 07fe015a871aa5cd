// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a system at one point, from the symbolic derivation.
#pragma once

#include "form/random_points.hpp"

namespace dalembert {

class MotionAt {
public:
    /// Solves for accelerations and rates. `digits` is what values are computed with. Throws Failure (division-by-zero, singular-mass).
    MotionAt(const System& system, const Values& values, int digits) : MotionAt(system, values.substitution(), digits) {}
    /// With numbers for parameters, definitions and everything that moves.
    MotionAt(const System& system, GiNaC::exmap values, int digits);

    /// Of an expression that may contain accelerations and rates. Throws Failure (division-by-zero).
    cln::cl_R operator()(const GiNaC::ex& e) const;

private:
    const System& system_;
    int digits_;
    GiNaC::exmap point_;
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// d'Alembert's principle in matrix form: M qdd + c = Q, from the Jacobians dr/dq and the remainder a* of the acceleration that
// does not contain qdd (article, section on multibody systems; (2.204)-(2.206)).
#pragma once

#include "mechanics/kinematics.hpp"

namespace dalembert {

struct InertialForces {
    GiNaC::matrix mass;             ///< M, symmetric
    std::vector<GiNaC::ex> coriolis;///< c(q, qd, t): everything inertial that does not contain qdd
    GiNaC::ex prescribed_power;     ///< of prescribed motion against inertia: sum m a.(dr/dt at fixed q); contains qdd
};

/// Bodies that move alike share their masses: of two bodies with the same dr/dq only the sum of the masses enters, so that
/// the masses behind a joint of a chain come out as one sum.
InertialForces dalembert(const std::vector<BodyMotion>& bodies, const Symbols& symbols);

/// M and c of plain kinetic terms, by the Christoffel symbols of their Hessian.
/// Throws Failure (not-quadratic).
InertialForces christoffel(const Scene& scene, const Translator& translate);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs that the inertial forces of d'Alembert's principle are those of Lagrange's equations, one body at a time.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// note [body by body]: Of a function w of coordinates and velocities let E_j(w) = d/dt(dw/dqd_j) - dw/dq_j, and of the coordinates of an
/// attitude what the turning of its axes adds to that, so that Lagrange's inertial forces are E_j(T). For the twist w of a body, with
/// a = dw/dqd_j,
///     E_j(w) = K(a, w),    K(a, w) = (a_w x w_w, a_w x w_v - w_w x a_v) in axes of the body, or nothing in those of the ground.
/// This goes from a base to what is placed on it, w = X w_base + S qd: for a coordinate that moves the base, by an identity for any a and
/// w of the base; for an own one by another. Neither contains anything of other bodies. With T = w'*I*w/2 and K(a, w)'*I*w = a'*p,
///     E_j(T) = a'*(I*dw/dt + p),
/// which is what the links of a chain stand for, and K(w, w) = 0 makes the power of these forces dT/dt.
/// Gravity pulls at a point c of a body with the power m*G*(w_v + w_w x c), G in the axes of the body. With the twist of the base, G in
/// its axes and the point at o + A c there it is the same: by identities for any G and c. What is left at the body that a coordinate
/// moves is the slope of where the point is. So the force is that of the energy -m*G*r.
/// Where M and forces are made of composite bodies, any rigid body is shown to do to the twist of a base, handed on, what it does to the
/// twist that follows from that: M is then the sum of a'*I*a over bodies, and inertial forces and gravity are the sums of theirs. With
/// w = X w_base + S qd the power of a moment and a force on a body is that of S'*f in its own coordinates and of f, handed on, at its base.
class BodyByBody {
public:
    BodyByBody(const System& system, Prover& prover);

    /// That the links stand for M and the inertial forces of d'Alembert, that their twists are those whose energies T is made of, and all
    /// of the above. False where that is not proven, and of a machine that is no chain.
    bool inertia_is_proven() const { return inertia_is_proven_; }
    /// That the force of gravity on a body is that of its energy.
    bool gravity_is_proven(std::size_t potential) const { return gravity_is_proven_[potential]; }
    /// That gravity of composite bodies is the sum of these forces.
    bool total_gravity_is_proven() const { return total_gravity_is_proven_; }
    /// Whether each wrench has the same power at its body as its generalised forces have.
    bool wrenches_are_proven() const { return wrenches_are_proven_; }

private:
    bool is_of_theorem(const Potential& gravity) const;
    const ChainLink& link_of(std::size_t body) const;
    bool stands_in_plane(std::size_t body) const;

    const System& system_;
    std::vector<bool> gravity_is_proven_;  ///< by potential
    bool inertia_is_proven_ = false, total_gravity_is_proven_ = false, wrenches_are_proven_ = false;
};

}  // namespace dalembert

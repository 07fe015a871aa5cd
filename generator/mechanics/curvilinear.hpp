// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates as lines in space, (2.12)-(2.27): what the position r(q, t) of a body says of them, for any position.
#pragma once

#include "mechanics/kinematics.hpp"
#include "symbolic/squares.hpp"

namespace dalembert {

/// Of the coordinates that enter the position of a body, one to three. Roots are those that the declared ranges of the coordinates allow:
/// sqrt(r^2*sin(theta)^2) is r*sin(theta) for theta in [0, pi].
class CurvilinearCoordinates {
public:
    /// Throws Failure (not-allowed-here) at `place`: no position, or one that moves with more than three coordinates or with a quaternion.
    CurvilinearCoordinates(const BodyMotion& body, const Translator& translate, const Span& place);

    /// Their places in q, in order of declaration.
    const std::vector<std::size_t>& lines() const { return lines_; }
    /// dr/dq_i, in m by unit of q_i: the vector along a line, (2.15). `i` and the like are places in q.
    const SpaceVector& tangent(std::size_t i) const { return tangents_[at(i)]; }
    /// g_ij = dr/dq_i . dr/dq_j, the matrix J'J of (2.16).
    GiNaC::ex metric(std::size_t i, std::size_t j) const { return metric_[at(i)][at(j)]; }
    /// h_i = |dr/dq_i|, (2.18); zero where a coordinate does not enter the position.
    GiNaC::ex scale_factor(std::size_t i) const;
    /// v.e_i in m/s, e_i = (dr/dq_i)/h_i, (2.19) and (2.21). Only where lines are at right angles: what is said of g_ij for i != j is not
    /// used.
    GiNaC::ex velocity_along(std::size_t i) const;
    /// a.e_i in m/s^2, (2.27) and Aufgabe 2.2, by Christoffel symbols. Where lines are at right angles, as above.
    GiNaC::ex acceleration_along(std::size_t i) const;
    /// [ij, k] = (dg_jk/dq_i + dg_ik/dq_j - dg_ij/dq_k)/2.
    GiNaC::ex christoffel_first(std::size_t k, std::size_t i, std::size_t j) const;
    /// Gamma^k_ij = g^kl [ij, l]: de_j/dq_i along dr/dq_k, where e_j = dr/dq_j. Not where the metric is singular.
    GiNaC::ex christoffel_second(std::size_t k, std::size_t i, std::size_t j) const;
    /// det g; zero where this is seen to vanish everywhere.
    GiNaC::ex determinant() const { return determinant_; }

private:
    std::size_t at(std::size_t coordinate) const;
    GiNaC::ex inverse(std::size_t a, std::size_t b) const;
    GiNaC::ex minor_of(std::size_t a, std::size_t b) const;
    /// What the motion of the place itself adds, along a line: of r(q, t) with t.
    GiNaC::ex drift(std::size_t a, const SpaceVector& v) const;

    const Symbols& symbols_;
    mutable Squares squares_;
    std::vector<std::size_t> lines_;
    std::vector<SpaceVector> tangents_;
    SpaceVector by_time_;
    std::vector<std::vector<GiNaC::ex>> metric_;
    GiNaC::ex determinant_;
};

}  // namespace dalembert

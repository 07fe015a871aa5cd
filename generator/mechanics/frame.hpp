// SPDX-License-Identifier: GPL-3.0-or-later
// Axes that turn in space. Vectors are given in the axes of the frame that they belong to, so that what a chain of bodies moves with is
// made from one body to the next, and never written out in the axes of the ground.
#pragma once

#include <memory>

#include "symbolic/translate.hpp"

namespace dalembert {

/// Rows; its columns are the axes of a frame in those of its base.
using SpaceMatrix = std::array<SpaceVector, 3>;

SpaceVector operator+(const SpaceVector& a, const SpaceVector& b);
SpaceVector operator-(const SpaceVector& a, const SpaceVector& b);
SpaceVector operator*(const GiNaC::ex& factor, const SpaceVector& v);
SpaceVector operator*(const SpaceMatrix& m, const SpaceVector& v);
SpaceVector cross(const SpaceVector& a, const SpaceVector& b);
SpaceMatrix transposed(const SpaceMatrix& m);
SpaceVector time_derivative(const SpaceVector& v, const Symbols& symbols);
bool is_zero(const SpaceVector& v);
/// Sums that stay letters in everything that is made of them: along a chain, products of sums of products would grow without end.
SpaceVector kept(const SpaceVector& v);

struct Frame {
    std::shared_ptr<const Frame> base;   ///< null: the ground
    SpaceMatrix axes;                    ///< in those of the base
    SpaceVector origin;                  ///< in the axes of the base
    SpaceVector angular_velocity;        ///< against the ground, in own axes
    SpaceVector velocity;                ///< of the origin against the ground, in own axes

    /// A vector, or a point, in the axes of the ground; and a vector from there.
    SpaceVector to_ground(SpaceVector v) const;
    SpaceVector point_to_ground(SpaceVector p) const;
    SpaceVector from_ground(const SpaceVector& v) const;
};

/// The orientation and the angular velocity in own axes of what turns about own axes one after the other, as with Euler or Cardan angles.
struct Orientation {
    SpaceMatrix axes;
    SpaceVector angular_velocity;
};
Orientation by_turns(const std::vector<std::pair<std::size_t, GiNaC::ex>>& turns, const Symbols& symbols);
/// By the quaternion of an attitude. The matrix is orthogonal where the quaternion has the norm one; its derivatives are right anywhere.
Orientation by_attitude(const Symbols::AttitudeSymbols& attitude, const Symbols& symbols);

/// A frame placed in another one, or in the ground.
std::shared_ptr<const Frame> placed(std::shared_ptr<const Frame> base, const Orientation& orientation, const SpaceVector& origin,
                                    const Symbols& symbols);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies at rest, as they were written: their masses by their shapes, the forces on them, and what friction can hold.
#pragma once

#include "elements/item.hpp"

namespace dalembert {

/// A shape with its mass spread in it, or several put together. Own axes: a box, cylinder or sphere has its origin in its middle; a cone,
/// frustum or hemisphere in the middle of its base; what is round about an axis is so about z, and stands towards +z.
struct Solid : Item {
    enum class Shape { box, cylinder, cone, sphere, hemisphere, point, composed };
    Shape shape = Shape::composed;
    std::optional<VectorExpression> size;   ///< m, of a box, along x, y, z
    ExpressionPtr radius, inner_radius, top_radius, height;  ///< m
    ExpressionPtr density;                  ///< kg/m^3, may depend on x, y, z in own axes
    ExpressionPtr mass;                     ///< kg, instead of the density
    std::optional<VectorExpression> at;     ///< m, of the origin of its axes
    std::vector<Turn> turns;
    std::vector<Reference> of, without;     ///< of what is put together: solids in its axes
};

/// A force at a point, or a moment.
struct LoadPart : Item {
    std::optional<VectorExpression> at;      ///< m
    std::optional<VectorExpression> force;   ///< N
    std::optional<VectorExpression> moment;  ///< N m
};

struct Unknown : Item {
    Unit unit;
};

/// Forces on one rigid body (2.28)-(2.44). With unknowns it is in equilibrium: balances of force and moment determine them.
struct Load : Item {
    std::optional<VectorExpression> about;  ///< m, the point of reference
    std::vector<LoadPart> parts;
    std::vector<Unknown> unknowns;
};

/// What friction at rest can hold: on a surface |tangential| <= coefficient*normal (2.96); of a rope around a cylinder (2.107).
struct Sticking : Item {
    ExpressionPtr normal;
    std::vector<ExpressionPtr> tangential;  ///< one, or two at right angles
    std::vector<ExpressionPtr> tensions;    ///< two, of a rope
    ExpressionPtr angle;                    ///< of a rope
    ExpressionPtr coefficient;
};

}  // namespace dalembert

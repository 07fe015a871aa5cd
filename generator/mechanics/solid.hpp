// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, centre of mass and tensor of inertia of solids, by integration over their own coordinates (2.51)-(2.58), (2.167)-(2.173).
#pragma once

#include <map>

#include "mechanics/frame.hpp"

namespace dalembert {

/// A primitive that was used, to be proven by differentiation.
struct Primitive {
    GiNaC::ex function, primitive, variable;
};

/// The integrals over a placed solid of density times 1, the place, and its products: (2.51), (2.56), (2.167).
struct SolidMoments {
    GiNaC::ex mass = 0;
    SpaceVector first = {0, 0, 0};
    SpaceMatrix second = {};  ///< integral of density*x_i*x_j
};

struct SolidProperties {
    GiNaC::ex mass = 0;                ///< kg
    SpaceVector centre = {0, 0, 0};    ///< m, in the axes that it is placed in
    SpaceMatrix about_centre = {};     ///< kg m^2, in the axes that it is placed in
    SpaceMatrix about_origin = {};     ///< kg m^2, the same about the origin
    // For proofs: what a direct integration over the placed solid gives, without Steiner's theorem, and its primitives.
    SolidMoments direct;
    std::vector<Primitive> primitives;
};

/// Mass times the squares of distances from axes through the origin, for a point mass at r: m*(r.r - r r').
SpaceMatrix inertia_of_point(const GiNaC::ex& mass, const SpaceVector& r);

/// In the axes that it is placed in, made of parameters and definitions. Throws Failure (cannot-integrate: a density that is no polynomial
/// in the place). What it is made of are solids too, found by `part`.
SolidProperties solid_properties(const Solid& solid, const Translator& translate,
                                 const std::function<const SolidProperties&(const Reference&)>& part);

/// The solids of a scene, each found when it is asked for first.
class Solids {
public:
    explicit Solids(const Translator& translate) : translate_(translate) {}
    const SolidProperties& of(const std::string& name) const;

private:
    const Translator& translate_;
    mutable std::map<std::string, SolidProperties> known_;
};

}  // namespace dalembert

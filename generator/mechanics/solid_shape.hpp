// SPDX-License-Identifier: GPL-3.0-or-later
// The coordinates that shapes are integrated over: x, y, z of a box, r, phi, z or r, theta, phi of what is round.
#pragma once

#include "mechanics/frame.hpp"

namespace dalembert {

/// One integral of several, with its limits, which may depend on the variables of those that are taken later.
struct ShapeIntegral {
    GiNaC::realsymbol variable;
    GiNaC::ex from, to;
};

/// A shape whose lengths are letters, so that what is integrated stays a polynomial in them.
struct SolidShape {
    SpaceVector place;                     ///< in own axes, by the variables
    GiNaC::ex volume_element;
    std::vector<ShapeIntegral> integrals;  ///< innermost first
    GiNaC::exmap lengths;                  ///< the letters, with what they stand for
};

/// Of everything but points and what is composed.
SolidShape shape_of(const Solid& solid, const Translator& translate);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// What a printed equation leaves to its reader and the catalogue knows: which members a sum has, the coordinates of \nabla, the constant of
// an integral without limits, and that a number with decimals is rounded.
#pragma once

#include "printed/catalogue.hpp"
#include "printed/latex_reader.hpp"

namespace dalembert {

/// Sums without limits become those over all members of the families that are declared with their index, and \nabla the derivatives by the
/// Cartesian coordinates of the catalogue. Throws Failure (not-allowed-here) where these are not known.
ExpressionPtr with_known_meaning(const ExpressionPtr& e, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model);

/// An equation with an integral without limits holds up to a constant: its sides become their derivatives by the letter that is integrated
/// over.
/// "= const." says of what moves in a model that its rate is zero. Throws Failure (not-allowed-here) where nothing could be said of the
/// derivatives.
void take_constants_out(LatexEquation& read, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model);

/// A side that is a number with decimals, but for zero, is marked as rounded; what it is compared with may still be exact.
void mark_rounded(Equation& equation);
bool is_rounded(const Expression& e);

}  // namespace dalembert

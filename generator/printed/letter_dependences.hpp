// SPDX-License-Identifier: GPL-3.0-or-later
// What the letters of an entry follow from, so that f(a) can be told from f(x).
#pragma once

#include "printed/catalogue.hpp"
#include "printed/notation.hpp"

namespace dalembert {

/// Tells the notation what each letter that the entry explains, or that is declared, depends on. Numbers and parameters of the model do not
/// vary.
void add_dependences(PrintedNotation& notation, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model);

}  // namespace dalembert

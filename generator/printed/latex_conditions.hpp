// SPDX-License-Identifier: GPL-3.0-or-later
// "for x > 0" behind a printed equation: what is checked must be no more than what is said.
#pragma once

#include "printed/catalogue.hpp"
#include "printed/latex_reader.hpp"

namespace dalembert {

/// Whether an equation is nothing but relations such as x > 0, which is a condition of those before it.
bool is_condition(const LatexEquation& read);

/// Refuses conditions that do not follow from what is declared of the letters: signs, ranges and values. Throws Failure (not-allowed-here).
void check_conditions(const LatexEquation& read, const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// What a wrong equation may have been meant to be.
#pragma once

#include "model/slips.hpp"
#include "prove/printed.hpp"

namespace dalembert {

struct Suggestion {
    std::string words;     ///< "'+' instead of '-' before 'b*x'"
    std::string equation;  ///< mended
    std::string printed = {};  ///< the same as the text writes it, with the slip marked; empty where it is not in LaTeX
};

/// The letters of a system that one may be taken for another, with their units: parameters, definitions, coordinates, states and inputs,
/// and the letters of the entry.
std::vector<KnownLetter> known_letters(const System& system, const PrintedEquation& entry);

/// Every single slip in the equations of an entry as they are written, and in which; by kind, then by place.
std::vector<std::pair<std::size_t, Slip>> slips_in(const System& system, const PrintedEquation& entry);

/// An entry with one of its equations, as they are written, replaced.
PrintedEquation with_equation(const PrintedEquation& entry, std::size_t which, const Equation& equation);

/// The smallest single slip that mends an entry: proven, not only equal at points. Nothing where none does.
std::optional<Suggestion> suggest(const System& system, const Member<PrintedEquation>& entry);

}  // namespace dalembert

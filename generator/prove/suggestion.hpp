// SPDX-License-Identifier: GPL-3.0-or-later
// What a wrong equation may have been meant to be.
#pragma once

#include "printed/latex_text.hpp"
#include "printed/slips.hpp"
#include "prove/printed.hpp"

namespace dalembert {

struct Suggestion {
    std::string words;         ///< "'+' instead of '-' before 'b*x'", in the letters of the text
    std::string equation;      ///< mended
    std::string printed = {};  ///< the same as the text writes it; empty where it is not in LaTeX, or has no such text
    std::size_t begin = 0;     ///< bytes [begin, end) of `shown` are what is different
    std::size_t end = 0;

    const std::string& shown() const { return printed.empty() ? equation : printed; }
};

/// The letters of a system that one may be taken for another, with their units: parameters, definitions, coordinates, states and inputs,
/// and the letters of the entry.
std::vector<KnownLetter> known_letters(const System& system, const PrintedEquation& entry);

/// Every single slip in the equations of an entry as they are written, and in which; as is_tried_before says, then by place.
std::vector<std::pair<std::size_t, Slip>> slips_in(const System& system, const PrintedEquation& entry, const SlipOptions& options = {});

/// An entry with one of its equations, as they are written, replaced.
PrintedEquation with_equation(const PrintedEquation& entry, std::size_t which, const Equation& equation);

/// The smallest single slip that mends an entry: proven, not only equal at points, but for signs where an integral has no primitive.
/// Nothing where none does. `text` says how an entry in LaTeX is printed.
std::optional<Suggestion> suggest(const System& system, const Member<PrintedEquation>& entry, const LatexText* text = nullptr);

/// Bytes [first, second) of a text that are not in the one before: at least a character, and whole commands of LaTeX.
std::pair<std::size_t, std::size_t> changed_part(std::string_view before, std::string_view after);

}  // namespace dalembert

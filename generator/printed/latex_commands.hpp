// SPDX-License-Identifier: GPL-3.0-or-later
// Commands of LaTeX by what the lexer does with them: drops them, reads them as another one, melts them into a bracket.
#pragma once

#include <map>
#include <set>
#include <string>

namespace dalembert::latex {

using Words = std::set<std::string, std::less<>>;
using Spellings = std::map<std::string, std::string, std::less<>>;

/// Nothing but their looks.
extern const Words without_meaning;
/// With an argument that says nothing either.
extern const Words with_idle_argument;
/// Of these, whose second argument counts: \stackrel{!}{=}.
extern const Words wraps_second_argument;
/// Between thousands and factors.
extern const Words thin_spaces;
/// Whose argument is a word or a unit.
extern const Words upright_commands;
/// Before a bracket.
extern const Words bracket_sizes;
/// Of several spellings of one thing that which the reader knows.
extern const Spellings one_spelling;
/// Characters beyond ASCII as commands.
extern const Spellings spelt_out;

}  // namespace dalembert::latex

// SPDX-License-Identifier: GPL-3.0-or-later
// Macros of authors, and the usual ones for derivatives, written out before an equation is read. Every character of the result stands where
// the macro was called, so that errors point there.
#pragma once

#include <map>
#include <optional>

#include "language/lexer.hpp"

namespace dalembert {

struct LatexMacro {
    std::size_t arguments = 0;
    std::optional<std::string> first = {};  ///< what the first argument is where no [..] stands behind the name
    std::string body;                       ///< with #1, #2, ...
};

/// By name, without the backslash.
using LatexMacros = std::map<std::string, LatexMacro, std::less<>>;

/// "\v" and what it stands for; it has as many arguments as #1, #2, ... occur. Throws Failure (syntax).
void define_macro(LatexMacros& macros, const Excerpt& name, const std::string& body);
/// Reads the lines \newcommand, \renewcommand, \providecommand, \def and \DeclareMathOperator of a text and nothing else of it.
void define_macros(LatexMacros& macros, const Excerpt& preamble);
/// The text with its macros written out and without such lines of its own. Throws Failure (syntax, too-long).
Excerpt without_macros(const Excerpt& text, const LatexMacros& macros);

}  // namespace dalembert

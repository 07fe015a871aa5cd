// SPDX-License-Identifier: GPL-3.0-or-later
// Words, numbers and signs of a formula, each with its place in the file.
#pragma once

#include <string>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/source.hpp"

namespace dalembert {

/// A text inside a source, character by character: the string of a TOML value with its escapes resolved.
struct Excerpt {
    SourcePtr source;
    std::string text;
    /// offsets[i] is where text[i] stands in the source; one more for the end.
    std::vector<std::size_t> offsets;

    Span span(std::size_t begin, std::size_t end) const { return {source, offsets[begin], offsets[end]}; }
    Span whole() const { return span(0, text.size()); }
};

/// A whole source as an excerpt, for arguments of the command line.
Excerpt excerpt_of(SourcePtr source);
/// Bytes [begin, end) of a source, taken as they are.
Excerpt excerpt_of(SourcePtr source, std::size_t begin, std::size_t end);

struct Token {
    enum class Kind { number, word, sign, end };
    Kind kind;
    std::string text;
    Span span;
};

/// Signs are + - * / ^ ( ) [ ] , = -> .. and single other characters, which no grammar takes.
/// Throws Failure (syntax, too-long).
std::vector<Token> tokenise(const Excerpt& excerpt);

}  // namespace dalembert

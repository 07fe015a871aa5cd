// SPDX-License-Identifier: GPL-3.0-or-later
// Words of LaTeX mathematics, each with its place. What only concerns the look (\displaystyle, \label, \phantom, comments) is dropped
// here, spelling variants become one word (\dfrac is \frac, \leq is \le), and sizes melt into their bracket (\left( is an opening "(").
#pragma once

#include <string>
#include <vector>

#include "language/lexer.hpp"

namespace dalembert {

struct LatexToken {
    enum class Kind {
        number,   ///< 0.55, 0,55, 0{,}55, 1\,000: text is as written
        letter,   ///< one Latin letter
        command,  ///< \alpha, \frac: text with its backslash
        upright,  ///< \mathrm{..}, \text{..}, \operatorname{..}: text is what stands inside
        begin,    ///< \begin{text}
        end_of,   ///< \end{text}
        sign,     ///< + ( [ { \{ \| | & \\ := and other single characters
        end,
    };
    enum class Space { none, blank, thin, quad };  ///< what stands before it: a blank of the text, \, or the like, \quad or \qquad
    enum class Side { neutral, left, right };      ///< of a bracket with a size: \left, \bigl or \right, \bigr

    Kind kind;
    std::string text;
    std::size_t begin = 0;  ///< in the excerpt
    std::size_t end = 0;
    Space space = Space::none;
    Side side = Side::neutral;
    std::size_t inside = 0;  ///< of an upright word: where its text begins in the excerpt

    bool is(std::string_view other) const { return (kind == Kind::sign || kind == Kind::command) && text == other; }
    bool is_letter(std::string_view other) const { return kind == Kind::letter && text == other; }
};

/// The words of bytes [from, to) of an excerpt, an end behind them. A comma or point before three digits may stand between thousands: it is
/// refused where `decimal_mark`, '.' or ',', does not say which one does. Throws Failure (syntax, too-long).
std::vector<LatexToken> latex_tokens(const Excerpt& excerpt, std::size_t from, std::size_t to, char decimal_mark = 0);

}  // namespace dalembert

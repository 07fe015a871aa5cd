// SPDX-License-Identifier: GPL-3.0-or-later
// What the letters of a printed equation mean in the model. Without an entry a letter is called as in note [names of letters].
#pragma once

#include <map>
#include <optional>
#include <set>

#include "language/expression.hpp"
#include "printed/latex_lexer.hpp"
#include "printed/latex_macros.hpp"

namespace dalembert {

/// What a name of the model language follows from.
struct LetterDependence {
    bool has_expression = false;             ///< or else nothing is known of it but its name
    bool moves = false;                      ///< alone, as a coordinate
    std::set<std::string, std::less<>> of;   ///< the letters that may vary, and "t" with all that moves
};

class PrintedNotation {
public:
    /// The letter (or word of letters) that stands in the excerpt means the expression. A later entry replaces an earlier one.
    /// Throws Failure (syntax) where the excerpt is not one letter.
    void define(const Excerpt& letter, ExpressionPtr meaning);
    void define(const std::string& letter, const std::string& meaning);
    /// The letter is a function of these names of the model: T(x, t) with the arguments {x, t} is T itself, T(0, t) is at(T, x, 0).
    /// Without arguments it is one of what its dependence says, and letters alone in its brackets are taken for these.
    void define_function(const Excerpt& function);  ///< "f", "f(x, t)"
    void define_function(const std::string& letter, std::vector<std::string> arguments);
    void define_dependence(std::string name, LetterDependence dependence) { dependences_[std::move(name)] = std::move(dependence); }
    /// A letter that counts: m_i is m[i] everywhere, not in \sum_i only.
    void add_index(std::string letter) { indices_.insert(std::move(letter)); }
    /// A name of the model. Where such a name is several Latin letters, they are read as one word and not as a product.
    void add_word(std::string word);
    /// Macros of the text: "\\v" with what it stands for, or the lines of a preamble that define some.
    void add_macro(const Excerpt& name, const std::string& body) { define_macro(macros_, name, body); }
    void add_macros(const Excerpt& preamble) { define_macros(macros_, preamble); }
    /// '.' or ',', the other one stands between thousands; 0 where the text does not say.
    void set_decimal_mark(char mark) { decimal_mark_ = mark; }
    /// Reads \\pm as - and \\mp as +.
    void take_lower_signs() { is_lower_sign_ = true; }

    /// By canonical spelling.
    const ExpressionPtr* find(std::string_view canonical) const;
    const std::vector<std::string>* find_function(std::string_view canonical) const;
    /// Nothing where it is not known what a name follows from.
    const LetterDependence* find_dependence(std::string_view name) const;
    bool is_index(std::string_view letter) const { return indices_.contains(letter); }
    /// Length of the longest word at the begin of a text of letters; 0 without one.
    std::size_t word_length(std::string_view letters) const;
    /// Whether letters with an index behind them are one name of several letters: PE_1.
    bool is_stem(std::string_view letters) const { return stems_.contains(letters); }
    const LatexMacros& macros() const { return macros_; }
    char decimal_mark() const { return decimal_mark_; }
    bool is_lower_sign() const { return is_lower_sign_; }

private:
    std::map<std::string, ExpressionPtr, std::less<>> letters_;
    std::map<std::string, std::vector<std::string>, std::less<>> functions_;
    std::map<std::string, LetterDependence, std::less<>> dependences_;
    std::set<std::string, std::less<>> indices_;
    std::set<std::string, std::less<>> words_, stems_;
    LatexMacros macros_;
    char decimal_mark_ = 0;
    bool is_lower_sign_ = false;
};

}  // namespace dalembert

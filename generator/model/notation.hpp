// SPDX-License-Identifier: GPL-3.0-or-later
// What the letters of a printed equation mean in the model. Without an entry a letter is called as in note [names of letters].
#pragma once

#include <map>
#include <optional>
#include <set>

#include "model/expression.hpp"
#include "model/latex_lexer.hpp"

namespace dalembert {

class PrintedNotation {
public:
    /// The letter (or word of letters) that stands in the excerpt means the expression. A later entry replaces an earlier one.
    /// Throws Failure (syntax) where the excerpt is not one letter.
    void define(const Excerpt& letter, ExpressionPtr meaning);
    void define(const std::string& letter, const std::string& meaning);
    /// The letter is a function of these names of the model: T(x, t) with the arguments {x, t} is T itself, T(0, t) is at(T, x, 0).
    /// Without arguments whatever stands in the brackets is left out.
    void define_function(const Excerpt& letter, std::vector<std::string> arguments);
    void define_function(const std::string& letter, std::vector<std::string> arguments);
    /// A letter that counts: m_i is m[i] everywhere, not in \sum_i only.
    void add_index(std::string letter) { indices_.insert(std::move(letter)); }
    /// A name of the model. Where such a name is several Latin letters, they are read as one word and not as a product.
    void add_word(std::string word);

    /// By canonical spelling.
    const ExpressionPtr* find(std::string_view canonical) const;
    const std::vector<std::string>* find_function(std::string_view canonical) const;
    bool is_index(std::string_view letter) const { return indices_.contains(letter); }
    /// Length of the longest word at the begin of a text of letters; 0 without one.
    std::size_t word_length(std::string_view letters) const;

private:
    std::map<std::string, ExpressionPtr, std::less<>> letters_;
    std::map<std::string, std::vector<std::string>, std::less<>> functions_;
    std::set<std::string, std::less<>> indices_;
    std::set<std::string, std::less<>> words_;
};

}  // namespace dalembert

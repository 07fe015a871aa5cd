// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/notation.hpp"

#include <algorithm>

#include "printed/latex_reader.hpp"
#include "language/parser.hpp"

namespace dalembert {

namespace {
Excerpt notation_text(const std::string& text) { return excerpt_of(std::make_shared<const Source>("notation", text)); }
}  // namespace

void PrintedNotation::add_word(std::string word) {
    const auto is_latin_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const bool is_latin = std::all_of(word.begin(), word.end(), is_latin_letter);
    if (const std::size_t index = word.find('_');
        index != std::string::npos && index > 1 &&
        std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(index), is_latin_letter))
        stems_.insert(word.substr(0, index));
    if (word.size() > 1 && is_latin) words_.insert(std::move(word));
}

void PrintedNotation::define(const Excerpt& letter, ExpressionPtr meaning) {
    add_word(letter.text);
    letters_[canonical_letter(letter, *this)] = std::move(meaning);
}

void PrintedNotation::define(const std::string& letter, const std::string& meaning) {
    define(notation_text(letter), parse_expression(notation_text(meaning)));
}

void PrintedNotation::define_function(const Excerpt& function) {
    add_word(function.text.substr(0, function.text.find('(')));
    auto [letter, arguments] = function_with_arguments(function, *this);
    functions_[std::move(letter)] = std::move(arguments);
}

void PrintedNotation::define_function(const std::string& letter, std::vector<std::string> arguments) {
    add_word(letter);
    functions_[canonical_letter(notation_text(letter), *this)] = std::move(arguments);
}

const ExpressionPtr* PrintedNotation::find(std::string_view canonical) const {
    const auto found = letters_.find(canonical);
    return found == letters_.end() ? nullptr : &found->second;
}

const std::vector<std::string>* PrintedNotation::find_function(std::string_view canonical) const {
    const auto found = functions_.find(canonical);
    return found == functions_.end() ? nullptr : &found->second;
}

const LetterDependence* PrintedNotation::find_dependence(std::string_view name) const {
    const auto found = dependences_.find(name);
    return found == dependences_.end() ? nullptr : &found->second;
}

std::size_t PrintedNotation::word_length(std::string_view letters) const {
    std::size_t longest = 0;
    for (const std::string& word : words_)
        if (letters.starts_with(word)) longest = std::max(longest, word.size());
    return longest;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/lexer.hpp"

#include <fmt/format.h>

#include <numeric>

#include "text/budgets.hpp"

namespace dalembert {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Length of the number at the begin of text. A point followed by a point belongs to a range "1..N".
std::size_t number_length(std::string_view text) {
    std::size_t i = 0;
    const auto digits = [&] { while (i < text.size() && is_digit(text[i])) ++i; };
    digits();
    if (i < text.size() && text[i] == '.' && !(i + 1 < text.size() && text[i + 1] == '.')) {
        ++i;
        digits();
    }
    if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t k = i + 1;
        if (k < text.size() && (text[k] == '+' || text[k] == '-')) ++k;
        if (k < text.size() && is_digit(text[k])) {
            i = k;
            digits();
        }
    }
    return i;
}

}  // namespace

Excerpt excerpt_of(SourcePtr source) {
    const std::size_t size = source->text().size();
    return excerpt_of(std::move(source), 0, size);
}

Excerpt excerpt_of(SourcePtr source, std::size_t begin, std::size_t end) {
    Excerpt excerpt{source, source->text().substr(begin, end - begin), std::vector<std::size_t>(end - begin + 1)};
    std::iota(excerpt.offsets.begin(), excerpt.offsets.end(), begin);
    return excerpt;
}

std::vector<Token> tokenise(const Excerpt& excerpt) {
    std::vector<Token> tokens;
    const std::string_view text = excerpt.text;
    for (std::size_t i = 0; i < text.size();) {
        if (is_blank(text[i])) {
            ++i;
            continue;
        }
        if (tokens.size() == budget::words)
            throw Failure(
                Diagnostic{Id::too_long, excerpt.span(i, i + 1),
                           fmt::format("the expression has more than {} words and signs; split it into definitions", budget::words)});
        const std::string_view rest = text.substr(i);
        std::size_t length = 1;
        Token::Kind kind = Token::Kind::sign;
        if (is_digit(rest[0]) || (rest[0] == '.' && rest.size() > 1 && is_digit(rest[1]))) {
            kind = Token::Kind::number;
            length = number_length(rest);
        } else if (is_letter(rest[0])) {
            kind = Token::Kind::word;
            while (length < rest.size() && (is_letter(rest[length]) || is_digit(rest[length]))) ++length;
        } else if (rest.starts_with("->") || rest.starts_with("..")) {
            length = 2;
        } else {
            while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xC0U) == 0x80U) ++length;
        }
        tokens.push_back({kind, std::string(rest.substr(0, length)), excerpt.span(i, i + length)});
        i += length;
    }
    tokens.push_back({Token::Kind::end, "", excerpt.span(text.size(), text.size())});
    return tokens;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/safe_text.hpp"

#include <vector>

namespace dalembert {

namespace {

/// U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069: they make a text look other than it is.
bool is_direction_mark(std::string_view text, std::size_t i) {
    if (i + 2 >= text.size() || text[i] != '\xE2') return false;
    const auto second = static_cast<unsigned char>(text[i + 1]);
    const auto third = static_cast<unsigned char>(text[i + 2]);
    if (second == 0x80) return third == 0x8E || third == 0x8F || third == 0xA8 || third == 0xA9 || (third >= 0xAA && third <= 0xAE);
    return second == 0x81 && third >= 0xA6 && third <= 0xA9;
}

}  // namespace

std::string safe_line(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (is_direction_mark(text, i)) {
            result += '?';
            i += 2;
        } else if (c < 0x20 || c == 0x7F) {
            result += ' ';
        } else {
            result += text[i];
        }
    }
    while (!result.empty() && (result.back() == ' ' || result.back() == '\\')) {
        // A backslash at the end would join the next line of C++ to a comment.
        result.pop_back();
    }
    if (result.ends_with("?\?/")) result.pop_back();  // the same as a trigraph
    return result;
}

std::string cpp_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : safe_line(text)) {
        if (c == '"' || c == '\\' || c == '?') result += '\\';
        result += c;
    }
    return result + "\"";
}

std::string cpp_comment(const std::string& text, std::size_t indent, const char* mark) {
    constexpr std::size_t width = 132;
    const std::string start = std::string(indent, ' ') + mark + " ";
    std::string result;
    std::string rest = safe_line(text);
    std::string lead = start;
    while (lead.size() + rest.size() > width) {
        const std::size_t room = width - lead.size();
        std::size_t cut = rest.rfind(' ', room);
        if (cut == std::string::npos || cut < room / 2) cut = rest.find(' ', room);
        if (cut == std::string::npos) break;
        result += lead + safe_line(rest.substr(0, cut)) + "\n";
        rest = rest.substr(cut + 1);
        lead = start + "    ";
    }
    return result + lead + rest + "\n";
}

}  // namespace dalembert

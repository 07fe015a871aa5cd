// SPDX-License-Identifier: GPL-3.0-or-later
// Text from a model, made harmless where it is put: it cannot end a comment, a string, or a line of a plot script.
#pragma once

#include <string>
#include <string_view>

namespace dalembert {

/// One line without control and direction-changing characters; does not end in a backslash.
std::string safe_line(std::string_view text);

/// A C++ string literal with its quotes.
std::string cpp_string(std::string_view text);

/// Comment lines "/// text", wrapped.
std::string cpp_comment(const std::string& text, std::size_t indent, const char* mark = "///");

}  // namespace dalembert

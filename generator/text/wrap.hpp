// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of generated code.
#pragma once

#include <string>
#include <vector>

namespace dalembert {

/// Breaks a long statement at its operators. It begins at the column.
std::string wrapped(const std::string& statement, std::size_t column);
/// Parts of a list with commas between them, in lines that begin at the column.
std::string wrapped_list(const std::vector<std::string>& parts, std::size_t column);
/// Every line by four blanks.
std::string shifted(const std::string& text);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of generated code.
#pragma once

#include <string>

namespace dalembert {

/// Breaks a long statement at its operators. It begins at the column.
std::string wrapped(const std::string& statement, std::size_t column);
/// Every line by four blanks.
std::string shifted(const std::string& text);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

struct CToken {
    enum class Kind { name, number, string, sign, placeholder, end };
    Kind kind;
    std::string text;
    std::string comment = {};  ///< that stands directly before
};

/// Lines of the preprocessor are left out, but for "#define NAME value", which begins with the sign "#define" and ends with ";".
std::vector<CToken> c_tokens(std::string_view text);

}  // namespace dalembert

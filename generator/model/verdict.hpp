// SPDX-License-Identifier: GPL-3.0-or-later
// What a check can say of an equation.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "model/model.hpp"

namespace dalembert {

inline constexpr std::array<const char*, 6> verdict_names{"proven",       "proven under assumption", "numerically equal",
                                                          "wrong",        "dimensionally wrong",     "not checkable"};

inline std::string to_string(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

inline std::optional<Verdict> read_verdict(std::string_view text) {
    for (std::size_t i = 0; i < verdict_names.size(); ++i)
        if (text == verdict_names[i]) return static_cast<Verdict>(i);
    return std::nullopt;
}

}  // namespace dalembert

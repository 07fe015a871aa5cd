// SPDX-License-Identifier: GPL-3.0-or-later
// What a check can say of an equation.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dalembert {

enum class Verdict { proven, proven_under_assumption, numerically_equal, wrong, dimensionally_wrong, not_checkable };

inline constexpr std::array<const char*, 6> verdict_names{"proven",       "proven under assumption", "numerically equal",
                                                          "wrong",        "dimensionally wrong",     "not checkable"};

inline std::string to_string(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

/// Of several verdicts on one thing the worst counts: what is shown wrong, then what could not be decided.
inline bool is_worse(Verdict a, Verdict b) {
    constexpr std::array<int, 6> badness{0, 1, 2, 4, 5, 3};
    return badness[static_cast<std::size_t>(a)] > badness[static_cast<std::size_t>(b)];
}

inline std::optional<Verdict> read_verdict(std::string_view text) {
    for (std::size_t i = 0; i < verdict_names.size(); ++i)
        if (text == verdict_names[i]) return static_cast<Verdict>(i);
    return std::nullopt;
}

}  // namespace dalembert

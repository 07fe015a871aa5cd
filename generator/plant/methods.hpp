// SPDX-License-Identifier: GPL-3.0-or-later
// Methods of integration as runs and the command line name them; the table is that of the runtime.
#pragma once

#include <dalembert/integration_options.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// Throws std::logic_error where there is none of that name.
inline const MethodSpec& method_named(std::string_view name) {
    const auto found = std::find_if(methods_of_integration.begin(), methods_of_integration.end(),
                                    [&](const MethodSpec& method) { return method.name == name; });
    if (found == methods_of_integration.end()) throw std::logic_error("no method of that name: " + std::string(name));
    return *found;
}

inline std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MethodSpec& method : methods_of_integration) names.emplace_back(method.name);
    return names;
}

inline bool needs_step(std::string_view name) { return method_named(name).needs_step; }

/// " (for tight tolerances)", " (fixed step)", or nothing.
inline std::string described(const MethodSpec& method) {
    const std::string what = method.what + std::string(method.needs_step ? (*method.what != '\0' ? "; fixed step" : "fixed step") : "");
    return what.empty() ? "" : " (" + what + ")";
}

/// "dopri5, dop853 (for tight tolerances), ..., rk4 (fixed step)"
inline std::string methods_text() {
    std::string text;
    for (const MethodSpec& method : methods_of_integration)
        text += (text.empty() ? "" : ", ") + std::string(method.name) + described(method);
    return text;
}

}  // namespace dalembert

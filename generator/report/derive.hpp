// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert derive`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "pipeline.hpp"

namespace dalembert {

/// The equations are the machine itself.
struct DeriveResult {
    Machine machine;
    /// Of all modes; of a machine that does not switch, its only one.
    std::vector<const System*> modes() const;
};

std::string as_text(const DeriveResult& result);
std::string as_latex(const DeriveResult& result);
nlohmann::ordered_json as_json(const DeriveResult& result);

}  // namespace dalembert

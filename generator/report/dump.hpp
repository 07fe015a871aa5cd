// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage hands to the next one, for `--dump`.
#pragma once

#include "pipeline.hpp"

namespace dalembert {

/// `stage` is scene, equations, atoms or code. After generate, which made the header.
std::string dumped(const Machine& machine, const std::string& stage, const Header& header);

}  // namespace dalembert

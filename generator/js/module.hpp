// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as a module of JavaScript that exports one function, which makes a plant.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

/// The whole file, with `banner` at its top.
std::string js_module(const Plant& plant, const std::string& name, const std::string& banner);

}  // namespace dalembert

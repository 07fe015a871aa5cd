// SPDX-License-Identifier: GPL-3.0-or-later
// A system that is nothing but letters: for equations that hold by themselves.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Parameters, and coordinates that move as they please: their accelerations are letters like any other.
std::unique_ptr<System> letters_alone(const Names& names, const Model& model);

}  // namespace dalembert

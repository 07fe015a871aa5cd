// SPDX-License-Identifier: GPL-3.0-or-later
// What `dalembert help units` says.
#pragma once

#include <string>

namespace dalembert {

std::string unit_reference();

}  // namespace dalembert

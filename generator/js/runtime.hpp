// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of plants in JavaScript: the integrators of runtime/export, translated, and what differs there, from runtime/js.
#pragma once

#include <string>

namespace dalembert {

/// Declares dalembert_record(), of a module, and all that it needs.
std::string javascript_runtime();

}  // namespace dalembert

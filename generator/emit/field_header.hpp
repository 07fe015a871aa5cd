// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a header that computes rods with many cells in loops, and joins them to the core, which computes all else.
#pragma once

#include "graph/field_code.hpp"

namespace dalembert {

std::string field_content(const FieldCode& code, const std::string& name_space);

}  // namespace dalembert

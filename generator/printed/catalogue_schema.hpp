// SPDX-License-Identifier: GPL-3.0-or-later
// The table of everything a catalogue may contain, as schema.hpp is of models.
#pragma once

#include "elements/schema.hpp"

namespace dalembert {

std::span<const SectionSpec> catalogue_sections();
const SectionSpec& catalogue_section(std::string_view name);

}  // namespace dalembert

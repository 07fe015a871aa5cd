// SPDX-License-Identifier: GPL-3.0-or-later
// From a model file to a Model: TOML, keys, types, syntax of every expression. Meaning is checked by checks.hpp.
#pragma once

#include <filesystem>

#include "elements/kinds.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Reads and checks a model file completely: syntax, names, units. Warnings are added to diagnostics.
/// Throws Failure with everything that is wrong.
Model read_model(const std::filesystem::path& path, Diagnostics& diagnostics);
Model read_model(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace dalembert

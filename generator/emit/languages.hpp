// SPDX-License-Identifier: GPL-3.0-or-later
// The languages that plants are printed in. To add one: a folder with its printer, and a row here.
#pragma once

#include <span>

#include "form/system.hpp"
#include "program/plant.hpp"

namespace dalembert {

struct Language {
    const char* name;    ///< on the command line
    const char* ending;  ///< of files
    const char* doc;
    /// What users write in front of its names: "cart_pendulum::linear".
    std::string (*name_space)(const Scene& scene);
    /// The whole file. `fields`: null where every state is code of its own. Throws Failure where the language cannot express something.
    std::string (*file)(const Plant& plant, const PlantFields* fields, const Scene& scene, const std::string& banner);
};

/// The first is taken where none is asked for.
std::span<const Language> languages();
/// Throws std::logic_error where there is none of that name.
const Language& language_named(const std::string& name);

}  // namespace dalembert

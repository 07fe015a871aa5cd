// SPDX-License-Identifier: GPL-3.0-or-later
// The generated header: tables and functions.
#pragma once

#include "emit/banner.hpp"
#include "emit/languages.hpp"
#include "graph/field_code.hpp"

namespace dalembert {

struct Header {
    std::string file_name;   ///< NAME_SCENE.hpp, or as the language ends
    std::string name_space;  ///< what stands before its names
    std::string text;
    Plant plant;             ///< as users see it: names, units, sizes, patterns of all states
};

/// The name of the header of a scene, without making it.
std::string header_name(const Scene& scene, const Language& language = languages().front());

/// `command` is what the banner shows: normalised, without paths.
/// `fields`: null where every state is code of its own. `modes`: the code of each mode, in the order of the scene; of a machine that does
/// not switch, its code alone.
Header make_header(const std::vector<const Code*>& modes, const FieldCode* fields, const Proofs& proofs,
                   const std::vector<EffectSize>& effects_out, const std::string& command, const Language& language = languages().front());

}  // namespace dalembert

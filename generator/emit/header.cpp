// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header.hpp"

#include "elements/runs.hpp"
#include "program/identifiers.hpp"
#include "program/field_plant.hpp"
#include "emit/header_equations.hpp"
#include "program/make_plant.hpp"

namespace dalembert {

std::string header_name(const Scene& scene, const Language& language) { return scene.sized_name() + "_" + scene.name + language.ending; }

Header make_header(const std::vector<const Code*>& modes, const FieldCode* fields, const Proofs& proofs,
                   const std::vector<EffectSize>& effects_out, const std::string& command, const Language& language) {
    const System& system = modes.front()->system;
    check_identifiers(system);
    const Scene& scene = system.scene;
    const std::optional<PlantFields> rods = fields != nullptr ? std::optional(make_fields(*fields)) : std::nullopt;
    Plant plant = make_plant(modes, header_equations(modes));
    std::string text = language.file(plant, rods ? &*rods : nullptr, scene, banner(modes, proofs, effects_out, command));
    return {header_name(scene, language), language.name_space(scene), std::move(text), rods ? whole_plant(plant, *rods) : std::move(plant)};
}

}  // namespace dalembert

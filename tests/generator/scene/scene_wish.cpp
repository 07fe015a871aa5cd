// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with one effect added or left out.
#include "generator/machine.hpp"
#include "scene/choose_effects.hpp"

using namespace dalembert;

namespace {

std::vector<std::string> effects(const std::string& name, const std::string& scene) {
    std::vector<std::string> result;
    const Machine machine = machine_of(name, scene);
    for (const Effect* effect : machine.system->scene.effects_in) result.push_back(effect->name);
    return result;
}

/// What is said of a scene that cannot be.
std::string refusal(const std::string& name, const std::string& scene) {
    try {
        machine_of(name, scene);
    } catch (const Failure& failure) {
        return failure.diagnostics().front().message;
    }
    return "";
}

}  // namespace

TEST_CASE("a scene is asked for with effects added or left out") {
    const SceneWish wish("full-drag+gust");
    CHECK(wish.base == "full");
    CHECK(wish.changes == std::vector<std::pair<std::string, bool>>{{"drag", false}, {"gust", true}});
    CHECK(wish.name() == "full_without_drag_with_gust");
    CHECK(SceneWish("full").name() == "full");

    CHECK(effects("mechanics/projectile", "atmosphere-air").empty());
    CHECK(effects("mechanics/projectile", "vacuum+air") == effects("mechanics/projectile", "atmosphere"));
    CHECK(effects("mechanics/projectile", "-air").empty());  // the default scene has it
    // What an effect implies comes with it.
    CHECK(effects("hydraulics/hydraulic_cylinder", "incompressible+leakage") == effects("hydraulics/hydraulic_cylinder", "leaking"));
}

TEST_CASE("scenes that cannot be asked for") {
    CHECK(refusal("mechanics/projectile", "atmosphere-wind") ==
          "model 'projectile' has no effect 'wind', which 'atmosphere-wind' should leave out; its effects are 'air' and 'ground'");
    CHECK(refusal("mechanics/projectile", "space-air") ==
          "model 'projectile' has no scene 'space'; its scenes are 'vacuum', 'atmosphere', 'flight_vacuum' and 'flight'");
    CHECK(refusal("mechanics/projectile", "atmosphere+air") == "scene 'atmosphere' already has 'air', so it cannot be added");
    CHECK(refusal("mechanics/projectile", "vacuum-air") == "scene 'vacuum' already lacks 'air', so it cannot be left out");
    CHECK(refusal("hydraulics/hydraulic_cylinder", "real-compressible") ==
          "scene 'real-compressible' leaves out 'compressible', which 'thermal' implies");
    CHECK(refusal("heat/block", "rows+columns") == "scene 'rows+columns' contains 'rows' and 'columns', two levels of 'bound'");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What effects that are left out would change at the start values, against the rates by hand.
#include "prove/effect_size.hpp"

#include "generator/machine.hpp"

using namespace dalembert;

namespace {

/// A mass that starts with 3 m/s on a spring, with a damper, a second store of energy, and two levels of drag.
const std::string text =
    "[parameters]\nm = { value = 2, unit = \"kg\" }\nc = { value = 8, unit = \"N/m\" }\nd = { value = 1, unit = \"N*s/m\" }\nk = { value = 0.5, unit = \"kg/m\" }\n"
    "[coordinates]\nq = { unit = \"m\", start = 1, start_rate = 3 }\nr = { unit = \"m\", when = \"rider\" }\n"
    "[bodies]\nb = { mass = \"m\", position = [\"q\", 0, 0] }\nrider = { mass = \"m\", position = [\"r\", 0, 0], when = \"rider\" }\n"
    "[springs]\ns = { stiffness = \"c\", elongation = \"q\" }\n"
    "[dampers]\nlinear = { coefficient = \"d\", rate = \"dot(q)\", when = \"linear\" }\nquadratic = { on = \"b\", force = \"v -> k*v^2\", when = \"quadratic\" }\n"
    "[effects]\nlinear = { doc = \"drag as the speed\", level_of = \"drag\" }\nquadratic = { doc = \"drag as its square\", level_of = \"drag\" }\nrider = { doc = \"a second body\" }\n"
    "[scenes]\nbare = []\nslow = [\"linear\"]\ndefault = \"DEFAULT\"\n";

std::map<std::string, std::string> sizes(const char* scene) {
    std::string model = text;
    model.replace(model.find("DEFAULT"), 7, scene);
    const Machine machine = machine_from(model);
    std::map<std::string, std::string> result;
    for (const EffectSize& size : sizes_of_effects_out(*machine.system, {})) result[size.effect->name] = size.at_start;
    return result;
}

}  // namespace

TEST_CASE("what effects that are left out would change at the start") {
    const auto bare = sizes("bare");  // ddot(q) = -8/2 = -4
    CHECK(bare.at("linear") == "changes ddot(q) by 27 %");     // -(8 + 3)/2 = -5.5
    CHECK(bare.at("quadratic") == "changes ddot(q) by 36 %");  // -(8 + 4.5)/2 = -6.25
    CHECK(bare.at("rider") == "adds 2 states");
    const auto slow = sizes("slow");
    CHECK(slow.size() == 2);
    CHECK(slow.at("quadratic") == "contradicts effects that are in");
}

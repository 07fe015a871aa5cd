// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.hpp"

#include "elements/every_kind.hpp"
#include "generator/machine.hpp"

using namespace dalembert;

namespace {

std::vector<std::string> names(const auto& members) {
    std::vector<std::string> result;
    for (const auto& member : members) result.push_back(member.name());
    return result;
}

using List = std::vector<std::string>;

const std::string with_effects = block +
                                 "[inputs]\n"
                                 "u = { unit = \"N\" }\n"
                                 "[dampers.friction]\n"
                                 "rate = \"dot(x)\"\n"
                                 "coefficient = \"d\"\n"
                                 "when = \"friction\"\n"
                                 "[forces.push]\n"
                                 "on = \"block\"\n"
                                 "force = [\"u\", 0, 0]\n"
                                 "when = \"not friction or driven\"\n"
                                 "[effects]\n"
                                 "friction = { doc = \"friction\" }\n"
                                 "driven = { doc = \"a force\" }\n"
                                 "hot = { doc = \"temperature\", implies = [\"friction\"] }\n"
                                 "[scenes]\n"
                                 "rough = [\"friction\"]\n"
                                 "both = [\"friction\", \"driven\"]\n"
                                 "implied = [\"hot\"]\n"
                                 "smooth = []\n";

}  // namespace

TEST_CASE("what a scene does not call for is gone with all that only it used") {
    const auto loaded = model_from(with_effects);
    const auto scene = [&](const char* name) { return select_scene(loaded->model, loaded->names, name, {}); };
    // c and l are read by nothing at all, and stay; d goes with its reader.
    CHECK(names(scene("rough").parameters) == List{"m", "c", "l", "d"});
    CHECK(names(scene("rough").inputs) == List{});
    CHECK(names(scene("rough").forces) == List{});
    CHECK(names(scene("both").parameters) == List{"m", "c", "l", "d"});
    CHECK(names(scene("both").inputs) == List{"u"});
    CHECK(names(scene("smooth").parameters) == List{"m", "c", "l"});
    CHECK(names(scene("smooth").inputs) == List{"u"});
    CHECK(names(scene("smooth").dampers) == List{});
    CHECK(names(scene("implied").dampers) == List{"friction"});
    CHECK(scene("implied").effects_in.size() == 2);
}

TEST_CASE("a header of a scene is the header of a model without what is left out") {
    // The left-out component, deleted as text, with the parameter that only it reads.
    std::string without = with_effects;
    const std::size_t begin = without.find("[dampers.friction]");
    without.erase(begin, without.find("[forces.push]") - begin);
    const std::size_t coefficient = without.find("d = {");
    without.erase(coefficient, without.find('\n', coefficient) + 1 - coefficient);
    Machine whole = machine_from(with_effects, "smooth");
    Machine less = machine_from(without, "smooth");
    CHECK(generate(whole).text == generate(less).text);
}

TEST_CASE("states that nothing uses stay") {
    const std::string capacitor =
        "[parameters]\nC = { value = 1e-6, unit = \"F\" }\n[inputs]\ni = { unit = \"A\" }\n[states.u_C]\nunit = \"V\"\nderivative = \"i/C\"\n";
    const auto without_outputs = model_from(capacitor);
    CHECK(names(select_scene(without_outputs->model, without_outputs->names, "full", {}).states) == List{"u_C"});
    const auto with_output = model_from(capacitor + "[outputs]\nu = \"u_C\"\n");
    CHECK(names(select_scene(with_output->model, with_output->names, "full", {}).states) == List{"u_C"});
    const auto other_output = model_from(capacitor + "[outputs]\ntwice = \"2*i\"\n");
    CHECK(names(select_scene(other_output->model, other_output->names, "full", {}).states) == List{"u_C"});
}

TEST_CASE("families are counted out") {
    const auto loaded = model_from("[sizes]\nN = 3\n[parameters]\nm = { for = \"k = 0..N\", value = \"k + 1\", unit = \"kg\" }\n"
                                   "[coordinates]\nx = { for = \"i = 1..N\", unit = \"m\" }\n"
                                   "[bodies.b]\nfor = \"i = 1..N\"\nmass = \"m[i] + sum(j, 0, i, m[j])\"\nposition = [\"x[i]\", 0, 0]\n");
    const Scene scene = select_scene(loaded->model, loaded->names, "full", {{"N", 2}});
    CHECK(names(scene.parameters) == List{"m[0]", "m[1]", "m[2]"});
    CHECK(names(scene.coordinates) == List{"x[1]", "x[2]"});
    CHECK(scene.sized_name() == "test_N2");
}

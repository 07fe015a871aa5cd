// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/derive.hpp"

#include <fmt/format.h>

#include "elements/parts.hpp"
#include "emit/equations.hpp"
#include "report/json_output.hpp"

namespace dalembert {

std::vector<const System*> DeriveResult::modes() const {
    std::vector<const System*> modes{machine.system.get()};
    for (const Machine& other : machine.other_modes) modes.push_back(other.system.get());
    return modes;
}

namespace {

std::string of_all_modes(const DeriveResult& result, std::string (*equations)(const System&)) {
    std::string text;
    for (const System* system : result.modes()) text += (text.empty() ? "" : "\n") + equations(*system);
    return text;
}

/// What became of the ports of parts.
std::string joins(const Model& model) {
    std::string text;
    for (const Use& use : model.uses)
        for (const std::string& join : use.joins) text += fmt::format("  {}\n", join);
    return text.empty() ? text : "\njoined ports\n" + text;
}

}  // namespace

std::string as_text(const DeriveResult& result) {
    return of_all_modes(result, equations_as_text) + joins(result.machine.loaded->model);
}
std::string as_latex(const DeriveResult& result) { return of_all_modes(result, equations_as_latex); }

nlohmann::ordered_json as_json(const DeriveResult& result) {
    nlohmann::ordered_json json = json_result("derive", subject_of(result.machine.system->scene));
    json.update(equations_as_json(*result.machine.system));
    for (const System* system : result.modes())
        if (system->scene.mode) json["modes"].push_back(mode_as_json(*system));
    return json;
}

}  // namespace dalembert

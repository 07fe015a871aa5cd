// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/rewritten.hpp"

#include <fmt/format.h>

namespace dalembert {

std::vector<RewrittenPlaces> rewritten_places(const Machine& machine) {
    std::vector<RewrittenPlaces> all;
    const auto add = [&](const Machine& one) {
        const Scene& scene = one.system->scene;
        for (const Rewriting& rewriting : one.code->rewritten) all.push_back({scene.mode ? scene.modes[*scene.mode].name : "", rewriting});
    };
    add(machine);
    for (const Machine& other : machine.other_modes) add(other);
    return all;
}

std::string rewritten_text(const std::vector<RewrittenPlaces>& all) {
    std::string text;
    for (const auto& [mode, r] : all)
        text += fmt::format("  rewritten   {}: {} in {} place{}{}, from {:.3g} to {:.3g} ulp beyond the condition\n", r.rule, r.where,
                            r.places, r.places == 1 ? "" : "s", mode.empty() ? "" : " of " + mode, r.before, r.after);
    return text;
}

}  // namespace dalembert

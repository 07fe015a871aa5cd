// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "elements/element.hpp"
#include "elements/expand_switching.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

void expand(Model& model, const Saturation& saturation) {
    if (!saturation.value || !saturation.low || !saturation.high) return;
    const auto is_its_value = [&](const Definition& d) { return d.is_made && d.name == saturation.name; };
    if (std::any_of(model.definitions.begin(), model.definitions.end(), is_its_value)) return;  // by edges
    Element made(model, saturation);
    made.modes({"within", "below", "above"});
    Definition limited = made.make<Definition>(saturation.name, saturation.when);
    const auto part = [&](const char* mode, const ExpressionPtr& value) { return times(made.name(made.part(mode)), value); };
    limited.value = plus(plus(part("below", saturation.low), part("within", saturation.value)), part("above", saturation.high));
    model.definitions.push_back(std::move(limited));
    made.event("leaves_below", "within", minus(saturation.value, saturation.low), {"below"});
    made.event("leaves_above", "within", minus(saturation.high, saturation.value), {"above"});
    made.event("returns_from_below", "below", minus(saturation.low, saturation.value), {"within", "above"});
    made.event("returns_from_above", "above", minus(saturation.value, saturation.high), {"within", "below"});
}

/// One phase after the other, each until a time.
void expand(Model& model, const Profile& profile) {
    if (profile.phases.empty()) return;
    Element made(model, profile);
    std::vector<std::string> names;
    for (const Phase& phase : profile.phases) {
        if (phase.name.empty() || !phase.value) return;  // reported where it was read
        names.push_back(phase.name);
    }
    made.modes(names, names.back());
    Definition value = made.make<Definition>(profile.name, profile.when);
    for (const Phase& phase : profile.phases) {
        const ExpressionPtr part = times(made.name(made.part(phase.name)), phase.value);
        value.value = value.value ? plus(value.value, part) : part;
    }
    model.definitions.push_back(std::move(value));
    for (std::size_t i = 0; i + 1 < profile.phases.size(); ++i) {
        const Phase& phase = profile.phases[i];
        if (phase.until)
            made.event("starts_" + names[i + 1], phase.name, minus(phase.until, made.name("t")), {names[i + 1]}).reset = phase.reset;
    }
}

}  // namespace

void expand_signals(Model& model) {
    for (const Saturation& saturation : model.saturations) expand(model, saturation);
    for (const Profile& profile : model.profiles) expand(model, profile);
}

}  // namespace dalembert

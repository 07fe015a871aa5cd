// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/fluids.hpp"
#include "read/rules.hpp"

namespace dalembert {

namespace {

void check_given(const Entry& e, const Medium& medium) {
    const auto needs_law = [&](const char* key, const std::optional<Property>& property) {
        if (property && property->variables.empty())
            e.error(Id::wrong_type, property->span,
                    fmt::format("the {} of medium '{}' must be a law of two variables, as in \"(p, T) -> ...\"", key, e.name()));
    };
    needs_law("density", medium.density);
    needs_law("energy", medium.energy);
    needs_law("pressure", medium.pressure);
    if (e.has("isochoric_heat") && !(e.has("reference_pressure") && e.has("reference_temperature")))
        e.error(
            Id::missing_key, e.span(),
            fmt::format("medium '{}' needs reference_pressure and reference_temperature, where its integrated energy is zero", e.name()));
}

}  // namespace

void check_rules(const Entry& e, Medium& medium) {
    if (!e.has("law")) return;
    if (medium.law == Medium::Law::given) return check_given(e, medium);
    for (const auto* property : {&medium.density, &medium.isochoric_heat})
        if (*property && !(*property)->variables.empty())
            e.error(Id::wrong_type, (*property)->span,
                    fmt::format("medium '{}' follows the law '{}', whose properties are expressions of parameters; a law of its own needs "
                                "law = \"given\"",
                                e.name(), e.text("law")));
}

void check_rules(const Entry& e, Volume&) {
    std::vector<std::string> chosen;
    for (const char* key : {"pressure", "density", "mass"})
        if (e.has(key)) chosen.emplace_back(key);
    if (e.has("filling")) {
        if (!e.has("pressure"))
            e.error(Id::missing_key, e.span(),
                    fmt::format("volume '{}' follows its filling and needs the pressure at its surface", e.name()));
        for (const char* key : {"density", "mass"})
            if (e.has(key))
                e.error(Id::doubly_determined, e.span_of(key),
                        fmt::format("volume '{}' has a filling and a {}; one of them follows from the other", e.name(), key),
                        {{e.span_of("filling"), "the filling stands here"}});
    } else {
        if (chosen.empty())
            e.error(Id::missing_key, e.span(), fmt::format("volume '{}' needs a state: pressure, density, mass, or filling", e.name()));
        if (chosen.size() > 1)
            e.error(Id::doubly_determined, e.span_of(chosen[1]),
                    fmt::format("volume '{}' has a {} and a {}; one of them follows from the other", e.name(), chosen[0], chosen[1]),
                    {{e.span_of(chosen[0]), fmt::format("the {} stands here", chosen[0])}});
    }
}

void check_rules(const Entry& e, Flow& flow) {
    const auto either = [&](bool first, bool second, const char* sentence) {
        if (first == second)
            e.error(first ? Id::doubly_determined : Id::missing_key, e.span(), fmt::format("flow '{}' {}", e.name(), sentence));
    };
    if (!e.has("law")) {
        either(e.has("mass_flow"), e.has("volume_flow"), "needs either a mass_flow, a volume_flow or a law");
        flow.law = e.has("mass_flow") ? Flow::Law::given_mass : Flow::Law::given_volume;
        return;
    }
    if (flow.law == Flow::Law::check_valve) {
        either(e.has("conductance"), e.has("area"), "is a check valve and needs either a conductance or an area with its coefficient");
        if (e.has("area") != e.has("coefficient"))
            e.error(Id::missing_key, e.span(), fmt::format("check valve '{}' needs area and coefficient together", e.name()));
        if (e.has("width") && !e.has("area"))
            e.error(Id::unknown_key, e.span_of("width"), fmt::format("check valve '{}' is laminar and does not take 'width'", e.name()));
    }
    if (flow.law == Flow::Law::pump) {
        either(e.has("volume_flow"), e.has("displacement"), "is a pump and needs either a volume_flow, or a displacement with its speed");
        if (e.has("displacement") != e.has("speed"))
            e.error(Id::missing_key, e.span(), fmt::format("pump '{}' needs displacement and speed together", e.name()));
    }
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_fluids.hpp"

#include <fmt/format.h>

#include "elements/describe_fluids.hpp"
#include "read/described.hpp"
#include "read/law_keys.hpp"

namespace dalembert {

namespace {

const std::vector<LawKeys<Medium::Law>>& medium_laws() {
    using L = Medium::Law;
    static const std::vector<LawKeys<L>> laws{
        {"ideal_gas", L::ideal_gas, {"gas_constant"}, {"isochoric_heat", "reference_temperature"}},
        {"liquid", L::liquid, {"density", "bulk_modulus", "reference_pressure"}, {"expansion", "reference_temperature", "isochoric_heat"}},
        {"incompressible", L::incompressible, {"density"}, {"reference_temperature", "isochoric_heat"}},
        {"given", L::given, {"density"}, {"isochoric_heat", "energy", "pressure", "reference_pressure", "reference_temperature"}},
    };
    return laws;
}

const std::vector<LawKeys<Flow::Law>>& flow_laws() {
    using L = Flow::Law;
    static const std::vector<LawKeys<L>> laws{
        {"hydraulic_orifice", L::hydraulic_orifice, {"area", "coefficient"}, {"width"}},
        {"pneumatic_orifice", L::pneumatic_orifice, {"area", "coefficient"}, {"width", "switches"}},
        {"laminar", L::laminar, {"conductance"}, {}},
        {"check_valve", L::check_valve, {}, {"conductance", "area", "coefficient", "width", "cracking_pressure", "switches"}},
        {"pump", L::pump, {}, {"volume_flow", "displacement", "speed"}},
        {"pipe", L::pipe, {"velocity", "area", "length"}, {"loss"}},
    };
    return laws;
}

void check_given(const Entry& e, const Medium& medium) {
    const auto needs_law = [&](const char* key, const std::optional<Property>& property) {
        if (property && property->variables.size() != 2)
            e.error(Id::wrong_type, property->span, fmt::format("the {} of medium '{}' must be a law of two variables, as in \"(p, T) -> ...\"", key, e.name()));
    };
    needs_law("density", medium.density);
    needs_law("energy", medium.energy);
    needs_law("pressure", medium.pressure);
    if (e.has("energy") && e.has("isochoric_heat"))
        e.error(Id::doubly_defined, e.span_of("isochoric_heat"), fmt::format("medium '{}' has an energy and an isochoric_heat; the heat follows from the energy", e.name()),
                {{e.span_of("energy"), "the energy stands here"}});
    if (e.has("isochoric_heat") && !(e.has("reference_pressure") && e.has("reference_temperature")))
        e.error(Id::missing_key, e.span(), fmt::format("medium '{}' needs reference_pressure and reference_temperature, where its integrated energy is zero", e.name()));
}

}  // namespace

void read(const Entry& e, Medium& medium) {
    read_described(e, medium);
    const auto* law = find_law(e, "medium", medium_laws(),
                               {"gas_constant", "density", "bulk_modulus", "expansion", "isochoric_heat", "energy", "pressure", "reference_pressure", "reference_temperature"});
    if (law == nullptr) return;
    medium.law = law->law;
    if (medium.law == Medium::Law::given) return check_given(e, medium);
    for (const auto* property : {&medium.density, &medium.isochoric_heat})
        if (*property && !(*property)->variables.empty())
            e.error(Id::wrong_type, (*property)->span, fmt::format("medium '{}' follows the law '{}', whose properties are expressions of parameters; a law of its own needs law = \"given\"", e.name(), law->name));
    if (medium.expansion && !medium.reference_temperature)
        e.error(Id::missing_key, e.span_of("expansion"), fmt::format("medium '{}' has a thermal expansion and needs the reference_temperature from which it counts", e.name()));
}

void read(const Entry& e, Reservoir& reservoir) { read_described(e, reservoir); }

void read(const Entry& e, Junction& junction) { read_described(e, junction); }

void read(const Entry& e, Volume& volume) {
    read_described(e, volume);
    if (e.has("polytropic") && e.has("isothermal"))
        e.error(Id::doubly_determined, e.span_of("polytropic"), fmt::format("volume '{}' is isothermal and polytropic; both fix its temperature", e.name()),
                {{e.span_of("isothermal"), "it is isothermal here"}});
    std::vector<std::string> chosen;
    for (const char* key : {"pressure", "density", "mass"})
        if (e.has(key)) chosen.emplace_back(key);
    if (e.has("filling")) {
        if (!e.has("pressure")) e.error(Id::missing_key, e.span(), fmt::format("volume '{}' follows its filling and needs the pressure at its surface", e.name()));
        for (const char* key : {"density", "mass"})
            if (e.has(key)) e.error(Id::doubly_determined, e.span_of(key), fmt::format("volume '{}' has a filling and a {}; one of them follows from the other", e.name(), key), {{e.span_of("filling"), "the filling stands here"}});
    } else {
        if (chosen.empty()) e.error(Id::missing_key, e.span(), fmt::format("volume '{}' needs a state: pressure, density, mass, or filling", e.name()));
        if (chosen.size() > 1)
            e.error(Id::doubly_determined, e.span_of(chosen[1]), fmt::format("volume '{}' has a {} and a {}; one of them follows from the other", e.name(), chosen[0], chosen[1]),
                    {{e.span_of(chosen[0]), fmt::format("the {} stands here", chosen[0])}});
    }
    if (e.has("head") != e.has("gravity")) e.error(Id::missing_key, e.span(), fmt::format("volume '{}' needs head and gravity together, or neither", e.name()));
    if (volume.empties && !e.has("filling")) e.error(Id::missing_key, e.span_of("empties"), fmt::format("volume '{}' has no filling that could run out", e.name()));
    if (volume.empties && e.has("for")) e.error(Id::not_allowed_here, e.span_of("empties"), fmt::format("volume '{}' is a family, whose members cannot have modes of their own", e.name()));
    if (e.has("head") && !e.has("filling")) e.error(Id::missing_key, e.span_of("head"), fmt::format("volume '{}' has a head, but no filling that it depends on", e.name()));
}

void read(const Entry& e, Flow& flow) {
    read_described(e, flow);
    const std::vector<const char*> keys{"mass_flow", "volume_flow", "area", "coefficient", "width", "conductance", "cracking_pressure", "switches", "displacement", "speed", "velocity", "length", "loss"};
    const auto either = [&](bool first, bool second, const char* sentence) {
        if (first == second) e.error(first ? Id::doubly_determined : Id::missing_key, e.span(), fmt::format("flow '{}' {}", e.name(), sentence));
    };
    if (!e.has("law")) {
        either(e.has("mass_flow"), e.has("volume_flow"), "needs either a mass_flow, a volume_flow or a law");
        flow.law = e.has("mass_flow") ? Flow::Law::given_mass : Flow::Law::given_volume;
        for (const char* key : keys)
            if (e.has(key) && std::string_view(key) != "mass_flow" && std::string_view(key) != "volume_flow")
                e.error(Id::unknown_key, e.span_of(key), fmt::format("flow '{}' is given and has no use for '{}'; say its law", e.name(), key));
        return;
    }
    const auto* law = find_law(e, "flow", flow_laws(), keys);
    if (law == nullptr) return;
    flow.law = law->law;
    if (flow.switches && e.has("for")) e.error(Id::not_allowed_here, e.span_of("switches"), fmt::format("flow '{}' is a family, whose members cannot have modes of their own", e.name()));
    if (flow.switches && e.has("width")) e.error(Id::doubly_defined, e.span_of("switches"), fmt::format("flow '{}' is smooth, and has no modes then", e.name()), {{e.span_of("width"), "its width stands here"}});
    if (flow.law == Flow::Law::check_valve) {
        either(e.has("conductance"), e.has("area"), "is a check valve and needs either a conductance or an area with its coefficient");
        if (e.has("area") != e.has("coefficient")) e.error(Id::missing_key, e.span(), fmt::format("check valve '{}' needs area and coefficient together", e.name()));
        if (e.has("width") && !e.has("area")) e.error(Id::unknown_key, e.span_of("width"), fmt::format("check valve '{}' is laminar and has no use for 'width'", e.name()));
    }
    if (flow.law == Flow::Law::pump) {
        either(e.has("volume_flow"), e.has("displacement"), "is a pump and needs either a volume_flow, or a displacement with its speed");
        if (e.has("displacement") != e.has("speed")) e.error(Id::missing_key, e.span(), fmt::format("pump '{}' needs displacement and speed together", e.name()));
    }
}

}  // namespace dalembert

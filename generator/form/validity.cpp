// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/validity.hpp"

#include <fmt/format.h>

#include <set>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

class ValueCheck {
public:
    explicit ValueCheck(const System& system) : system_(system), start_(Values(system.scene, system.translate).substitution()) { add_steps(start_, system.symbols, 30); }

    void run() const {
        for (const auto& member : system_.scene.media) check(*member.item);
        for (const ReservoirState& reservoir : system_.fluids.containers.reservoirs) {
            const Reservoir& item = *reservoir.member.item;
            if (!depends_on_input(reservoir.fluid.pressure)) positive(reservoir.fluid.pressure, item.pressure->span, fmt::format("the pressure of reservoir '{}'", item.name), "Pa");
            if (item.temperature && reservoir.fluid.temperature && !depends_on_input(*reservoir.fluid.temperature)) positive(*reservoir.fluid.temperature, item.temperature->span, fmt::format("the temperature of reservoir '{}'", item.name), "K");
        }
        for (const ControlVolume& volume : system_.fluids.containers.volumes) check(volume);
        check_radiation();
        for (const FlowState& flow : system_.fluids.flows) {
            const Flow& item = *flow.member.item;
            const auto constant = [&](const ExpressionPtr& e, const char* what, const char* unit) {
                if (e) positive(system_.translate(e, Translator::indices_of(flow.member)), e->span, fmt::format("the {} of flow '{}'", what, flow.member.name()), unit);
            };
            constant(item.width, "width", "Pa");
            constant(item.length, "length", "m");
            if (item.law == Flow::Law::pipe) constant(item.area, "area", "m^2");
            else at_least_zero(item.area, flow, "area", "m^2");
            at_least_zero(item.coefficient, flow, "coefficient", "1");
            at_least_zero(item.conductance, flow, "conductance", "m^3/(s*Pa)");
            at_least_zero(item.cracking_pressure, flow, "cracking pressure", "Pa");
        }
    }

private:
    static constexpr auto no_pattern = GiNaC::subs_options::no_pattern;

    /// The value at the start; nothing where it has none.
    std::optional<numeric> value(const ex& e) const {
        const ex number = e.subs(start_, no_pattern).evalf();
        if (!GiNaC::is_exactly_a<numeric>(number) || !ex_to<numeric>(number).is_real()) return std::nullopt;
        return ex_to<numeric>(number);
    }

    bool depends_on_input(const ex& e) const {
        for (const Variable& input : system_.symbols.all(SymbolKind::input))
            if (e.has(input.symbol)) return true;
        return false;
    }

    /// What radiates is above absolute zero.
    void check_radiation() const {
        std::set<const NodeState*> checked;
        const auto check = [&](const NodeState& node) {
            const ex& T = node.warmth.temperature;
            if (checked.insert(&node).second && !depends_on_input(T)) positive(T, node.place, fmt::format("the temperature of '{}', which radiates,", node.name), "K");
        };
        for (const NodeState& node : system_.heat.nodes)
            if (node.radiates) check(node);
        for (const LinkState& link : system_.heat.links)
            for (const LinkEnd& end : {link.from, link.to})
                if (link.radiates && end.node != nullptr) check(*end.node);
    }

    void positive(const ex& e, const Span& place, const std::string& what, const char* unit) const {
        const auto number = value(e);
        if (number && number->is_positive()) return;
        throw Failure(Diagnostic{Id::value_out_of_range, place, fmt::format("{} is {} {} at the start, but must be above zero", what, number ? fmt::format("{:.6g}", number->to_double()) : "no number", unit)});
    }

    /// Of what may be shut. An input may make it zero or negative later.
    void at_least_zero(const ExpressionPtr& e, const FlowState& flow, const char* what, const char* unit) const {
        if (!e) return;
        const ex translated = system_.translate(e, Translator::indices_of(flow.member));
        const auto number = value(translated);
        if (depends_on_input(translated) || !number || !number->is_negative()) return;
        throw Failure(Diagnostic{Id::value_out_of_range, e->span,
                                 fmt::format("the {} of flow '{}' is {:.6g} {} at the start, but must not be below zero", what, flow.member.name(), number->to_double(), unit)});
    }

    void property(const ExpressionPtr& e, const Medium& medium, const char* what, const char* unit) const {
        if (e) positive(system_.translate(e, {}), e->span, fmt::format("the {} of medium '{}'", what, medium.name), unit);
    }

    void check(const Medium& medium) const {
        if (medium.law == Medium::Law::ideal_gas) {
            const auto R = value(system_.translate(medium.gas_constant, {}));
            if (!R || !R->is_positive())
                throw Failure(Diagnostic{Id::inconsistent_medium, medium.gas_constant->span,
                                         fmt::format("the gas constant of medium '{}' is {:.6g} J/(kg*K), so that c_p = c_v + R is not above c_v", medium.name, R ? R->to_double() : 0.0)});
        }
        if (medium.density && medium.density->variables.empty()) property(medium.density->body, medium, "density", "kg/m^3");
        property(medium.bulk_modulus, medium, "bulk modulus", "Pa");
        property(medium.reference_pressure, medium, "reference pressure", "Pa");
        property(medium.reference_temperature, medium, "reference temperature", "K");
        if (medium.isochoric_heat && medium.isochoric_heat->variables.empty() && system_.scene.thermal_media.contains(medium.name))
            property(medium.isochoric_heat->body, medium, "isochoric heat", "J/(kg*K)");
    }

    void check(const ControlVolume& volume) const {
        const Volume& item = *volume.member.item;
        const std::string name = fmt::format("volume '{}'", volume.member.name());
        const Indices indices = Translator::indices_of(volume.member);
        const auto constant = [&](const ExpressionPtr& e, const char* what, const char* unit) {
            if (e) positive(system_.translate(e, indices), e->span, fmt::format("the {} of {}", what, name), unit);
        };
        if (!volume.is_thermal()) constant(item.isothermal, "temperature", "K");
        if (item.polytropic && volume.exponent) {
            constant(item.polytropic->exponent, "polytropic exponent", "1");
            constant(item.polytropic->pressure, "polytropic pressure", "Pa");
            constant(item.polytropic->temperature, "polytropic temperature", "K");
        }
        if (volume.is_thermal()) positive(*volume.fluid.temperature, item.temperature->span, fmt::format("the temperature of {}", name), "K");
        if (volume.primary == ControlVolume::Primary::filling) return;
        positive(volume.size, item.volume->span, fmt::format("the size of {}", name), "m^3");
        const ExpressionPtr& state = item.pressure ? item.pressure : item.density ? item.density : item.mass;
        const char* what = item.pressure ? "pressure" : item.density ? "density" : "mass";
        positive(system_.translate(state, Translator::indices_of(volume.member)), state->span, fmt::format("the {} of {}", what, name), item.pressure ? "Pa" : item.density ? "kg/m^3" : "kg");
        positive(volume.medium_state.pressure, state->span, fmt::format("the pressure that follows from the {} of {}", what, name), "Pa");
    }

    const System& system_;
    GiNaC::exmap start_;
};

}  // namespace

void check_fluid_values(const System& system) { ValueCheck(system).run(); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/fluid_validity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "elements/fluids.hpp"
#include "elements/model.hpp"
#include "form/signs.hpp"
#include "text/diagnostic.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class ValueCheck {
public:
    ValueCheck(const System& system, const Values& values, ValueConditions* conditions)
        : system_(system), value_(system, values, conditions) {}

    void run() const {
        for (const auto& member : system_.scene.media) check(*member.item);
        for (const ReservoirState& reservoir : system_.fluids.containers.reservoirs) signs(reservoir.member);
        for (const ControlVolume& volume : system_.fluids.containers.volumes) check(volume);
        for (const FlowState& flow : system_.fluids.flows) signs(flow.member);
    }

private:
    template <class T>
    void signs(const Member<T>& member) const {
        check_signs(*member.item, member.name(), Translator::indices_of(member), system_, value_);
    }
    void positive(const ex& e, const Span& place, const std::string& what, const char* unit) const {
        value_.positive(e, place, what, unit);
    }

    void check(const Medium& medium) const {
        if (medium.law == Medium::Law::ideal_gas) {
            const ex constant = system_.translate(medium.gas_constant, {});
            value_.note({ValueCondition::Rule::above_zero,
                         {constant},
                         fmt::format("the gas constant of medium '{}' is {{}} J/(kg*K), so c_p = c_v + R is not above c_v", medium.name)});
            const auto R = value_(constant);
            if (!R || !R->is_positive())
                throw Failure(
                    Diagnostic{Id::inconsistent_medium, medium.gas_constant->span,
                               fmt::format("the gas constant of medium '{}' is {:.6g} J/(kg*K), so c_p = c_v + R is not above c_v",
                                           medium.name, R ? R->to_double() : 0.0)});
        }
        check_signs(medium, medium.name, {}, system_, value_);
        const bool has_curves = !system_.scene.model->curves.empty();
        if (has_curves && medium.isochoric_heat && !medium.isochoric_heat->variables.empty()) check_isochoric_heat(medium);
        if (medium.isochoric_heat && medium.isochoric_heat->variables.empty() && system_.scene.thermal_media.contains(medium.name))
            positive(system_.translate(medium.isochoric_heat->body, {}), medium.isochoric_heat->body->span,
                     fmt::format("the isochoric heat of medium '{}'", medium.name), "J/(kg*K)");
    }

    /// As a law of the pressure and the temperature, which are above zero.
    void check_isochoric_heat(const Medium& medium) const {
        const Property& law = *medium.isochoric_heat;
        Letters letters;
        BoundsOfLetters bounds;
        for (const std::string& name : law.variables) {
            const ex letter = GiNaC::realsymbol(name);
            letters.emplace(name, letter);
            bounds.emplace(letter, Bounds{Rational(0), std::nullopt});
        }
        value_.check_curves(above_zero("J/(kg*K)"), system_.translate(*law.body, {}, letters), law.body->span,
                            fmt::format("the isochoric heat of medium '{}'", medium.name), bounds);
    }

    void check(const ControlVolume& volume) const {
        const Volume& item = *volume.member.item;
        signs(volume.member);
        if (volume.primary == ControlVolume::Primary::filling) return;
        const ExpressionPtr& state = item.pressure ? item.pressure : item.density ? item.density : item.mass;
        positive(volume.medium_state.pressure, state->span,
                 fmt::format("the pressure that follows from the {} of volume '{}'",
                             item.pressure  ? "pressure"
                             : item.density ? "density"
                                            : "mass",
                             volume.member.name()),
                 "Pa");
    }

    const System& system_;
    StartValues value_;
};

/// dm/dp at the start, kg/Pa; nothing where the pressure does not follow what is stored.
std::optional<double> compliance(const ControlVolume& volume, const System& system, const StartValues& value) {
    const ex& state = system.symbols.get(SymbolKind::state, volume.state);
    const auto mass = value(partial(volume.mass(), state)), pressure = value(partial(volume.fluid.pressure, state));
    if (!mass || !pressure || pressure->is_zero()) return std::nullopt;
    return std::fabs((*mass / *pressure).to_double());
}

/// Whether the flow goes like the root of a pressure difference down to zero.
bool is_exact_root(const Flow& item) {
    const bool is_orifice = item.law == Flow::Law::hydraulic_orifice || item.law == Flow::Law::pneumatic_orifice ||
                            (item.law == Flow::Law::check_valve && !item.conductance);
    return is_orifice && !item.width && !item.switches;
}

}  // namespace

void check_fluid_values(const System& system, const Values& values, ValueConditions* conditions) {
    ValueCheck(system, values, conditions).run();
}

void warn_of_stiff_junctions(System& system) {
    constexpr double next_to_nothing = 1e-4;
    const StartValues value(system);
    for (const ControlVolume& volume : system.fluids.containers.volumes) {
        const auto own = compliance(volume, system, value);
        if (!own) continue;
        std::set<const ControlVolume*> others;
        std::vector<std::string> flows;
        for (const FlowState& flow : system.fluids.flows) {
            const ControlVolume* other = flow.from_volume == &volume ? flow.to_volume
                                         : flow.to_volume == &volume ? flow.from_volume
                                                                     : nullptr;
            if (other == nullptr || !is_exact_root(*flow.member.item)) continue;
            const auto stored = compliance(*other, system, value);
            if (stored && *own > next_to_nothing * *stored) continue;
            others.insert(other);
            flows.push_back(flow.member.name());
        }
        if (others.size() < 2) continue;
        system.warnings.push_back(
            {Id::value_out_of_range,
             volume.member.item->span,
             fmt::format("volume '{}' stores {:.2g} kg/Pa, far less than the volumes around it: when the pressures at {} become equal, "
                         "their slopes are all infinite, and a run may stop. Give each of them a 'width', a pressure difference within "
                         "which the root is smooth, such as \"1 Pa\", or make the volume one of [junctions], which store nothing",
                         volume.member.name(), *own, quoted_list(flows)),
             {},
             Severity::warning});
    }
}

}  // namespace dalembert

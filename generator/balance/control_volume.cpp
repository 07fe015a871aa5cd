// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/control_volume.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/fluids.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/integrate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

template <class State>
const State* find(const std::vector<State>& states, const std::string& name, int index) {
    const auto found =
        std::find_if(states.begin(), states.end(), [&](const State& s) { return s.member.item->name == name && s.member.index == index; });
    return found == states.end() ? nullptr : &*found;
}

class Containing {
public:
    Containing(const Scene& scene, const Translator& translate, Symbols& symbols)
        : scene_(scene), translate_(translate), symbols_(symbols) {}

    Containers run() {
        for (const auto& member : scene_.media) result_.media.emplace_back(*member.item, scene_, translate_);
        for (const auto& member : scene_.reservoirs) result_.reservoirs.push_back(reservoir(member));
        for (const auto& member : scene_.junctions) result_.junctions.push_back(junction(member));
        for (const auto& member : scene_.volumes) result_.volumes.push_back(volume(member));
        return std::move(result_);
    }

private:
    ex value(const ExpressionPtr& e, const Indices& indices) const { return e ? translate_(e, indices) : ex(0); }

    ReservoirState reservoir(const Member<Reservoir>& member) const {
        const Reservoir& item = *member.item;
        const Indices indices = Translator::indices_of(member);
        const MediumModel& medium = *result_.find_medium(item.medium.name);
        const std::optional<ex> T =
            item.temperature ? std::optional(translate_(item.temperature, indices)) : medium.reference_temperature(item);
        const MediumState state = medium.at_pressure(translate_(item.pressure, indices), T.value_or(0));
        return {member, &medium, {state.pressure, T, state.density, state.energy, state.enthalpy, value(item.potential, indices)}};
    }

    JunctionState junction(const Member<Junction>& member) const {
        const Junction& item = *member.item;
        if (scene_.thermal_media.contains(item.medium.name))
            throw Failure(Diagnostic{
                Id::not_allowed_here, item.span,
                fmt::format("junction '{}' holds '{}', and scene '{}' has temperatures of this medium; this version does not mix "
                            "temperatures in junctions. Leave the temperatures out, or make the junction a small volume with a temperature",
                            member.name(), item.medium.name, scene_.name)});
        JunctionState j{member, result_.find_medium(item.medium.name), symbols_.letter("pressure[" + member.name() + "]"), {}};
        j.fluid.temperature = j.medium->reference_temperature(item);
        j.fluid.potential = value(item.potential, Translator::indices_of(member));
        j.take_pressure(j.letter);
        return j;
    }

    /// The position of the state that an entry names.
    std::size_t state(const ExpressionPtr& named, const Indices& indices) const {
        const int index = named->children.empty() ? 0 : index_value(*named->children[0], scene_, indices);
        if (const Variable* variable = symbols_.find(SymbolKind::state, named->name, index)) return variable->position;
        throw Failure(Diagnostic{Id::index_out_of_range, named->span, fmt::format("the scene has no state '{}'", named->written())});
    }

    ControlVolume volume(const Member<Volume>& member) const {
        const Volume& item = *member.item;
        const Indices indices = Translator::indices_of(member);
        ControlVolume v{member, result_.find_medium(item.medium.name), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
        const ExpressionPtr& named = item.filling ? item.filling : item.pressure ? item.pressure : item.density ? item.density : item.mass;
        v.primary = item.filling     ? ControlVolume::Primary::filling
                    : item.pressure  ? ControlVolume::Primary::pressure
                    : item.density   ? ControlVolume::Primary::density
                                     : ControlVolume::Primary::mass;
        v.state = state(named, indices);
        v.is_empty = item.empties && scene_.modes[*scene_.mode].is_in(item.name + "_empty");
        v.size = translate_(item.volume, indices);
        if (v.size.expand().is_zero())
            throw Failure(Diagnostic{Id::value_out_of_range, item.volume->span,
                                     fmt::format("the size of volume '{}' is zero for all parameters", v.member.name())});
        check_size(v);

        std::optional<ex> T;
        if (scene_.has_temperature(item, translate_.names())) {
            if (!item_has_heat(v.medium->item()))
                throw Failure(Diagnostic{Id::missing_key,
                                         v.medium->item().span,
                                         fmt::format("the temperature of volume '{}' is a state, so medium '{}' needs an isochoric_heat",
                                                     v.member.name(), v.medium->item().name),
                                         {{item.temperature->span, "the temperature stands here"}}});
            v.temperature_state = state(item.temperature, indices);
            T = translate_(item.temperature, indices);
        } else if (!item.polytropic) {
            T = item.isothermal ? std::optional(translate_(item.isothermal, indices)) : v.medium->reference_temperature(item);
        }
        const ex primary = translate_(named, indices);
        if (item.polytropic && !T) polytropic(v, primary, T, indices);
        else v.medium_state = medium_state(v, primary, T.value_or(0), indices);
        v.surface_pressure = v.medium_state.pressure;
        v.fluid = {
            v.surface_pressure, T, v.medium_state.density, v.medium_state.energy, v.medium_state.enthalpy, value(item.potential, indices)};
        if (item.head) column(v, indices);
        return v;
    }

    MediumState medium_state(const ControlVolume& v, const ex& primary, const ex& T, const Indices& indices) const {
        switch (v.primary) {
            case ControlVolume::Primary::pressure: return v.medium->at_pressure(primary, T);
            case ControlVolume::Primary::density: return v.medium->at_density(primary, T);
            case ControlVolume::Primary::mass: return v.medium->at_density(primary / v.size, T);
            case ControlVolume::Primary::filling: break;
        }
        return v.medium->at_pressure(surface_pressure(v, indices), T);
    }

    /// Of a volume with a filling; constant where the medium is compressible.
    ex surface_pressure(const ControlVolume& v, const Indices& indices) const {
        ex pressure = translate_(v.member.item->pressure, indices);
        if (v.medium->is_compressible() && !symbols_.is_constant(pressure))
            throw Failure(Diagnostic{Id::not_allowed_here, v.member.item->pressure->span,
                                     fmt::format("volume '{}' follows its filling and holds the compressible medium '{}': its pressure "
                                                 "must be constant, but '{}' is not",
                                                 v.member.name(), v.medium->item().name, v.member.item->pressure->written())});
        return pressure;
    }

    /// p = p_r*(rho/rho_r)^n and T = T_r*(p/p_r)^((n-1)/n), (3.65) and (3.67).
    void polytropic(ControlVolume& v, const ex& primary, std::optional<ex>& T, const Indices& indices) const {
        const Volume::Polytropic& course = *v.member.item->polytropic;
        const ex n = translate_(course.exponent, indices);
        const ex p_r = translate_(course.pressure, indices);
        const ex T_r = translate_(course.temperature, indices);
        v.exponent = n;
        if (v.primary == ControlVolume::Primary::pressure || v.primary == ControlVolume::Primary::filling) {
            const ex p = v.primary == ControlVolume::Primary::pressure ? primary : surface_pressure(v, indices);
            T = T_r * pow(p / p_r, (n - 1) / n);
            v.medium_state = v.medium->at_pressure(p, *T);
        } else {
            const ex rho = v.primary == ControlVolume::Primary::density ? primary : primary / v.size;
            T = T_r * pow(rho * v.medium->gas_constant() * T_r / p_r, n - 1);
            v.medium_state = v.medium->at_density(rho, *T);
        }
    }

    static bool item_has_heat(const Medium& medium) { return medium.isochoric_heat.has_value() || medium.energy.has_value(); }

    /// Without a filling the size follows the walls; with one it follows its own state and nothing else.
    void check_size(const ControlVolume& v) const {
        const bool fills = v.primary == ControlVolume::Primary::filling;
        for (const SymbolKind kind : {SymbolKind::time, SymbolKind::coordinate, SymbolKind::state})
            for (const Variable& variable : symbols_.all(kind)) {
                const bool is_own = fills && kind == SymbolKind::state && variable.position == v.state;
                const bool is_allowed = is_own || (!fills && kind != SymbolKind::state);
                if (is_allowed || !v.size.has(variable.symbol)) continue;
                throw Failure(Diagnostic{
                    Id::not_allowed_here, v.member.item->volume->span,
                    fmt::format("the size of volume '{}' follows {}, so it must not depend on '{}'", v.member.name(),
                                fills ? fmt::format("its filling '{}'", v.member.item->filling->written()) : "walls", variable.name)});
            }
        if (fills && !v.size.has(symbols_.get(SymbolKind::state, v.state)))
            throw Failure(Diagnostic{Id::undetermined, v.member.item->volume->span,
                                     fmt::format("the size of volume '{}' does not depend on its filling '{}'", v.member.name(),
                                                 v.member.item->filling->written())});
    }

    /// Pressure rho*g*head more at the outlets; the column stores the integral of rho*g*head over the volume.
    void column(ControlVolume& v, const Indices& indices) const {
        const Volume& item = *v.member.item;
        const ex weight = v.fluid.density * translate_(item.gravity, indices);
        const ex head = translate_(item.head, indices);
        for (const Variable& state : symbols_.all(SymbolKind::state))
            if (state.position != v.state && head.has(state.symbol))
                throw Failure(Diagnostic{Id::not_allowed_here, item.head->span,
                                         fmt::format("the head of volume '{}' follows its filling '{}', so it must not depend on '{}'",
                                                     v.member.name(), item.filling->written(), state.name)});
        v.fluid.pressure = v.surface_pressure + weight * head;
        v.fluid.enthalpy = v.fluid.energy + v.fluid.pressure / v.fluid.density;
        const ex& filling = symbols_.get(SymbolKind::state, v.state);
        const auto energy = integrate((weight * head * partial(v.size, filling)).expand(), GiNaC::ex_to<GiNaC::symbol>(filling));
        if (!energy)
            throw Failure(
                Diagnostic{Id::cannot_integrate, item.head->span,
                           fmt::format("the program cannot find the integral for the potential energy of the column in volume '{}'",
                                       v.member.name())});
        v.column = *energy - energy->subs(filling == 0, GiNaC::subs_options::no_pattern);
    }

    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    Containers result_;
};

}  // namespace

const MediumModel* Containers::find_medium(const std::string& name) const {
    const auto found = std::find_if(media.begin(), media.end(), [&](const MediumModel& m) { return m.item().name == name; });
    return found == media.end() ? nullptr : &*found;
}

const ControlVolume* Containers::find_volume(const std::string& name, int index) const { return find(volumes, name, index); }
const ReservoirState* Containers::find_reservoir(const std::string& name, int index) const { return find(reservoirs, name, index); }

const JunctionState* Containers::find_junction(const std::string& name, int index) const { return find(junctions, name, index); }

void JunctionState::take_pressure(const ex& pressure) {
    const MediumState state = medium->at_pressure(pressure, fluid.temperature.value_or(0));
    fluid.pressure = pressure;
    fluid.density = state.density;
    fluid.energy = state.energy;
    fluid.enthalpy = state.enthalpy;
}

Containers make_containers(const Scene& scene, const Translator& translate, Symbols& symbols) {
    return Containing(scene, translate, symbols).run();
}

}  // namespace dalembert

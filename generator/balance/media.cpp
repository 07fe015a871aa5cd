// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/media.hpp"

#include <fmt/format.h>

#include "elements/fluids.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/integrate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

/// What follows from rho(p, T) alone: dp/drho = 1/(drho/dp) and dp/dT at constant rho = -(drho/dT)/(drho/dp).
void derive_slopes(MediumState& law, const ex& p, const ex& T) {
    const ex by_pressure = partial(law.density, p);
    law.pressure_by_density = pow(by_pressure, -1);
    law.pressure_by_temperature = -partial(law.density, T) / by_pressure;
}

}  // namespace

MediumModel::MediumModel(const Medium& medium, const Scene& scene, const Translator& translate)
    : item_(&medium), p_(GiNaC::possymbol("[p]")), T_(GiNaC::possymbol("[T]")), rho_(GiNaC::possymbol("[rho]")) {
    if (medium.reference_temperature) reference_temperature_ = translate(medium.reference_temperature, {});
    if (medium.gas_constant) gas_constant_ = translate(medium.gas_constant, {});
    if (medium.density && medium.density->variables.empty()) density_ = translate(*medium.density->body, {});
    // Where no temperature varies the scene does not have what only it depends on, and the energy is that of one temperature.
    const bool is_thermal = scene.thermal_media.contains(medium.name);
    const bool has_heat = medium.isochoric_heat && medium.isochoric_heat->variables.empty();
    bool is_there = has_heat;
    if (has_heat && !is_thermal)
        for_each(*medium.isochoric_heat->body, [&](const Expression& e) {
            const bool is_name = e.kind == Expression::Kind::name && e.name != "pi";
            is_there = is_there && (!is_name || translate.symbols().find(SymbolKind::parameter, e.name, 0) != nullptr ||
                                    translate.symbols().find(SymbolKind::definition, e.name, 0) != nullptr ||
                                    scene.fixed.contains(e.name) || scene.folded.contains(e.name));
        });
    if (is_there) heat_ = translate(*medium.isochoric_heat->body, {});
    law_.pressure = p_;
    law_.temperature = T_;
    switch (medium.law) {
        case Medium::Law::ideal_gas: ideal_gas(); break;
        case Medium::Law::liquid: liquid(translate); break;
        case Medium::Law::incompressible: incompressible(); break;
        case Medium::Law::given: given(translate); break;
    }
}

/// (3.53), (3.55), (3.56) with e = 0 at T = 0.
void MediumModel::ideal_gas() {
    const ex& R = gas_constant_;
    law_.density = p_ / (R * T_);
    law_.energy = heat_ * T_;
    law_.enthalpy = (heat_ + R) * T_;
    law_.isochoric_heat = heat_;
    law_.pressure_by_density = R * T_;
    law_.pressure_by_temperature = p_ / T_;
    MediumState by_density = law_;
    by_density.pressure = rho_ * R * T_;
    by_density.density = rho_;
    by_density.pressure_by_temperature = rho_ * R;
    by_density_ = by_density;
}

/// (3.76) and (3.79) in x = log(rho/rho_0): rho_0*e = rho_0*c_v*(T - T_0) + (p_0 - alpha*beta*T_0)*(1 - exp(-x)) + beta*(1 - (1 +
/// x)*exp(-x)), so that no digits are lost near the reference, where everything printed cancels.
void MediumModel::liquid(const Translator& translate) {
    const ex rho_0 = density_;
    const ex beta = translate(item_->bulk_modulus, {});
    const ex p_0 = translate(item_->reference_pressure, {});
    const ex alpha = item_->expansion ? translate(item_->expansion, {}) : ex(0);
    const ex warmer = reference_temperature_ ? whole(T_ - *reference_temperature_) : ex(0);
    const ex constant = reference_temperature_ ? p_0 - alpha * beta * *reference_temperature_ : p_0;

    const ex x = whole(p_ - p_0) / beta - alpha * warmer;
    law_.density = rho_0 * GiNaC::exp(x);
    law_.energy = heat_ * warmer + (-constant * exp_minus_one(-x) + beta * compression(x)) / rho_0;
    law_.enthalpy = law_.energy + p_ / law_.density;
    law_.isochoric_heat = heat_;
    law_.pressure_by_density = beta / law_.density;
    law_.pressure_by_temperature = alpha * beta;

    MediumState by_density = law_;
    const ex denser = whole(rho_ - rho_0);
    const ex y = log_one_plus(denser / rho_0);
    by_density.pressure = p_0 + beta * (y + alpha * warmer);
    by_density.density = rho_;
    by_density.energy = heat_ * warmer + constant * denser / (rho_ * rho_0) + beta * compression(y) / rho_0;
    by_density.enthalpy = by_density.energy + by_density.pressure / rho_;
    by_density.pressure_by_density = beta / rho_;
    by_density_ = by_density;
}

void MediumModel::incompressible() {
    law_.density = density_;
    law_.energy = reference_temperature_ ? heat_ * whole(T_ - *reference_temperature_) : ex(0);
    law_.enthalpy = law_.energy + p_ / density_;
    law_.isochoric_heat = heat_;
    law_.pressure_by_density = 0;
    law_.pressure_by_temperature = 0;
}

void MediumModel::given(const Translator& translate) {
    const auto law = [&](const Property& property, const ex& first) {
        if (property.variables.empty()) return translate(*property.body, {});
        return translate(*property.body, {}, {{property.variables[0], first}, {property.variables[1], T_}});
    };
    law_.density = law(*item_->density, p_);
    derive_slopes(law_, p_, T_);
    if (item_->energy) {
        law_.energy = law(*item_->energy, p_);
        // c_v is the slope of the energy at constant density, along which dp = (dp/dT)*dT.
        law_.isochoric_heat = partial(law_.energy, T_) + partial(law_.energy, p_) * law_.pressure_by_temperature;
    } else {
        law_.isochoric_heat = item_->isochoric_heat ? law(*item_->isochoric_heat, p_) : ex(0);
        if (item_->isochoric_heat) integrate_energy(translate(item_->reference_pressure, {}), *reference_temperature_);
        else law_.energy = 0;
    }
    law_.enthalpy = law_.energy + p_ / law_.density;
    if (!item_->pressure) return;
    const ex pressure = law(*item_->pressure, rho_);
    MediumState by_density = substituted(law_, {{p_, pressure}});
    by_density.density = rho_;
    by_density_ = by_density;
}

/// (3.77) along p = p_0 first and T = const then: de/dT = c_v + (T dp/dT - p) dnu/dT, de/dp = (T dp/dT - p) dnu/dp.
void MediumModel::integrate_energy(const ex& p_0, const ex& T_0) {
    const ex volume = pow(law_.density, -1);
    const ex work = T_ * law_.pressure_by_temperature - p_;
    const ex by_temperature = (law_.isochoric_heat + work * partial(volume, T_)).subs(p_ == p_0, GiNaC::subs_options::no_pattern);
    const ex by_pressure = work * partial(volume, p_);
    const auto primitive = [&](const ex& slope, const ex& letter, const char* of) {
        for (const ex& form : {slope, slope.normal(), slope.expand().normal()})
            if (const auto found = integrate(form, GiNaC::ex_to<GiNaC::symbol>(letter))) return *found;
        throw Failure(Diagnostic{
            Id::cannot_integrate, item_->density->span,
            fmt::format("the program cannot find the integral over the {1} for the internal energy of medium '{0}'; give its energy",
                        item_->name, of)});
    };
    const ex heating = primitive(by_temperature, T_, "temperature");
    const ex pressing = primitive(by_pressure, p_, "pressure");
    law_.energy = heating - heating.subs(T_ == T_0, GiNaC::subs_options::no_pattern) + pressing -
                  pressing.subs(p_ == p_0, GiNaC::subs_options::no_pattern);
}

MediumState MediumModel::substituted(const MediumState& law, const GiNaC::exmap& values) const {
    const auto at = [&](const ex& e) { return e.subs(values, GiNaC::subs_options::no_pattern); };
    return {at(law.pressure),
            at(law.temperature),
            at(law.density),
            at(law.energy),
            at(law.enthalpy),
            at(law.isochoric_heat),
            at(law.pressure_by_density),
            at(law.pressure_by_temperature)};
}

MediumState MediumModel::at_pressure(const ex& p, const ex& T) const { return substituted(law_, {{p_, p}, {T_, T}}); }

MediumState MediumModel::at_density(const ex& rho, const ex& T) const { return substituted(*by_density_, {{rho_, rho}, {T_, T}}); }

std::optional<ex> MediumModel::reference_temperature(const Item& asking) const {
    const bool matters = law_.density.has(T_) || law_.energy.has(T_) || law_.enthalpy.has(T_);
    if (reference_temperature_ || !matters) return reference_temperature_;
    throw Failure(Diagnostic{Id::missing_key,
                             asking.span,
                             fmt::format("'{}' has no temperature, and medium '{}' has no reference_temperature", asking.name, item_->name),
                             {{item_->span, fmt::format("medium '{}' is defined here", item_->name)}}});
}

ex MediumModel::isentropic_exponent() const {
    if (heat_.is_zero())
        throw Failure(Diagnostic{Id::missing_key, item_->span,
                                 fmt::format("medium '{}' needs its isochoric_heat for the ratio of specific heats", item_->name)});
    return (heat_ + gas_constant_) / heat_;
}

}  // namespace dalembert

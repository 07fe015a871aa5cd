// SPDX-License-Identifier: GPL-3.0-or-later
// Media: density, internal energy and what follows from them, from pressure or density and temperature (chapter 3.6).
#pragma once

#include <optional>

#include "elements/fluids.hpp"
#include "symbolic/translate.hpp"

namespace dalembert {

/// A medium in one state. SI; pressures and temperatures absolute.
struct MediumState {
    GiNaC::ex pressure;
    GiNaC::ex temperature;
    GiNaC::ex density;
    GiNaC::ex energy;                   ///< e, J/kg
    GiNaC::ex enthalpy;                 ///< h = e + p/rho (3.33), J/kg
    GiNaC::ex isochoric_heat;           ///< c_v (3.31), J/(kg K)
    GiNaC::ex pressure_by_density;      ///< dp/drho at constant T; of what is incompressible without meaning
    GiNaC::ex pressure_by_temperature;  ///< dp/dT at constant rho = alpha*beta (3.43a)
};

class MediumModel {
public:
    /// Throws Failure (cannot-integrate: the internal energy of a given density).
    MediumModel(const Medium& medium, const Scene& scene, const Translator& translate);

    const Medium& item() const { return *item_; }
    bool is_compressible() const { return item_->law != Medium::Law::incompressible; }

    MediumState at_pressure(const GiNaC::ex& p, const GiNaC::ex& T) const;
    /// Where the medium says its pressure over density and temperature: gases, liquids, given ones with an inverse.
    bool has_density_form() const { return by_density_.has_value(); }
    MediumState at_density(const GiNaC::ex& rho, const GiNaC::ex& T) const;

    /// The temperature of what says none; nothing where the medium has none either and none matters.
    /// Throws Failure (missing-key) with the place that asks where one matters.
    std::optional<GiNaC::ex> reference_temperature(const Item& asking) const;
    /// Of an ideal gas. Throws Failure (missing-key) where the gas has no isochoric heat.
    GiNaC::ex isentropic_exponent() const;
    const GiNaC::ex& gas_constant() const { return gas_constant_; }
    /// Density of a liquid at its reference, or of what is incompressible.
    const GiNaC::ex& reference_density() const { return density_; }

    /// The laws in the letters p and T, for proofs. The letters are positive.
    const GiNaC::ex& p() const { return p_; }
    const GiNaC::ex& T() const { return T_; }
    const MediumState& law() const { return law_; }

private:
    void ideal_gas();
    void liquid(const Translator& translate);
    void incompressible();
    void given(const Translator& translate);
    void integrate_energy(const GiNaC::ex& p_0, const GiNaC::ex& T_0);
    MediumState substituted(const MediumState& law, const GiNaC::exmap& values) const;

    const Medium* item_;
    GiNaC::ex p_, T_, rho_;
    GiNaC::ex gas_constant_, density_, heat_;
    std::optional<GiNaC::ex> reference_temperature_;
    MediumState law_;                        ///< in p and T
    std::optional<MediumState> by_density_;  ///< in rho and T
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/media.hpp"

#include <fmt/format.h>

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

std::vector<MediumIdentity> medium_identities(const MediumModel& medium) {
    const MediumState& law = medium.law();
    const ex& p = medium.p();
    const ex& T = medium.T();
    const ex& e = law.energy;
    const ex volume = pow(law.density, -1);
    const ex volume_by_p = partial(volume, p);
    const ex volume_by_T = partial(volume, T);
    const ex alpha = -partial(law.density, T) / law.density;
    const ex beta = law.density / partial(law.density, p);
    const ex gamma = law.pressure_by_temperature / p;
    // At constant nu: dp = -(nu_T/nu_p) dT.
    const ex pressure_by_T = -volume_by_T / volume_by_p;
    const ex energy_by_T = partial(e, T) + partial(e, p) * pressure_by_T;
    const ex energy_by_volume = partial(e, p) / volume_by_p;
    std::vector<MediumIdentity> identities{
        {"energy (3.21)", "de/dnu at constant T", "T*dp/dT - p", energy_by_volume, T * pressure_by_T - p},
        {"isochoric heat (3.31)", "de/dT at constant nu", "c_v", energy_by_T, law.isochoric_heat},
        {"p*gamma = alpha*beta (3.43a)", "p*gamma", "alpha*beta", p * gamma, alpha * beta},
        {"c_p - c_v (3.43b)", "c_p - c_v", "T*p*nu*alpha*gamma", partial(law.enthalpy, T) - law.isochoric_heat,
         T * p * volume * alpha * gamma},
        {"bulk modulus (3.41)", "dp/drho", "beta/rho", law.pressure_by_density, beta / law.density},
    };
    // T and p over (e, nu): dT/dnu at constant e = -e_nu/e_T, d/de = 1/e_T d/dT at constant nu. Without a heat there is no such T.
    if (!law.isochoric_heat.is_zero())
        identities.push_back({"entropy (3.11)", "d(1/T)/dnu", "d(p/T)/de", energy_by_volume / (energy_by_T * pow(T, 2)),
                              (T * pressure_by_T - p) / (pow(T, 2) * energy_by_T)});
    if (medium.has_density_form()) {
        const MediumState back = medium.at_density(law.density, T);
        identities.push_back({"inverse", "p(rho(p, T), T)", "p", back.pressure, p});
        identities.push_back({"energy over density", "e(rho(p, T), T)", "e(p, T)", back.energy, e});
    }
    return identities;
}

Comparison compare_at_states(const System& system, const MediumModel& medium, const MediumIdentity& identity) {
    const GiNaC::exmap defaults = Values(system.scene, system.translate).substitution();
    const auto number = [](const cln::cl_R& value) { return decimal(cln::rational(value), 6); };
    // From 1 to 200 bar and from 250 to 400 K, on a lattice that repeats no pressure and no temperature.
    constexpr int points = 30;
    int seen = 0;
    for (int i = 0; i < points; ++i) {
        const GiNaC::numeric p = 120000 + 654321 * i;
        const GiNaC::numeric T = GiNaC::numeric(285) + GiNaC::numeric((i * 11) % points * 5 - 35);
        GiNaC::exmap state = defaults;
        state[medium.p()] = p;
        state[medium.T()] = T;
        const auto difference = [&](int digits) { return value_at(identity.left - identity.right, state, digits); };
        const Sign sign = sign_at(difference);
        if (sign == Sign::none) continue;
        ++seen;
        if (sign == Sign::zero) continue;
        const auto left = value_at(identity.left, state, 30);
        const auto right = value_at(identity.right, state, 30);
        return {Verdict::wrong, fmt::format("at p = {} Pa, T = {} K: {} is {}, but {} is {}", p.to_long(), T.to_long(), identity.left_name,
                                            left ? number(*left) : "none", identity.right_name, right ? number(*right) : "none")};
    }
    if (seen == 0) return {Verdict::not_checkable, "it has no value at any state tried"};
    return {Verdict::numerically_equal};
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The net radiation method: what grey diffuse surfaces exchange, all reflections counted (4.42)-(4.51).
#pragma once

#include "balance/steps.hpp"

namespace dalembert {

/// Surfaces that see each other and nothing else.
struct Surroundings {
    std::vector<GiNaC::ex> areas;                ///< A_i, equal to the sum of direct[i][j] over j
    std::vector<GiNaC::ex> emissivities;
    std::vector<std::vector<GiNaC::ex>> direct;  ///< A_i*F_ij, symmetric
};

struct NetRadiation {
    /// A_i*(share of the radiosity of i that arrives at j, straight or by reflections), symmetric.
    std::vector<std::vector<GiNaC::ex>> reach;
    /// G_ij: Q_i = sum over j of G_ij*sigma*(T_i^4 - T_j^4) leaves surface i. Symmetric; zero on the diagonal.
    std::vector<std::vector<GiNaC::ex>> exchange;
};

/// note [elimination without subtractions]
/// With rho = 1 - eps, (4.51) says G = A*eps*(E - F*rho)^-1*F*eps off the diagonal. E - F*rho has no positive entry off its diagonal, and
/// what its rows add up to, F*eps, is known without a difference. Grassmann, Taksar and Heyman (1985) eliminate such matrices in sums,
/// products and quotients of what is not negative: the pivot A_k - rho_k*W_kk, where digits would cancel, is what leaves surface k for
/// good, a sum. So each exchange factor has nearly all digits for any emissivities, also next to 0 and 1.
NetRadiation net_radiation(const Surroundings& surroundings, Steps& steps);

}  // namespace dalembert

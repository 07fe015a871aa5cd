// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/forces.hpp"
#include "mechanics/dalembert.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

InertialForces christoffel(const Scene& scene, const Translator& translate) {
    const Symbols& symbols = translate.symbols();
    const auto n = static_cast<unsigned>(symbols.degrees());
    const auto q = [&](unsigned j) { return symbols.get(SymbolKind::coordinate, j); };
    const auto qd = [&](unsigned j) { return symbols.get(SymbolKind::velocity, j); };
    InertialForces result{GiNaC::matrix(n, n), std::vector<ex>(n, 0), 0};
    for (const auto& member : scene.kinetic) {
        const KineticTerm& term = *member.item;
        const ex energy = translate(term.energy, Translator::indices_of(member));
        GiNaC::matrix hessian(n, n);
        ex quadratic = 0;
        for (unsigned j = 0; j < n; ++j)
            for (unsigned l = 0; l < n; ++l) {
                hessian(j, l) = partial(partial(energy, qd(j)), qd(l)).expand();
                quadratic += hessian(j, l) * qd(j) * qd(l) / 2;
                for (unsigned k = 0; k < n; ++k)
                    if (!partial(hessian(j, l), qd(k)).is_zero())
                        throw Failure(
                            Diagnostic{Id::not_quadratic, term.energy->span,
                                       fmt::format("the energy of kinetic term '{}' is not quadratic in the velocities", term.name)});
            }
        if (!(energy - quadratic).expand().normal().is_zero())
            throw Failure(
                Diagnostic{Id::not_quadratic, term.energy->span,
                           fmt::format("the energy of kinetic term '{}' has parts that are not quadratic in the velocities", term.name)});
        // Gamma_jkl = (dM_jk/dq_l + dM_jl/dq_k - dM_kl/dq_j)/2
        for (unsigned j = 0; j < n; ++j)
            for (unsigned k = 0; k < n; ++k) {
                result.mass(j, k) += hessian(j, k);
                for (unsigned l = 0; l < n; ++l)
                    result.coriolis[j] +=
                        (partial(hessian(j, k), q(l)) + partial(hessian(j, l), q(k)) - partial(hessian(k, l), q(j))) / 2 * qd(k) * qd(l);
            }
    }
    return result;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/statics_audit.hpp"

#include <fmt/format.h>

#include "elements/statics.hpp"
#include "elements/verdict.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// The worst of several comparisons under one name.
class WorstOf {
public:
    WorstOf(std::string name, Prover& prover) : entry_{std::move(name), {Verdict::proven}}, prover_(prover) {}
    void add(const ex& a, const ex& b) {
        Comparison one = prover_.equal(a, b);
        if (is_worse(one.verdict, entry_.result.verdict)) entry_.result = std::move(one);
    }
    AuditEntry take() { return std::move(entry_); }

private:
    AuditEntry entry_;
    Prover& prover_;
};

}  // namespace

std::vector<AuditEntry> compare_solids(const System& system, Prover& prover) {
    std::vector<AuditEntry> entries;
    for (const Solid* item : system.scene.solids) {
        const SolidProperties& solid = system.solids.of(item->name);
        if (!solid.primitives.empty()) {
            WorstOf primitives("integrals, " + item->name, prover);
            for (const Primitive& one : solid.primitives) primitives.add(partial(one.primitive, one.variable), one.function);
            entries.push_back(primitives.take());
        }
        WorstOf placed("Steiner, " + item->name, prover);
        placed.add(solid.mass, solid.direct.mass);
        const SpaceMatrix& second = solid.direct.second;
        const SpaceMatrix moved = inertia_of_point(solid.mass, solid.centre);
        for (std::size_t i = 0; i < 3; ++i) {
            placed.add(solid.mass * solid.centre[i], solid.direct.first[i]);
            for (std::size_t j = i; j < 3; ++j) {
                const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
                const ex direct = i == j ? ex(second[k][k] + second[l][l]) : ex(-second[i][j]);
                placed.add(solid.about_origin[i][j], direct);
                placed.add(solid.about_centre[i][j], direct - moved[i][j]);
            }
        }
        entries.push_back(placed.take());
    }
    return entries;
}

std::vector<AuditEntry> compare_loads(const System& system, Prover& prover) {
    std::vector<AuditEntry> entries;
    for (const Load* item : system.scene.loads) {
        if (item->unknowns.empty()) continue;
        const LoadSolution& load = system.load(item->name, item->span);
        WorstOf balances("equilibrium, " + item->name, prover);
        const std::vector<LoadBody> bodies = load_bodies(*item);
        for (std::size_t body = 0; body < bodies.size(); ++body)
            for (std::size_t i = 0; i < bodies[body].balances(); ++i) {
                // The last one on the other side, so that numbers can tell where nothing is proven.
                ex sum = 0, last = 0;
                for (const LoadShare& share : load.shares) {
                    const ex& one = i < 3 ? share.force[i] : share.moment[i - 3];
                    if (share.body != body || one.is_zero()) continue;
                    sum += last;
                    last = one;
                }
                balances.add(sum, -last);
            }
        entries.push_back(balances.take());
    }
    return entries;
}

}  // namespace dalembert

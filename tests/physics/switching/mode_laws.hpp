// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for every generated system that switches: derivatives in each of its modes, the rates of guards along the motion, and
// runs from random start values, over which energy minus supplied work never rises.
#pragma once

#include "dalembert/one_mode.hpp"
#include "physics/laws.hpp"
#include "plants/plant_of.hpp"

/// dg/dt in the header against differences of the guards along the motion, in 50 digits. With inputs held.
template <template <class> class System>
void guard_laws() {
    using Real = System<double>;
    using Twin = System<Digits50>;
    const Real system;
    const Twin twin;
    const Digits50 share("1e-17");
    std::mt19937 engine(1743);
    for (std::size_t m = 0; m < Real::mode_table().size(); ++m) {
        const auto mode = static_cast<typename Real::Mode>(m);
        for (int repetition = 0; repetition < 10; ++repetition) {
            const auto point = random_point(system, engine);
            INFO(Real::mode_table()[m], ", repetition ", repetition);
            typename Real::Events rates{};
            system.guard_rates(mode, point.x, point.u, point.t, rates);
            const auto x = converted<typename Twin::State>(point.x);
            const auto u = converted<typename Twin::Input>(point.u);
            const Digits50 t = point.t;
            typename Twin::State dxdt;
            twin.rhs(mode, x, u, t, dxdt);
            const auto at = [&](const Digits50& h) {
                auto moved = x;
                for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += h * dxdt[i];
                typename Twin::Events g{};
                twin.guards(mode, moved, u, t + h, g);
                return g;
            };
            const auto ahead = at(share), behind = at(-share), here = at(0);
            for (std::size_t e = 0; e < rates.size(); ++e) {
                if (!Real::is_watched(mode, e)) continue;
                const auto rate = static_cast<double>(Digits50((ahead[e] - behind[e]) / (2 * share)));
                // What is made of parts that cancel is as good as its parts, whose size is that of the guard itself at least.
                const double size = std::abs(rate) + std::abs(static_cast<double>(here[e])) + 1e-30;
                INFO(Real::event_table()[e]);
                CHECK(std::abs(rates[e] - rate) <= 1e-11 * size);
            }
        }
    }
}

/// Runs of a plant that switches from random start values, with random constant inputs. A run may end by an event that ends it, or at the
/// limit of a model; that it is stopped by something else is a defect. `fewest`: of how many runs at least a mode must accept the start.
void energy_laws(const dalembert_plant& plant, double until, int runs, int fewest);

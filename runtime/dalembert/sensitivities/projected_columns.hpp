// SPDX-License-Identifier: BSL-1.0
// Sensitivities brought back to what constraints hold, as their state is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dalembert/constraints.hpp"
#include "dalembert/sensitivities/differences.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The derivative of project() along the column c of S, at a state x that meets the constraints: positions f and rates w stay zero for
/// what is varied, f_x S + f_p = 0. Residuals are differences; they correct only what steps have let drift. `at` is the place of x.
/// has_kink(ahead, behind) says whether one lies between two states: a step that ends there is left as it is, for a difference across it is
/// that of neither side.
template <class System, class List, class HasKink, class... Mode>
void bring_back(const System& system, const DifferencesAt<System, List>& at, std::size_t c, const typename System::State& x,
                const typename System::scalar_type& t, typename System::State& s, const HasKink& has_kink, Mode... mode) {
    using Scalar = typename System::scalar_type;
    using Constraints = typename System::Constraints;
    using Generalised = typename System::Generalised;
    if constexpr (may_have_entries<Constraints>) {
        if (size_of<Constraints>() == 0) return;
        // Longer steps than for guards: rounding counts the less, and constraints are smooth but for their kinks.
        constexpr int longer = 4;
        const auto crosses = [&](const System&, const auto& ahead, const Scalar&, const System&, const auto& behind, const Scalar&,
                                 const Scalar&) { return has_kink(ahead, behind); };
        if (at.along(c, s, Scalar(0), crosses, Scalar(longest_of_order_four * longer))) return;
        // The larger part is exact where each coordinate has a velocity: by differences, rounding would count as much as in many turns.
        const bool is_exact = holds_positions<System>();
        const std::size_t m = size_of<Constraints>(), n = size_of<Generalised>();
        typename System::ConstraintJacobian A{};
        if (is_exact) system.constraint_jacobian(mode..., x, t, A);
        const auto step_of = [&](const auto& values, std::size_t place) {
            const auto central = [&](const System& a, const auto& ahead, const Scalar&, const System& b, const auto& behind, const Scalar&,
                                     const Scalar& step) {
                Constraints r{}, other{};
                values(a, ahead, r);
                values(b, behind, other);
                for (std::size_t i = 0; i < r.size(); ++i) r[i] = (r[i] - other[i]) / (Scalar(2) * step);
                return r;
            };
            typename System::State along = s;
            for (std::size_t j = place; is_exact && j < place + n; ++j) along[j] = Scalar(0);
            if (is_exact && place == 0)
                for (std::size_t j = 0; j < n; ++j) along[System::velocity_place + j] = Scalar(0);  // positions do not see them
            Constraints residual =
                of_order_four<Scalar>([&](const Scalar& times) { return at.along(c, along, Scalar(0), central, Scalar(longer) * times); });
            for (std::size_t i = 0; is_exact && i < m; ++i)
                for (std::size_t j = 0; (place > 0 || System::constraint_table()[i].has_position) && j < n; ++j)
                    residual[i] += A[j * m + i] * s[place + j];
            Generalised step{};
            system.correction(mode..., x, t, residual, step);
            return step;
        };
        const auto positions = [&](const System& of, const auto& there, Constraints& f) { of.constraint_positions(mode..., there, t, f); };
        const Generalised d = step_of(positions, 0);
        if (const Scalar longest = largest(d); longest > Scalar(0)) {
            // Coordinates by the step itself, attitudes by how they turn: linear in it.
            const Scalar length = Scalar(1) / Scalar(1024) / longest;
            typename System::State ahead = x, behind = x;
            Generalised forth = d, back = d;
            for (std::size_t j = 0; j < d.size(); ++j) forth[j] = length * d[j], back[j] = -length * d[j];
            system.move_back(ahead, forth);
            system.move_back(behind, back);
            for (std::size_t i = 0; i < s.size(); ++i) s[i] += (ahead[i] - behind[i]) / (Scalar(2) * length);
        }
        const auto rates = [&](const System& of, const auto& there, Constraints& w) { of.constraint_rates(mode..., there, t, w); };
        const Generalised e = step_of(rates, System::velocity_place);
        for (std::size_t j = 0; j < e.size(); ++j) s[System::velocity_place + j] -= e[j];
    }
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

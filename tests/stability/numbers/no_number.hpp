// SPDX-License-Identifier: GPL-3.0-or-later
// What is no number, infinite, denormal or huge, at every position of states, inputs, time and parameters: every function of a header returns,
// without undefined behaviour (the tests are compiled so that this ends them), and hands on what is not a number; runs stop with a word.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "dalembert/scales.hpp"

namespace no_numbers {

template <class Scalar>
std::vector<Scalar> strange() {
    using Limits = std::numeric_limits<Scalar>;
    return {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::denorm_min(), -Limits::denorm_min(), Limits::max(), Limits::lowest(), Limits::min(), Scalar(0), -Scalar(0)};
}

/// The arguments of all functions; parameters as the plain numbers that they are.
template <template <class> class SystemOf, template <class> class ParametersOf, class Scalar>
struct Arguments {
    using System = SystemOf<Scalar>;
    using Parameters = ParametersOf<Scalar>;
    static constexpr std::size_t states = std::tuple_size<typename System::State>::value;
    static constexpr std::size_t inputs = std::tuple_size<typename System::Input>::value;
    static constexpr std::size_t parameters = std::is_empty<Parameters>::value ? 0 : sizeof(Parameters) / sizeof(Scalar);
    static constexpr std::size_t count = states + inputs + 1 + parameters;

    typename System::State x = System().start_state();
    typename System::Input u{};
    Scalar t = 0;
    Parameters p{};

    void set(std::size_t i, Scalar value) {
        if (i < states) x[i] = value;
        else if (i < states + inputs) u[i - states] = value;
        else if (i == states + inputs) t = value;
        else std::memcpy(reinterpret_cast<unsigned char*>(&p) + (i - states - inputs - 1) * sizeof(Scalar), &value, sizeof value);
    }
};

/// Calls everything that a header has, in one mode where it has some.
template <class System, class... Mode>
typename System::State call_all(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t, Mode... mode) {
    typename System::State rate{}, same{};
    typename System::JacobianX J{};
    typename System::JacobianU Ju{};
    typename System::JacobianP Jp{};
    typename System::JacobianT Jt{};
    typename System::MassMatrix M{};
    typename System::Generalised b{}, Q{};
    typename System::Output y{};
    typename System::OutputJacobianX C{};
    typename System::OutputJacobianU D{};
    system.rhs(mode..., x, u, t, rate);
    system.rhs_and_jacobian(mode..., x, u, t, same, J);
    system.jacobian_u(mode..., x, u, t, Ju);
    system.jacobian_p(mode..., x, u, t, Jp);
    system.jacobian_t(mode..., x, u, t, Jt);
    system.mass_matrix(mode..., x, t, M);
    system.bias(mode..., x, u, t, b);
    system.generalised_force(mode..., x, u, t, Q);
    system.output(mode..., x, u, t, y);
    system.output_jacobian_x(mode..., x, u, t, C);
    system.output_jacobian_u(mode..., x, u, t, D);
    (void)(system.kinetic_energy(mode..., x, t) + system.potential_energy(mode..., x, t) + system.internal_energy(mode..., x, t) + system.supplied_power(mode..., x, u, t) + system.dissipated_power(mode..., x, u, t) +
           system.prescribed_power(mode..., x, u, t) + system.exchanged_power(mode..., x, u, t));
    if constexpr (dalembert::detail::needs_projection<System>) {
        typename System::Constraints f{};
        system.constraint_positions(mode..., x, t, f);
    }
    if constexpr (sizeof...(Mode) == 0) {
        typename System::Guards g{};
        system.guards(x, u, t, g);
    } else {
        typename System::Events g{}, rates{};
        typename System::Kinks k{};
        system.guards(mode..., x, u, t, g);
        system.guard_rates(mode..., x, u, t, rates);
        system.kinks(mode..., x, u, t, k);
        (void)system.holds(mode..., x, u, t);
        for (std::size_t e = 0; e < g.size(); ++e) {
            typename System::State moved = x;
            system.reset(e, mode..., moved, u, t);
            moved = x;
            system.settle(e, mode..., moved, u, t);
        }
    }
    return rate;
}

template <class System, class Call>
void in_each_mode(const Call& call) {
    if constexpr (dalembert::detail::is_switching<System>) {
        constexpr std::size_t modes = std::tuple_size<std::decay_t<decltype(System::mode_table())>>::value;
        for (std::size_t m = 0; m < modes; ++m) call(static_cast<typename System::Mode>(m));
    } else {
        call();
    }
}

/// d(rhs[row])/d(x[column]) from the header, in whatever way it is stored.
template <class System>
typename System::scalar_type entry(const typename System::JacobianX& J, std::size_t row, std::size_t column) {
    typename System::scalar_type found = 0;
    dalembert::detail::for_each_in_column<typename System::PatternX>(J, std::tuple_size<typename System::State>::value, column, [&](std::size_t r, const auto& value) {
        if (r == row) found = value;
    });
    return found;
}

template <template <class> class SystemOf, template <class> class ParametersOf, class Scalar>
void functions() {
    using All = Arguments<SystemOf, ParametersOf, Scalar>;
    using System = typename All::System;
    std::size_t handed_on = 0;
    bool depends = false;  // a rate on a state, found without the Jacobian
    for (std::size_t i = 0; i < All::count; ++i)
        for (const Scalar value : strange<Scalar>()) {
            All arguments;
            const System plain(arguments.p);
            const auto start = arguments.x;
            arguments.set(i, value);
            const System system(arguments.p);
            (void)system.start_state();
            in_each_mode<System>([&](auto... mode) {
                const auto rate = call_all(system, arguments.x, arguments.u, arguments.t, mode...);
                if (!std::isnan(value) || i >= All::states) return;
                // What the state has an effect on is no number either.
                typename System::State before{};
                typename System::JacobianX J{}, beside{};
                plain.rhs_and_jacobian(mode..., start, arguments.u, arguments.t, before, J);
                typename System::State moved = start, after{};
                moved[i] += Scalar(0.01) * (Scalar(1) + std::fabs(moved[i]));
                plain.rhs_and_jacobian(mode..., moved, arguments.u, arguments.t, after, beside);  // a slope may be zero at rest
                for (std::size_t r = 0; r < All::states; ++r) depends = depends || (std::isfinite(entry<System>(J, r, i)) && std::isfinite(before[r]) && std::isfinite(after[r]) && after[r] != before[r]);
                for (std::size_t r = 0; r < All::states; ++r) {
                    const Scalar at_start = entry<System>(J, r, i), effect = at_start == Scalar(0) ? entry<System>(beside, r, i) : at_start;
                    if (!std::isfinite(effect) || effect == Scalar(0) || !std::isfinite(before[r])) continue;
                    ++handed_on;
                    CHECK_MESSAGE(std::isnan(rate[r]), "state ", i, " is no number, the rate of ", r, " is ", rate[r]);
                }
            });
        }
    CHECK((handed_on > 0 || !depends));
}

/// From starts and with inputs and parameters that are no numbers: the run ends soon, what it has is finite where it says success, and a state that is
/// no number is named.
template <template <class> class SystemOf, template <class> class ParametersOf>
void runs() {
    using All = Arguments<SystemOf, ParametersOf, double>;
    using System = typename All::System;
    for (const dalembert::Method method : {dalembert::Method::automatic, dalembert::Method::rk4, dalembert::Method::rodas5p})
        for (std::size_t i = 0; i < All::count; ++i) {
            if (i == All::states + All::inputs) continue;  // time is that of the run
            for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
                All arguments;
                arguments.set(i, value);
                typename dalembert::detail::Running<System>::Options options;
                options.method = method;
                options.tolerance = 1e-4;
                options.step = method == dalembert::Method::rk4 ? 0.01 : 0;
                options.max_steps = 1000;
                options.max_events = 100;
                const System system(arguments.p);
                auto x = arguments.x;
                const auto result = dalembert::detail::Running<System>::run(system, [&](const auto&, double) { return arguments.u; }, x, 1.0, options, [](const auto&) {});
                const dalembert::Outcome& outcome = result.outcome;
                INFO("position ", i, ", value ", value, ", status ", std::string(dalembert::to_string(outcome.status)));
                if (outcome.status == dalembert::Status::success)
                    for (const double each : x) CHECK(std::isfinite(each));
                if (i >= All::states) continue;
                CHECK(outcome.status != dalembert::Status::success);
                if (outcome.status != dalembert::Status::not_finite || outcome.guard != dalembert::Outcome::none) continue;
                CHECK(outcome.state == i);
            }
        }
}

}  // namespace no_numbers

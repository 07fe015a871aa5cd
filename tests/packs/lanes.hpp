// SPDX-License-Identifier: GPL-3.0-or-later
// Each lane of a pack is what the same function gives for that lane alone. Both are as far from long double as rounding makes them; no
// other bound would hold for what cancels.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>

#include "dalembert/pack.hpp"
#include "dalembert/scales.hpp"

namespace lanes {

template <class To, class From, std::size_t n>
std::array<To, n> converted(const std::array<From, n>& x) {
    std::array<To, n> result;
    for (std::size_t i = 0; i < n; ++i) result[i] = static_cast<To>(x[i]);
    return result;
}

template <std::size_t n>
long double largest(const std::array<long double, n>& values) {
    long double size = 0;
    for (const long double value : values)
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
    return size;
}

/// How wrong the scalar is, relative to the largest entry.
template <class T, std::size_t n>
long double error_of(const std::array<T, n>& scalar, const std::array<long double, n>& precise) {
    long double error = 0;
    for (std::size_t i = 0; i < n; ++i)
        if (std::isfinite(scalar[i]) && std::isfinite(precise[i])) error = std::max(error, std::abs(static_cast<long double>(scalar[i]) - precise[i]));
    return error == 0 ? 0 : error / largest(precise);
}

/// A lane is as wrong as the scalar is in the worst lane, eight times, and sixteen units of the last place of the largest entry: where much
/// cancels, what one lane alone is off by is chance.
template <class T, std::size_t n>
void compare(const std::string& function, std::size_t lane, const std::array<T, n>& pack, const std::array<T, n>& scalar, const std::array<long double, n>& precise, long double worst) {
    const long double bound = (8 * worst + 16 * static_cast<long double>(std::numeric_limits<T>::epsilon())) * largest(precise);
    for (std::size_t i = 0; i < n; ++i) {
        CAPTURE(function);
        CAPTURE(lane);
        CAPTURE(i);
        if (!std::isfinite(scalar[i])) CHECK_FALSE(std::isfinite(pack[i]));
        else CHECK(std::abs(static_cast<long double>(pack[i]) - precise[i]) <= bound);
    }
}

/// A function of state, input and time that fills an array, in packs of T, in T and in long double; Call is given the system and its arguments.
template <template <class> class System, class T, class Call>
void same(const std::string& function, const Call& call) {
    using P = dalembert::WidestPack<T>;
    const System<T> scalar;
    const System<P> pack;
    const System<long double> precise;
    typename System<T>::Input u;
    u.fill(T(0.75));
    std::array<typename System<T>::State, P::size> x;
    std::array<typename System<T>::Input, P::size> inputs;
    inputs.fill(u);
    for (std::size_t point = 0; point < 8; ++point) {
        for (std::size_t lane = 0; lane < P::size; ++lane) {
            x[lane] = scalar.start_state();
            for (std::size_t i = 0; i < x[lane].size(); ++i) {
                const T step = T(std::sin(static_cast<double>(3 * i + 7 * point + 5 * lane + 1)));
                x[lane][i] = x[lane][i] == T(0) ? T(0.25) * step : x[lane][i] * (T(1) + T(0.0625) * step);
            }
        }
        const auto all = call(pack, dalembert::packed<P>(x), dalembert::packed<P>(inputs), P(T(0.5)));
        const auto alone = [&](std::size_t lane) { return call(scalar, x[lane], u, T(0.5)); };
        const auto exact = [&](std::size_t lane) { return call(precise, converted<long double>(x[lane]), converted<long double>(u), 0.5L); };
        long double worst = 0;
        for (std::size_t lane = 0; lane < P::size; ++lane) worst = std::max(worst, error_of(alone(lane), exact(lane)));
        for (std::size_t lane = 0; lane < P::size; ++lane) compare(function, lane, dalembert::lane_of(all, lane), alone(lane), exact(lane), worst);
    }
}

template <template <class> class System, class T, class... Mode>
void all_functions(Mode... mode) {
    same<System, T>("rhs", [&](const auto& system, const auto& x, const auto& u, const auto& t) {
        typename std::decay_t<decltype(system)>::State rate{};
        system.rhs(mode..., x, u, t, rate);
        return rate;
    });
    same<System, T>("jacobian_x", [&](const auto& system, const auto& x, const auto& u, const auto& t) {
        typename std::decay_t<decltype(system)>::State rate{};
        typename std::decay_t<decltype(system)>::JacobianX J{};
        system.rhs_and_jacobian(mode..., x, u, t, rate, J);
        return J;
    });
    same<System, T>("jacobian_p", [&](const auto& system, const auto& x, const auto& u, const auto& t) {
        typename std::decay_t<decltype(system)>::JacobianP J{};
        system.jacobian_p(mode..., x, u, t, J);
        return J;
    });
    same<System, T>("output", [&](const auto& system, const auto& x, const auto& u, const auto& t) {
        typename std::decay_t<decltype(system)>::Output y{};
        system.output(mode..., x, u, t, y);
        return y;
    });
}

/// In the first and the last mode, where there are modes.
template <template <class> class System>
void are_alone() {
    if constexpr (dalembert::detail::is_switching<System<double>>) {
        using Mode = typename System<double>::Mode;
        for (const std::size_t m : {std::size_t(0), std::tuple_size<std::decay_t<decltype(System<double>::mode_table())>>::value - 1}) {
            all_functions<System, double>(static_cast<Mode>(m));
            all_functions<System, float>(static_cast<Mode>(m));
        }
    } else {
        all_functions<System, double>();
        all_functions<System, float>();
    }
}

}  // namespace lanes

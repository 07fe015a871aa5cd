// SPDX-License-Identifier: GPL-3.0-or-later
// One header in four arithmetics: what float, double and long double return lies as near to 50 digits as their own precision
// lets expect, and the power balance holds to the last of the 50.
#pragma once

#include <doctest/doctest.h>

#include <limits>
#include <random>
#include <vector>

#include "dalembert/matrices.hpp"
#include "physics/laws.hpp"

/// max |a - b| / max |b|, in units of the last place of Scalar; Scalar is the type of a.
template <class Result, class Reference>
double error_in_ulp(const Result& a, const Reference& b) {
    Digits50 difference = 0;
    Digits50 size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!isfinite(Digits50(a[i])) || !isfinite(b[i])) return std::numeric_limits<double>::infinity();
        difference = std::max<Digits50>(difference, abs(Digits50(a[i]) - b[i]));
        size = std::max<Digits50>(size, abs(b[i]));
    }
    if (size == 0) return difference == 0 ? 0 : std::numeric_limits<double>::infinity();
    return static_cast<double>(difference / size / std::numeric_limits<typename Result::value_type>::epsilon());
}

/// Parameters that are numbers of float, so that every arithmetic has the same machine before it.
template <template <class> class Parameters, class Scalar>
Parameters<Scalar> float_parameters() {
    const Parameters<float> rounded;
    Parameters<Scalar> result;
    constexpr std::size_t count = sizeof(Parameters<float>) / sizeof(float);
    static_assert(sizeof(Parameters<Scalar>) == count * sizeof(Scalar), "parameters are stored one after the other");
    if constexpr (!std::is_empty_v<Parameters<float>>)
        for (std::size_t i = 0; i < count; ++i)
            reinterpret_cast<Scalar*>(&result)[i] = static_cast<Scalar>(reinterpret_cast<const float*>(&rounded)[i]);
    return result;
}

/// f and its Jacobians in Scalar, against 50 digits: units of the last place, divided by the condition of f where that is above 1.
template <class Scalar, template <class> class System, template <class> class Parameters>
void check_precision(double allowed) {
    const System<Scalar> system(float_parameters<Parameters, Scalar>());
    const System<Digits50> exact(float_parameters<Parameters, Digits50>());
    std::mt19937 engine(1743);
    for (int repetition = 0; repetition < 5; ++repetition) {
        const auto [start, drive, time] = random_point(System<double>(), engine);
        const auto x = converted<typename System<Scalar>::State>(start);
        const auto u = converted<typename System<Scalar>::Input>(drive);
        const auto X = converted<typename System<Digits50>::State>(start);
        const auto U = converted<typename System<Digits50>::Input>(drive);
        const auto t = static_cast<Scalar>(time);
        const Digits50 T = time;
        typename System<Scalar>::State f;
        typename System<Digits50>::State F;
        system.rhs(x, u, t, f);
        exact.rhs(X, U, T, F);
        const auto A = dalembert::jacobian_x(exact, X, U, T);
        const auto P = dalembert::jacobian_p(exact, X, U, T);

        // What f changes by, relative to its size, when every number that it is made from changes by its own share.
        Digits50 size = 0;
        for (const Digits50& v : F) size = std::max<Digits50>(size, abs(v));
        const auto values = exact.parameters();
        Digits50 condition = 1;
        for (Eigen::Index r = 0; r < A.rows() && size > 0; ++r) {
            Digits50 change = 0;
            for (Eigen::Index c = 0; c < A.cols(); ++c) change += abs(A(r, c) * X[static_cast<std::size_t>(c)]);
            for (Eigen::Index c = 0; c < P.cols(); ++c) change += abs(P(r, c) * reinterpret_cast<const Digits50*>(&values)[c]);
            condition = std::max<Digits50>(condition, change / size);
        }
        const double share = static_cast<double>(condition);
        const auto error = [&](const auto& computed, const auto& reference) {
            return error_in_ulp(std::vector<Scalar>(computed.data(), computed.data() + computed.size()),
                                std::vector<Digits50>(reference.data(), reference.data() + reference.size())) / share;
        };
        CAPTURE(repetition);
        CAPTURE(std::numeric_limits<Scalar>::digits);
        CHECK(error(f, F) <= allowed);
        CHECK(error(dalembert::jacobian_x(system, x, u, t), A) <= allowed);
        CHECK(error(dalembert::jacobian_p(system, x, u, t), P) <= allowed);
    }
}

/// d(T + V + E)/dt along the motion, by differences in 50 digits, is what is supplied, dissipated, prescribed and exchanged.
template <template <class> class System>
void check_power_balance() {
    const System<Digits50> system;
    std::mt19937 engine(1758);
    for (int repetition = 0; repetition < 5; ++repetition) {
        const auto [start, drive, time] = random_point(System<double>(), engine);
        auto x = converted<typename System<Digits50>::State>(start);
        const auto u = converted<typename System<Digits50>::Input>(drive);
        const Digits50 t = time;
        put_on_constraints(system, x, t);
        typename System<Digits50>::State f;
        system.rhs(x, u, t, f);
        const auto energy = [&](const Digits50& h) {
            auto moved = x;
            for (std::size_t i = 0; i < x.size(); ++i) moved[i] += h * f[i];
            return Digits50(system.kinetic_energy(moved, t + h) + system.potential_energy(moved, t + h) + system.internal_energy(moved, t + h));
        };
        const Digits50 h("1e-17");
        const Digits50 change = (energy(h) - energy(-h)) / (2 * h);
        const Digits50 power = system.supplied_power(x, u, t) - system.dissipated_power(x, u, t) + system.prescribed_power(x, u, t) + system.exchanged_power(x, u, t);
        Digits50 size = abs(energy(0)) + abs(power);
        for (const Digits50& v : f) size += abs(v);
        CHECK(static_cast<double>(abs(change - power) / size) < 1e-27);
    }
}

template <template <class> class System, template <class> class Parameters>
void precision() {
    constexpr double ulps = 300;
    check_precision<float, System, Parameters>(ulps);
    check_precision<double, System, Parameters>(ulps);
    check_precision<long double, System, Parameters>(ulps);
    check_power_balance<System>();
}

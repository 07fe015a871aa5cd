// SPDX-License-Identifier: GPL-3.0-or-later
// On the desk: the points at which a system is evaluated. Parameters, states and inputs are numbers of float, so that the board and the
// reference in long double have the same machine before them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <type_traits>
#include <vector>

#include "dalembert/constraints.hpp"
#include "points.hpp"

inline constexpr std::size_t point_count = 16;

/// The values in another arithmetic, exactly or rounded.
template <class To, class From>
To converted(const From& values) {
    To result{};
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<typename To::value_type>(values[i]);
    return result;
}

template <class Scalar, template <class> class Parameters>
Parameters<Scalar> float_parameters() {
    const Parameters<float> rounded;
    Parameters<Scalar> result;
    constexpr std::size_t count = sizeof(Parameters<float>) / sizeof(float);
    static_assert(count == 0 || sizeof(Parameters<Scalar>) == count * sizeof(Scalar), "parameters are stored one after the other");
    for (std::size_t i = 0; i < count && !std::is_empty_v<Parameters<float>>; ++i) {
        float value;
        std::memcpy(&value, reinterpret_cast<const char*>(&rounded) + i * sizeof(float), sizeof value);
        const auto wide = static_cast<Scalar>(value);
        std::memcpy(reinterpret_cast<char*>(&result) + i * sizeof(Scalar), &wide, sizeof wide);
    }
    return result;
}

/// Puts a state on the constraints; whether that went well.
template <class System>
bool meets_constraints(const System& system, typename System::State& x, double t) {
    if constexpr (dalembert::detail::needs_projection<System>) return dalembert::project(system, x, t).are_met();
    else return true;
}

/// In the middle eight tenths of the declared range, else around the start value; angles over the whole turn about zero, since sinf and
/// cosf take the longer the farther from there; on the constraints, where there are some. Each quantity comes once into each sixteenth of
/// its interval, so that means do not depend on luck.
template <template <class> class System, template <class> class Parameters>
std::vector<Point<System<float>>> points() {
    const System<double> system(float_parameters<double, Parameters>());
    std::minstd_rand engine(1743);  // the same numbers in every library
    double reach = 1;
    const auto value = [&](const auto& quantity, double start, std::size_t point, std::size_t number) {
        const double place = static_cast<double>(point * (2 * number + 1) % point_count) + static_cast<double>(engine()) / 2147483647.0;
        const double share = 0.8 * reach * (place / static_cast<double>(point_count) - 0.5);
        if (std::isfinite(quantity.low) && std::isfinite(quantity.high)) return quantity.low + (quantity.high - quantity.low) * (0.5 + share);
        if (!dalembert::detail::needs_projection<System<double>> && std::strcmp(quantity.unit, "rad") == 0) return 2.5 * 3.14159 * share;
        return start + std::max(std::abs(start), 1.0) * share;
    };
    std::vector<Point<System<float>>> result(point_count);
    for (std::size_t k = 0; k < point_count; ++k) {
        auto& point = result[k];
        auto x = system.start_state();
        typename System<double>::Input u{};
        // Where constraints cannot be met, nearer to the start.
        for (int attempt = 1; attempt <= 20; ++attempt) {
            reach = 1.0 / attempt;
            x = system.start_state();
            for (std::size_t i = 0; i < x.size(); ++i) x[i] = value(System<double>::state_table()[i], x[i], k, i);
            for (std::size_t i = 0; i < u.size(); ++i) u[i] = value(System<double>::input_table()[i], 0.0, k, x.size() + i);
            point.t = static_cast<float>(engine()) / 2147483647.0F;
            if (meets_constraints(system, x, static_cast<double>(point.t))) break;
        }
        point.x = converted<typename System<float>::State>(x);
        point.u = converted<typename System<float>::Input>(u);
        point.mode = 0;
        if constexpr (has_modes<System<float>>) point.mode = static_cast<unsigned>(k % System<float>::mode_table().size());
    }
    return result;
}

template <class Values>
void print_values(const Values& values) {
    std::printf("{");
    for (const float value : values) std::printf("%aF,", static_cast<double>(value));
    std::printf("}, ");
}

/// The points as C++, to be compiled for the board.
template <template <class> class System, template <class> class Parameters>
void print_points(const char* name_space) {
    std::printf("constexpr Point<%s::System<float>> table[] = {\n", name_space);
    for (const auto& point : points<System, Parameters>()) {
        std::printf("    {%u, ", point.mode);
        print_values(point.x);
        print_values(point.u);
        std::printf("%aF},\n", static_cast<double>(point.t));
    }
    std::printf("};\n");
}

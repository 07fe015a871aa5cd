// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for every generated system, at random states. The oracles share nothing with the generator: differences in 50 digits
// for derivatives, the definition of the equations of motion, the chain rule for energies.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "dalembert/constraints.hpp"
#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/matrices.hpp"

/// Without expression templates: compiled in half the time.
using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Where the velocities begin in x.
template <class System>
constexpr std::size_t first_velocity() {
    if constexpr (dalembert::detail::needs_projection<System>) return System::velocity_place;
    else return System::degrees;
}

/// Laws of motion hold where constraints do.
template <class System>
void put_on_constraints(const System& system, typename System::State& x, const typename System::scalar_type& t) {
    if constexpr (dalembert::detail::needs_projection<System>) CHECK(dalembert::project(system, x, t).are_met());
}

/// Values in the declared ranges, else near the start state; numbers of float, so that every arithmetic has the same.
template <class System>
struct RandomPoint {
    typename System::State x;
    typename System::Input u;
    double t;
};

template <class System>
RandomPoint<System> random_point(const System& system, std::mt19937& engine) {
    std::uniform_real_distribution<double> distribution(-0.4, 0.4);
    const auto value = [&](const auto& quantity, double start) {
        const double share = distribution(engine);
        double result = start + (start != 0 ? std::abs(start) : 1.0) * (share + 0.05);
        if (std::isfinite(quantity.low) && std::isfinite(quantity.high)) {
            // In the middle of the range; over decades where it spans many.
            const bool is_wide = quantity.low > 0 && quantity.high > 30 * quantity.low;
            const double low = is_wide ? std::log(quantity.low) : quantity.low;
            const double high = is_wide ? std::log(quantity.high) : quantity.high;
            result = low + (high - low) * (0.5 + share);
            if (is_wide) result = std::exp(result);
        }
        return static_cast<double>(static_cast<float>(result));
    };
    RandomPoint<System> point{system.start_state(), {}, 0};
    struct Unbounded {
        double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    };
    point.t = value(Unbounded{}, 1.0);
    for (std::size_t i = 0; i < point.x.size(); ++i) point.x[i] = value(System::state_table()[i], point.x[i]);
    for (std::size_t i = 0; i < point.u.size(); ++i) point.u[i] = value(System::input_table()[i], 0.0);
    put_on_constraints(system, point.x, point.t);
    return point;
}

/// The same numbers in another arithmetic, exactly.
template <class To, class From>
To converted(const From& values) {
    To result{};
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<typename To::value_type>(values[i]);
    return result;
}

/// Norm-wise: largest difference of the derivatives a and b of f by x, relative to the largest entry of the column. A relative error of
/// x changes f by x df/dx: what is small beside f is nothing.
template <class F, class X>
double column_error(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const F& f, const X& x) {
    if (!a.allFinite() || !b.allFinite()) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const auto& value : f) largest = std::max(largest, std::abs(static_cast<double>(value)));
    double worst = 0;
    for (Eigen::Index c = 0; c < a.cols(); ++c) {
        const double share = largest / std::max(std::abs(static_cast<double>(x[static_cast<std::size_t>(c)])), 1e-300);
        const double size = std::max({a.col(c).lpNorm<Eigen::Infinity>(), b.col(c).lpNorm<Eigen::Infinity>(), share});
        if (size > 0) worst = std::max(worst, (a.col(c) - b.col(c)).template lpNorm<Eigen::Infinity>() / size);
    }
    return worst;
}

/// The Jacobians are derivatives, whatever the machine is.
/// A square matrix with zeros in place of what a header stores of it and does not say to be zero.
template <class Pattern>
Eigen::MatrixXd outside_pattern(Eigen::MatrixXd A) {
    const auto n = static_cast<std::size_t>(A.cols());
    const std::vector<double> values(n * n);
    for (std::size_t c = 0; c < n; ++c)
        dalembert::detail::for_each_in_column<Pattern>(
            values, n, c, [&](std::size_t row, double) { A(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c)) = 0; });
    return A;
}

template <template <class> class System, template <class> class Parameters>
void derivative_laws() {
    using Real = System<double>;
    using Twin = System<Digits50>;
    const Digits50 share("1e-17");  // of central differences: their error is its square
    const Real system;
    const Twin twin;
    constexpr std::size_t states = std::tuple_size<typename Real::State>::value;
    constexpr std::size_t inputs = std::tuple_size<typename Real::Input>::value;

    const auto step = [&](const Digits50& value) { return Digits50(share * (abs(value) > 0 ? Digits50(abs(value)) : Digits50(1))); };
    /// d(function)/d(argument[c]) as a column, by a central difference.
    const auto column = [&](const auto& function, auto argument, std::size_t c) {
        const Digits50 middle = argument[c];
        const Digits50 h = step(middle);
        argument[c] = middle + h;
        const auto above = function(argument);
        argument[c] = middle - h;
        const auto below = function(argument);
        Eigen::VectorXd result(static_cast<Eigen::Index>(above.size()));
        for (std::size_t i = 0; i < above.size(); ++i)
            result[static_cast<Eigen::Index>(i)] = static_cast<double>((above[i] - below[i]) / (2 * h));
        return result;
    };

    /// d(function)/d(state) and d(function)/d(input), column by column.
    const auto derivatives = [&](const auto& function, const auto& point) {
        const auto x = converted<typename Twin::State>(point.x);
        const auto u = converted<typename Twin::Input>(point.u);
        const auto rows = static_cast<Eigen::Index>(function(x, u).size());
        std::pair<Eigen::MatrixXd, Eigen::MatrixXd> result{Eigen::MatrixXd(rows, states), Eigen::MatrixXd(rows, inputs)};
        for (std::size_t c = 0; c < states; ++c)
            result.first.col(static_cast<Eigen::Index>(c)) = column([&](const auto& z) { return function(z, u); }, x, c);
        for (std::size_t c = 0; c < inputs; ++c)
            result.second.col(static_cast<Eigen::Index>(c)) = column([&](const auto& v) { return function(x, v); }, u, c);
        return result;
    };

    std::mt19937 engine(20130402);
    for (int repetition = 0; repetition < 10; ++repetition) {
        const auto point = random_point(system, engine);
        CAPTURE(repetition);
        typename Real::State dxdt;
        system.rhs(point.x, point.u, point.t, dxdt);

        {
            INFO("the Jacobians are the derivatives of the right-hand side");
            const auto at_time = [&](const auto& z, const auto& v, const Digits50& t) {
                typename Twin::State dzdt;
                twin.rhs(z, v, t, dzdt);
                return dzdt;
            };
            const auto rhs = [&](const auto& z, const auto& v) { return at_time(z, v, point.t); };
            const auto [A, B] = derivatives(rhs, point);
            CHECK(column_error(dalembert::jacobian_x(system, point.x, point.u, point.t), A, dxdt, point.x) <= 1e-12);
            CHECK(column_error(dalembert::jacobian_u(system, point.x, point.u, point.t), B, dxdt, point.u) <= 1e-12);
            const Eigen::MatrixXd outside = outside_pattern<typename Real::PatternX>(A);
            CHECK(outside.norm() <= 1e-25 * A.norm());
            typename Real::State again;
            typename Real::JacobianX J;
            system.rhs_and_jacobian(point.x, point.u, point.t, again, J);
            for (std::size_t i = 0; i < states; ++i) CHECK(again[i] == doctest::Approx(dxdt[i]).epsilon(1e-12));

            typename Real::JacobianT Jt;
            system.jacobian_t(point.x, point.u, point.t, Jt);
            const auto x = converted<typename Twin::State>(point.x);
            const auto u = converted<typename Twin::Input>(point.u);
            const auto by_time = column([&](const auto& t) { return at_time(x, u, t[0]); }, std::array<Digits50, 1>{point.t}, 0);
            CHECK(column_error(Eigen::Map<const Eigen::VectorXd>(Jt.data(), static_cast<Eigen::Index>(states)), by_time, dxdt,
                               std::array<double, 1>{point.t}) <= 1e-12);
        }

        {
            INFO("the Jacobian by parameters");
            constexpr std::size_t count = Real::parameter_table().size();
            static_assert(sizeof(Parameters<Digits50>) == count * sizeof(Digits50), "parameters are stored one after the other");
            Eigen::MatrixXd P(states, count);
            const auto x = converted<typename Twin::State>(point.x);
            const auto u = converted<typename Twin::Input>(point.u);
            std::array<Digits50, count> defaults;
            for (std::size_t c = 0; c < count; ++c) defaults[c] = reinterpret_cast<const Digits50*>(&twin.parameters())[c];
            const auto with = [&](const auto& values) {
                Parameters<Digits50> parameters;
                for (std::size_t c = 0; c < count; ++c) reinterpret_cast<Digits50*>(&parameters)[c] = values[c];
                typename Twin::State dzdt;
                Twin(parameters).rhs(x, u, point.t, dzdt);
                return dzdt;
            };
            for (std::size_t c = 0; c < count; ++c) P.col(static_cast<Eigen::Index>(c)) = column(with, defaults, c);
            CHECK(column_error(dalembert::jacobian_p(system, point.x, point.u, point.t), P, dxdt, defaults) <= 1e-12);
        }

        {
            INFO("the Jacobians of the outputs");
            const auto output = [&](const auto& z, const auto& v) {
                typename Twin::Output y;
                twin.output(z, v, point.t, y);
                return y;
            };
            const auto [C, D] = derivatives(output, point);
            typename Real::Output y;
            system.output(point.x, point.u, point.t, y);
            CHECK(column_error(dalembert::output_jacobian_x(system, point.x, point.u, point.t), C, y, point.x) <= 1e-12);
            CHECK(column_error(dalembert::output_jacobian_u(system, point.x, point.u, point.t), D, y, point.u) <= 1e-12);
        }
    }
}

template <template <class> class System, template <class> class Parameters>
void laws() {
    using Real = System<double>;
    using Twin = System<Digits50>;
    constexpr std::size_t n = Real::degrees, v = first_velocity<Real>();
    const Digits50 share("1e-17");  // of central differences: their error is its square
    const Real system;
    const Twin twin;
    constexpr std::size_t states = std::tuple_size<typename Real::State>::value;

    const auto step = [&](const Digits50& value) { return Digits50(share * (abs(value) > 0 ? Digits50(abs(value)) : Digits50(1))); };
    std::mt19937 engine(20130402);
    for (int repetition = 0; repetition < 10; ++repetition) {
        const auto point = random_point(system, engine);
        CAPTURE(repetition);
        typename Real::State dxdt;
        system.rhs(point.x, point.u, point.t, dxdt);

        {
            INFO("dq/dt is the velocity, and M qdd + bias = Q + A' lambda");
            typename Real::MassMatrix M;
            typename Real::Generalised bias, Q;
            system.mass_matrix(point.x, point.t, M);
            system.bias(point.x, point.u, point.t, bias);
            system.generalised_force(point.x, point.u, point.t, Q);
            std::array<double, n> held{}, held_size{};
            if constexpr (dalembert::detail::needs_projection<Real>) {
                typename Real::Constraints force{};
                typename Real::ConstraintJacobian A{};
                system.constraint_forces(point.x, point.u, point.t, force);
                system.constraint_jacobian(point.x, point.t, A);
                for (std::size_t j = 0; j < n; ++j)
                    for (std::size_t i = 0; i < force.size(); ++i) {
                        held[j] += A[j * force.size() + i] * force[i];
                        held_size[j] += std::abs(A[j * force.size() + i] * force[i]);
                    }
            }
            for (std::size_t i = 0; i < v; ++i) CHECK(dxdt[i] == point.x[v + i]);
            for (std::size_t i = 0; i < n; ++i) {
                double left = bias[i] - held[i];
                double size = std::abs(bias[i]) + std::abs(Q[i]) + held_size[i];
                for (std::size_t j = 0; j < n; ++j) {
                    CHECK(M[j * n + i] == M[i * n + j]);
                    left += M[j * n + i] * dxdt[v + j];
                    size += std::abs(M[j * n + i] * dxdt[v + j]);
                }
                CHECK(std::abs(left - Q[i]) <= 1e-12 * size);
            }
        }

        {
            INFO("the kinetic energy is qd' M qd / 2, and M is positive definite");
            typename Real::MassMatrix M;
            system.mass_matrix(point.x, point.t, M);
            double energy = 0;
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) energy += M[j * n + i] * point.x[v + i] * point.x[v + j] / 2;
            CHECK(system.kinetic_energy(point.x, point.t) == doctest::Approx(energy).epsilon(1e-12));
            const Eigen::MatrixXd matrix =
                Eigen::Map<const Eigen::MatrixXd>(M.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
            CHECK(matrix.llt().info() == Eigen::Success);
        }

        {
            INFO("d(T + V + E)/dt = supplied - dissipated + prescribed + exchanged");
            auto x = converted<typename Twin::State>(point.x);
            put_on_constraints(twin, x, Digits50(point.t));
            const auto energy = [&](const auto& z, const Digits50& t) {
                return Digits50(twin.kinetic_energy(z, t) + twin.potential_energy(z, t) + twin.internal_energy(z, t));
            };
            double change = 0;
            double size = 0;
            const auto add = [&](const Digits50& part) {
                change += static_cast<double>(part);
                size += std::abs(static_cast<double>(part));
            };
            for (std::size_t i = 0; i < states; ++i) {
                auto above = x;
                auto below = x;
                const Digits50 h = step(x[i]);
                above[i] += h;
                below[i] -= h;
                add((energy(above, point.t) - energy(below, point.t)) / (2 * h) * dxdt[i]);
            }
            add((energy(x, point.t + share) - energy(x, point.t - share)) / (2 * share));
            // The rate of change is that of the right-hand side in double; the power may be a small difference of large flows.
            const auto u = converted<typename Twin::Input>(point.u);
            const Digits50 t = point.t;
            const auto power = static_cast<double>(Digits50(twin.supplied_power(x, u, t) - twin.dissipated_power(x, u, t) +
                                                            twin.prescribed_power(x, u, t) + twin.exchanged_power(x, u, t)));
            CHECK(std::abs(change - power) <= 1e-12 * size + 1e-30);
            const double dissipated = system.dissipated_power(point.x, point.u, point.t);
            CHECK(dissipated >= 0);
        }

    }
    derivative_laws<System, Parameters>();
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for every generated system, at random states. The oracles share nothing with the generator: complex steps for
// derivatives, the definition of the equations of motion, the chain rule for energies.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <complex>
#include <random>

#include "dalembert/matrices.hpp"

/// Values near the start state and the defaults, away from special points.
template <class System>
struct RandomPoint {
    typename System::State x;
    typename System::Input u;
    double t;
};

template <class System>
RandomPoint<System> random_point(const System& system, std::mt19937& engine) {
    std::uniform_real_distribution<double> distribution(-0.4, 0.4);
    RandomPoint<System> point{system.start_state(), {}, 1.0 + distribution(engine)};
    for (std::size_t i = 0; i < point.x.size(); ++i) {
        const double scale = std::max(1.0, std::abs(point.x[i]));
        point.x[i] += scale * (distribution(engine) + 0.05);
    }
    for (double& u : point.u) u = 3 * distribution(engine);
    return point;
}

/// Norm-wise: largest difference relative to the largest entry of the column.
inline double column_error(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    if (!a.allFinite() || !b.allFinite()) return std::numeric_limits<double>::infinity();
    double worst = 0;
    for (Eigen::Index c = 0; c < a.cols(); ++c) {
        const double size = std::max(a.col(c).lpNorm<Eigen::Infinity>(), b.col(c).lpNorm<Eigen::Infinity>());
        if (size > 0) worst = std::max(worst, (a.col(c) - b.col(c)).template lpNorm<Eigen::Infinity>() / size);
    }
    return worst;
}

template <template <class> class System, template <class> class Parameters>
void laws() {
    using Complex = std::complex<double>;
    using Real = System<double>;
    using Twin = System<Complex>;
    constexpr std::size_t n = Real::degrees;
    constexpr double h = 1e-150;  // of complex steps: no cancellation, so as small as one likes
    const Real system;
    const Twin twin;
    constexpr std::size_t states = std::tuple_size<typename Real::State>::value;
    constexpr std::size_t inputs = std::tuple_size<typename Real::Input>::value;

    const auto complex_state = [](const auto& x) {
        typename Twin::State result;
        for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i];
        return result;
    };
    const auto complex_input = [](const auto& u) {
        typename Twin::Input result;
        for (std::size_t i = 0; i < u.size(); ++i) result[i] = u[i];
        return result;
    };
    /// Column of d(function)/d(variable) by a complex step.
    const auto column = [&](const auto& values) {
        Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[i].imag() / h;
        return result;
    };

    /// d(function)/d(state) and d(function)/d(input), column by column.
    const auto derivatives = [&](const auto& function, const auto& point) {
        const auto rows = static_cast<Eigen::Index>(function(complex_state(point.x), complex_input(point.u)).size());
        std::pair<Eigen::MatrixXd, Eigen::MatrixXd> result{Eigen::MatrixXd(rows, states), Eigen::MatrixXd(rows, inputs)};
        for (std::size_t c = 0; c < states; ++c) {
            auto z = complex_state(point.x);
            z[c] += Complex(0, h);
            result.first.col(static_cast<Eigen::Index>(c)) = column(function(z, complex_input(point.u)));
        }
        for (std::size_t c = 0; c < inputs; ++c) {
            auto v = complex_input(point.u);
            v[c] += Complex(0, h);
            result.second.col(static_cast<Eigen::Index>(c)) = column(function(complex_state(point.x), v));
        }
        return result;
    };

    std::mt19937 engine(20130402);
    for (int repetition = 0; repetition < 10; ++repetition) {
        const auto point = random_point(system, engine);
        CAPTURE(repetition);
        typename Real::State dxdt;
        system.rhs(point.x, point.u, point.t, dxdt);

        {
            INFO("dq/dt is the velocity, and M qdd + bias = Q");
            typename Real::MassMatrix M;
            typename Real::Generalised bias, Q;
            system.mass_matrix(point.x, point.t, M);
            system.bias(point.x, point.u, point.t, bias);
            system.generalised_force(point.x, point.u, point.t, Q);
            for (std::size_t i = 0; i < n; ++i) {
                CHECK(dxdt[i] == point.x[n + i]);
                double left = bias[i];
                double size = std::abs(bias[i]) + std::abs(Q[i]);
                for (std::size_t j = 0; j < n; ++j) {
                    CHECK(M[j * n + i] == M[i * n + j]);
                    left += M[j * n + i] * dxdt[n + j];
                    size += std::abs(M[j * n + i] * dxdt[n + j]);
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
                for (std::size_t j = 0; j < n; ++j) energy += M[j * n + i] * point.x[n + i] * point.x[n + j] / 2;
            CHECK(system.kinetic_energy(point.x, point.t) == doctest::Approx(energy).epsilon(1e-12));
            const Eigen::MatrixXd matrix =
                Eigen::Map<const Eigen::MatrixXd>(M.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
            CHECK(matrix.llt().info() == Eigen::Success);
        }

        {
            INFO("d(T + V)/dt = supplied - dissipated + prescribed");
            typename Twin::State z = complex_state(point.x);
            for (std::size_t i = 0; i < states; ++i) z[i] += Complex(0, h * dxdt[i]);
            const Complex t(point.t, h);
            const double change = (twin.kinetic_energy(z, t) + twin.potential_energy(z, t)).imag() / h;
            const double supplied = system.supplied_power(point.x, point.u, point.t);
            const double dissipated = system.dissipated_power(point.x, point.u, point.t);
            const double prescribed = system.prescribed_power(point.x, point.u, point.t);
            const double kinetic_change = twin.kinetic_energy(z, t).imag() / h;
            const double size = std::abs(kinetic_change) + std::abs(supplied) + std::abs(dissipated) + std::abs(prescribed);
            CHECK(std::abs(change - (supplied - dissipated + prescribed)) <= 1e-12 * size);
            CHECK(dissipated >= 0);
        }

        {
            INFO("the Jacobians are the derivatives of the right-hand side");
            const auto rhs = [&](const auto& z, const auto& v) {
                typename Twin::State dzdt;
                twin.rhs(z, v, point.t, dzdt);
                return dzdt;
            };
            const auto [A, B] = derivatives(rhs, point);
            CHECK(column_error(dalembert::jacobian_x(system, point.x, point.u, point.t), A) <= 1e-12);
            CHECK(column_error(dalembert::jacobian_u(system, point.x, point.u, point.t), B) <= 1e-12);
            typename Real::State again;
            typename Real::JacobianX J;
            system.rhs_and_jacobian(point.x, point.u, point.t, again, J);
            for (std::size_t i = 0; i < states; ++i) CHECK(again[i] == doctest::Approx(dxdt[i]).epsilon(1e-12));

            typename Real::JacobianT Jt;
            system.jacobian_t(point.x, point.u, point.t, Jt);
            typename Twin::State dzdt;
            twin.rhs(complex_state(point.x), complex_input(point.u), Complex(point.t, h), dzdt);
            CHECK(column_error(Eigen::Map<const Eigen::VectorXd>(Jt.data(), static_cast<Eigen::Index>(states)), column(dzdt)) <= 1e-12);
        }

        {
            INFO("the Jacobian by parameters");
            constexpr std::size_t count = Real::parameter_table().size();
            static_assert(sizeof(Parameters<Complex>) == count * sizeof(Complex), "parameters are stored one after the other");
            Eigen::MatrixXd P(states, count);
            for (std::size_t c = 0; c < count; ++c) {
                Parameters<Complex> parameters;
                reinterpret_cast<Complex*>(&parameters)[c] += Complex(0, h);
                typename Twin::State dzdt;
                Twin(parameters).rhs(complex_state(point.x), complex_input(point.u), point.t, dzdt);
                P.col(static_cast<Eigen::Index>(c)) = column(dzdt);
            }
            // A relative error of a parameter changes f by p df/dp: what is small beside f is nothing.
            Eigen::MatrixXd J = dalembert::jacobian_p(system, point.x, point.u, point.t);
            const double f = Eigen::Map<const Eigen::VectorXd>(dxdt.data(), static_cast<Eigen::Index>(states)).lpNorm<Eigen::Infinity>();
            const Parameters<double> values = system.parameters();
            for (std::size_t c = 0; c < count; ++c) {
                const auto k = static_cast<Eigen::Index>(c);
                const double p = std::abs(reinterpret_cast<const double*>(&values)[c]);
                const double size = std::max(f / std::max(p, 1e-300), P.col(k).lpNorm<Eigen::Infinity>());
                CHECK((J.col(k) - P.col(k)).lpNorm<Eigen::Infinity>() <= 1e-12 * size);
            }
        }

        {
            INFO("the Jacobians of the outputs");
            const auto output = [&](const auto& z, const auto& v) {
                typename Twin::Output y;
                twin.output(z, v, point.t, y);
                return y;
            };
            const auto [C, D] = derivatives(output, point);
            CHECK(column_error(dalembert::output_jacobian_x(system, point.x, point.u, point.t), C) <= 1e-12);
            CHECK(column_error(dalembert::output_jacobian_u(system, point.x, point.u, point.t), D) <= 1e-12);
        }
    }
}

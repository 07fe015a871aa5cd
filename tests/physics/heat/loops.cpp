// SPDX-License-Identifier: BSL-1.0
// A rod or block whose cells are computed in loops does what one does whose cells are written out.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "coupled_looped.hpp"
#include "coupled_single.hpp"
#include "dalembert/matrices.hpp"
#include "plate_looped.hpp"
#include "plate_single.hpp"

namespace {

/// The largest difference, relative to the largest entry.
template <class A, class B>
double difference(const A& a, const B& b) {
    double apart = 0, size = 0;
    for (std::size_t i = 0; i < std::size_t(a.size()); ++i) {
        apart = std::max(apart, std::fabs(a.data()[i] - b.data()[i]));
        size = std::max(size, std::fabs(b.data()[i]));
    }
    return size > 0 ? apart / size : apart;
}

/// Sums over cells and rates of cells, and what is made of them.
template <class Looped, class Single>
void same_outputs(const Looped& looped, const Single& single, const typename Looped::State& x, const typename Looped::Input& u, double t) {
    typename Looped::Output y, y_single;
    looped.output(x, u, t, y);
    single.output(x, u, t, y_single);
    typename Looped::OutputJacobianX C, C_single;
    looped.output_jacobian_x(x, u, t, C);
    single.output_jacobian_x(x, u, t, C_single);
    typename Looped::OutputJacobianU D, D_single;
    looped.output_jacobian_u(x, u, t, D);
    single.output_jacobian_u(x, u, t, D_single);
    for (std::size_t i = 0; i < y.size(); ++i) {
        CAPTURE(Looped::output_table()[i].name);
        CHECK(y[i] == doctest::Approx(y_single[i]).epsilon(1e-12));
        double size = 0;
        for (std::size_t c = 0; c < x.size(); ++c) size = std::max(size, std::fabs(C_single[y.size() * c + i]));
        for (std::size_t c = 0; c < x.size(); ++c) CHECK(std::fabs(C[y.size() * c + i] - C_single[y.size() * c + i]) <= 1e-12 * size);
        CHECK(D[i] == doctest::Approx(D_single[i]).epsilon(1e-12));
    }
}

template <class Looped, class Single>
void same_system() {
    const Looped looped;
    const Single single;
    CHECK(difference(looped.start_state(), single.start_state()) < 1e-15);
    for (std::size_t i = 0; i < Looped::state_table().size(); ++i) {
        CHECK(std::string(Looped::state_table()[i].name) == Single::state_table()[i].name);
        CHECK(Looped::state_table()[i].low == Single::state_table()[i].low);
    }
    std::mt19937 random(1);
    std::uniform_real_distribution<double> temperature(250, 600);
    for (int trial = 0; trial < 20; ++trial) {
        typename Looped::State x;
        for (double& T : x) T = temperature(random);
        const typename Looped::Input u{temperature(random)};
        const double t = trial * 1000.0;
        typename Looped::State a, b;
        looped.rhs(x, u, t, a);
        single.rhs(x, u, t, b);
        CHECK(difference(a, b) < 1e-13);
        CHECK(difference(dalembert::jacobian_x(looped, x, u, t), dalembert::jacobian_x(single, x, u, t)) < 1e-13);
        CHECK(difference(dalembert::jacobian_u(looped, x, u, t), dalembert::jacobian_u(single, x, u, t)) < 1e-13);
        const auto by_looped = dalembert::jacobian_p(looped, x, u, t);
        const auto by_single = dalembert::jacobian_p(single, x, u, t);
        for (Eigen::Index p = 0; p < by_single.cols(); ++p) CHECK(difference(by_looped.col(p).eval(), by_single.col(p).eval()) < 1e-12);
        typename Looped::JacobianT by_time;
        typename Single::JacobianT by_time_single;
        looped.jacobian_t(x, u, t, by_time);
        single.jacobian_t(x, u, t, by_time_single);
        CHECK(difference(by_time, by_time_single) < 1e-13);
        CHECK(looped.internal_energy(x, t) == doctest::Approx(single.internal_energy(x, t)).epsilon(1e-14));
        CHECK(std::fabs(looped.exchanged_power(x, u, t) - single.exchanged_power(x, u, t)) < 1e-10);
        same_outputs(looped, single, x, u, t);
    }
}

}  // namespace

TEST_CASE("a rod with its cells in loops is the one whose cells are written out") {
    same_system<coupled_N10::looped::System<double>, coupled_N10::single::System<double>>();
}

TEST_CASE("a block with its cells in loops is the one whose cells are written out") {
    same_system<plate_M2_N3::looped::System<double>, plate_M2_N3::single::System<double>>();
}

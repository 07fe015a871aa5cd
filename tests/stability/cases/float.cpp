// SPDX-License-Identifier: GPL-3.0-or-later
// Machines of controllers in float, and numbers that are hardly different from zero.
#include "heat/glazing_N3_full.hpp"
#include "hydraulics/hydraulic_cylinder_real.hpp"
#include "mechanics/ball_on_beam_full.hpp"
#include "mechanics/cart_pendulum_lab.hpp"
#include "mechanics/drive_train_damped.hpp"
#include "mechanics/four_bar_full.hpp"
#include "mechanics/heavy_top_attitude.hpp"
#include "mechanics/n_pendulum_N3_full.hpp"
#include "mechanics/n_pendulum_N5_full.hpp"
#include "mechanics/slider_crank_full.hpp"
#include "mechanics/spherical_pendulum_forced.hpp"
#include "physics/laws.hpp"
#include "stability/cases/hard_case.hpp"

namespace {

/// Largest difference of float and double from the same start, seen at 100 points, relative to the largest magnitude of each state.
template <template <class> class System>
double float_error(double until, dalembert::Method method, double step) {
    using Single = System<float>;
    using Double = System<double>;
    const auto options = [&](auto machine) {
        auto made = with<decltype(machine)>(method, 1e-5);
        made.is_fixed = true;
        made.step = static_cast<typename decltype(machine)::scalar_type>(step);
        return made;
    };
    std::vector<typename Single::State> single;
    std::vector<typename Double::State> exact;
    const Single controller;
    hard_run<Single>(controller, controller.start_state(), until, options(controller), dalembert::ZeroInputs<Single>{}, [&](const auto& sample) { single.push_back(sample.x); });
    const Double plant;
    hard_run<Double>(plant, plant.start_state(), until, options(plant), dalembert::ZeroInputs<Double>{}, [&](const auto& sample) { exact.push_back(sample.x); });
    double worst = single.size() == exact.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < exact[0].size(); ++i) {
        double size = 0, error = 0;
        for (std::size_t k = 0; k < std::min(single.size(), exact.size()); ++k) {
            size = std::max(size, std::fabs(exact[k][i]));
            error = std::max(error, std::fabs(static_cast<double>(single[k][i]) - exact[k][i]));
        }
        if (size > 0) worst = std::max(worst, error / size);
    }
    return worst;
}

}  // namespace

TEST_CASE("float where a controller would use it") {
    const auto row = [](const char* machine, double until, double step, double promised, double error) {
        char what[80];
        std::snprintf(what, sizeof what, "off double over %g s by rk4 with steps of %g s, relative", until, step);
        keeps(std::string(machine) + ", in float", what, promised, error);
    };
    row("cart with pendulum", 2, 1e-3, 1e-4, float_error<cart_pendulum::lab::System>(2, dalembert::Method::rk4, 1e-3));
    row("spherical pendulum", 2, 1e-3, 1e-4, float_error<spherical_pendulum::forced::System>(2, dalembert::Method::rk4, 1e-3));
    row("ball on beam", 1, 1e-3, 1e-4, float_error<ball_on_beam::full::System>(1, dalembert::Method::rk4, 1e-3));
    row("chain of three rods", 1, 1e-3, 1e-4, float_error<n_pendulum_N3::full::System>(1, dalembert::Method::rk4, 1e-3));
    row("chain of five rods", 1, 1e-3, 1e-4, float_error<n_pendulum_N5::full::System>(1, dalembert::Method::rk4, 1e-3));
    row("drive train", 1, 1e-3, 1e-4, float_error<drive_train::damped::System>(1, dalembert::Method::rk4, 1e-3));
    row("heavy top, quaternion", 1, 1e-3, 2e-4, float_error<heavy_top::attitude::System>(1, dalembert::Method::rk4, 1e-3));
    row("slider and crank", 1, 1e-3, 5e-4, float_error<slider_crank::full::System>(1, dalembert::Method::rk4, 1e-3));
    // Bars that meet at flat angles take digits, and so does a piston nearly at rest between pressures of 1e5 Pa.
    row("four-bar linkage", 1, 1e-3, 1e-3, float_error<four_bar::full::System>(1, dalembert::Method::rk4, 1e-3));
    row("window of three panes", 100, 0.1, 5e-4, float_error<glazing_N3::full::System>(100, dalembert::Method::rk4, 0.1));
    row("hydraulic cylinder", 1, 1e-4, 5e-3, float_error<hydraulic_cylinder::real::System>(1, dalembert::Method::rk4, 1e-4));
}

TEST_CASE("denormal numbers are as good as zero") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    const double least = std::numeric_limits<double>::denorm_min();
    System::State x{}, tiny{}, f, g;
    for (double& value : tiny) value = least;
    system.rhs(x, {}, 0, f);
    system.rhs(tiny, {}, 0, g);
    double worst = 0;
    for (std::size_t i = 0; i < f.size(); ++i) worst = std::max(worst, std::fabs(f[i] - g[i]));
    keeps("cart with pendulum", "what states of 5e-324 change in the right-hand side", 1e-300, worst);
}

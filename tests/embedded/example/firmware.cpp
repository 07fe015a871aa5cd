// SPDX-License-Identifier: BSL-1.0
// The cart with its rod upright, balanced by the controller. The machine is simulated here too, by the generated equations in steps ten
// times smaller, with a rod that is a twentieth heavier than the controller knows.
#include "board/board.hpp"
#include "cart_pendulum_lab.hpp"
#include "controller.hpp"
#include "gains.hpp"

using System = cart_pendulum::lab::System<float>;

namespace cart_pendulum::lab {

/// Where the cart is, by its encoder, and where the end of the rod is, by a camera: a state, and an output of the model.
std::array<float, 2> measure(const ::System& system, const ::System::State& x) {
    ::System::Output y;
    system.output(x, ::System::Input{}, 0.0F, y);
    return {x[state::s], y[output::tip]};
}

}  // namespace cart_pendulum::lab

int program() {
    cart_pendulum::lab::Parameters<float> heavier;
    heavier.rho_S *= 1.05F;
    const System machine(heavier);
    Controller<System, Gains> controller;
    System::State x = Gains::upright;
    x[cart_pendulum::lab::state::phi] += Gains::first_angle;

    board::start_ticks();
    for (int sample = 0; sample <= Gains::samples; ++sample) {
        const auto measured = measure(machine, x);
        const std::uint32_t before = board::ticks();
        const System::Input u = controller.step(measured);
        const std::uint32_t instructions = board::instructions((before - board::ticks()) & 0xffffffU);

        board::write("sample");
        board::write(static_cast<float>(sample) * Gains::sample_time);
        for (const float value : x) board::write(value);
        for (const float value : controller.estimate()) board::write(value);
        board::write(u[0]);
        board::write(static_cast<float>(instructions));
        board::write("\n");

        for (int k = 0; k < 10; ++k) x = runge_kutta_step(machine, x, u, Gains::sample_time / 10.0F);
    }
    board::write("end\n");
    return 0;
}

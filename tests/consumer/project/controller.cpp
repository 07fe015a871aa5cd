// SPDX-License-Identifier: BSL-1.0
#include <cstdio>

#include "fixed_cart.hpp"

int main() {
    using System = cart_pendulum::lab::System<float>;
    const System system;
    System::State x = system.start_state(), f;
    x[cart_pendulum::lab::state::phi] = 1000.0F;  // as many turns as it may be
    System::JacobianX J;
    System::Output y;
    System::Energies energies;
    system.together(x, {}, 0.0F, f, J, y, energies);
    std::printf("%zu parameters are left; ddot(phi) = %.5f rad/s^2, V = %.5f J\n", cart_pendulum::lab::parameter_count, static_cast<double>(f[cart_pendulum::lab::state::phi_dot]), static_cast<double>(energies.potential));
}

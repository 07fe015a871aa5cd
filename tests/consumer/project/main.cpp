// SPDX-License-Identifier: BSL-1.0
#include <cstdio>

#include "cart.hpp"
#include "dalembert/simulate.hpp"

int main() {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    System::State x = system.start_state();
    dalembert::SimulationOptions<System> options;
    const auto result = dalembert::simulate(system, dalembert::ZeroInputs<System>(), x, 0.0, 1.0, options, [](const auto&) {});
    std::printf("m_W = %.3f kg, s(1) = %.6f m, %s\n", system.parameters().m_W, x[cart_pendulum::lab::state::s], dalembert::to_string(result.outcome.status));
    return result.outcome.status == dalembert::Status::success ? 0 : 1;
}

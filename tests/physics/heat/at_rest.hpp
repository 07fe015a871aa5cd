// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Dense>

#include "dalembert/matrices.hpp"

/// The state at which nothing changes, by Newton's method.
template <class System>
typename System::State at_rest(const System& system, const typename System::Input& u = {}) {
    typename System::State x = system.start_state();
    for (int i = 0; i < 12; ++i) {
        typename System::State f;
        system.rhs(x, u, 0, f);
        const auto J = dalembert::jacobian_x(system, x, u, 0);
        const Eigen::VectorXd step = J.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Eigen::Index>(f.size())));
        for (std::size_t k = 0; k < x.size(); ++k) x[k] -= step[static_cast<Eigen::Index>(k)];
    }
    return x;
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The functions for acados beside the table of the plant.
#pragma once

#include "export/random_point.hpp"

using AcadosFunction = LoadedFunction<int, void*>;

inline void check_acados(void* library, const std::string& name, ExpectedValues& plant, const Point& q, bool has_time, Random& random) {
    plant.at(q);
    const std::size_t n = plant.states(), m = plant.inputs(), p = plant.parameters();
    const auto function = [&](const char* which) { return AcadosFunction(library, name + "_" + which); };
    const auto columns = [&](const Vector& A, const Vector& S, std::size_t count) {  // A*S
        Vector result;
        for (std::size_t c = 0; c < count; ++c) {
            const Vector one = product(A, Vector(S.begin() + static_cast<long>(c * n), S.begin() + static_cast<long>((c + 1) * n)), n);
            result.insert(result.end(), one.begin(), one.end());
        }
        return result;
    };
    const Vector Sx = random.vector(n * n), Su = random.vector(n * m), Sp = random.vector(n * p), lambda = random.vector(n),
                 xdot = random.vector(n);
    const double size = std::max({size_of(plant.by_x, {1}), size_of(plant.by_u, {1}), size_of(plant.by_p, {1})}) * static_cast<double>(n);
    if (has_time) {
        require(dlsym(library, (name + "_expl_ode_fun").c_str()) == nullptr, "explicit functions of a model that depends on time");
    } else {
        same("expl_ode_fun", function("expl_ode_fun")({q.x, q.u, q.p})[0], plant.rates);
        const std::vector<Vector> forward = function("expl_vde_forw")({q.x, Sx, Su, q.u, q.p});
        same("expl_vde_forw", forward[0], plant.rates_with_jacobian);
        same("expl_vde_forw, Sx", forward[1], columns(plant.by_x, Sx, n), 1e-13, size);
        same("expl_vde_forw, Su", forward[2], sum(plant.by_u, columns(plant.by_x, Su, m)), 1e-13, size);
        Vector adjoint = transposed_product(plant.by_x, lambda, n);
        const Vector by_u = transposed_product(plant.by_u, lambda, m);
        adjoint.insert(adjoint.end(), by_u.begin(), by_u.end());
        same("expl_vde_adj", function("expl_vde_adj")({q.x, lambda, q.u, q.p})[0], adjoint, 1e-13, size);
        same("expl_vde_forw_p", function("expl_vde_forw_p")({q.x, Sp, q.u, q.p})[0], sum(plant.by_p, columns(plant.by_x, Sp, p)), 1e-13,
             size);
    }
    const std::vector<Vector> arguments{q.x, xdot, q.u, {}, {q.t}, q.p};
    const Vector residual = sum(xdot, negative(plant.rates)), with_jacobian = sum(xdot, negative(plant.rates_with_jacobian));
    Vector identity(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) identity[i * n + i] = 1;
    const Vector by_x = negative(plant.by_x), by_u = negative(plant.by_u);
    const auto results = [&](const char* which, const std::vector<Vector>& expected) {
        const std::vector<Vector> found = function(which).whole(arguments);
        require(found.size() == expected.size(), std::string(which) + ": number of results");
        for (std::size_t i = 0; i < found.size(); ++i) same(which, found[i], expected[i], 1e-14, i == 0 ? size_of(xdot, {1}) : 0);
    };
    results("impl_dae_fun", {residual});
    results("impl_dae_fun_jac_x_xdot_z", {with_jacobian, by_x, identity, {}});
    results("impl_dae_fun_jac_x_xdot_u_z", {with_jacobian, by_x, identity, by_u, {}});
    results("impl_dae_fun_jac_x_xdot_u", {with_jacobian, by_x, identity, by_u});
    results("impl_dae_jac_x_xdot_u_z", {by_x, identity, by_u, {}});
    results("impl_dae_jac_p", {negative(plant.by_p)});
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives, of acados beside differences of the plant's Jacobians, and of CasADi beside those of acados.
#pragma once

#include "export/acados_functions.hpp"
#include "export/casadi_functions.hpp"

/// J'*lambda by states and inputs.
inline Vector gradient(ExpectedValues& plant, const Point& q, const Vector& lambda) {
    plant.at(q);
    Vector result = transposed_product(plant.by_x, lambda, plant.states());
    const Vector by_u = transposed_product(plant.by_u, lambda, plant.inputs());
    result.insert(result.end(), by_u.begin(), by_u.end());
    return result;
}

/// The products of CasADi along a further direction s, with H = d^2(lambda' f)/d[x; u]^2: (J'*lambda)' along s, and with v of J*v.
inline void check_second_products(void* library, const Casadi& casadi, ExpectedValues& plant, const Point& q, const Vector& H,
                                  const Vector& lambda, Random& random) {
    plant.at(q);
    const std::size_t n = plant.states(), m = plant.inputs(), w = n + m;
    const auto joined = [](Vector a, const Vector& b) { return a.insert(a.end(), b.begin(), b.end()), a; };
    const Vector sx = random.vector(n), su = random.vector(m), s_lambda = random.vector(n), vx = random.vector(n), vu = random.vector(m),
                 s_vx = random.vector(n), s_vu = random.vector(m), sp = random.vector(plant.parameters());
    const double size = (size_of(H, {1}) + size_of(plant.by_x, {1}) + size_of(plant.by_u, {1})) * static_cast<double>(w);
    const std::vector<Vector> time(casadi.has_time ? 1 : 0);
    const auto list = [&](std::vector<Vector> before, const std::vector<Vector>& after) {
        before.insert(before.end(), time.begin(), time.end());
        before.insert(before.end(), after.begin(), after.end());
        return before;
    };
    // x, u, p, (t), xdot, lambda; the adjoint; seeds of all of these
    const auto of_adjoint = [&](const Vector& along_p) {
        return casadi.arguments(q, list({{}, lambda, {}, {}, {}}, list({sx, su, along_p}, {{}, s_lambda})));
    };
    const CasadiFunction adjoint(library, "fwd1_adj1_f"), forward(library, "fwd1_fwd1_f");
    const std::vector<Vector> found = adjoint(of_adjoint({}));
    Vector expected = sum(product(H, joined(sx, su), w),
                          joined(transposed_product(plant.by_x, s_lambda, n), transposed_product(plant.by_u, s_lambda, m)));
    same("fwd1_adj1_f", joined(found[0], found[1]), expected, 1e-12, size);
    for (const double value : found[2]) require(std::isnan(value), "second derivatives by parameters are not there");
    const Vector along_p = adjoint(of_adjoint(sp))[0];
    for (const double value : along_p) require(sp.empty() || std::isnan(value), "second derivatives by parameters are not there");
    // x, u, p, (t), xdot, v; J*v; seeds
    const Vector twice = forward(casadi.arguments(q, list({{}, vx, vu, {}}, list({{}, sx, su, {}}, list({{}, s_vx, s_vu, {}}, {})))))[0];
    const Vector Hs = product(H, joined(sx, su), w), v = joined(vx, vu),
                 Jv = sum(product(plant.by_x, s_vx, n), product(plant.by_u, s_vu, n));
    double weighted = 0, other = 0;
    for (std::size_t i = 0; i < n; ++i) weighted += lambda[i] * twice[i], other += lambda[i] * Jv[i];
    for (std::size_t i = 0; i < w; ++i) other += v[i] * Hs[i];
    same("fwd1_fwd1_f", {weighted}, {other}, 1e-11, size * static_cast<double>(w));
}

/// Second derivatives, where they are there, beside differences of first ones, and along sensitivities. Returns whether they are there.
inline bool check_hessian(void* library, const std::string& name, void* of_casadi, const Casadi& casadi, ExpectedValues& plant,
                          const Point& q, Random& random) {
    if (dlsym(library, (name + "_impl_dae_hess").c_str()) == nullptr) return false;
    const std::size_t n = plant.states(), m = plant.inputs(), w = n + m;
    const Vector lambda = random.vector(n);
    const AcadosFunction implicit(library, name + "_impl_dae_hess");
    const Vector whole = implicit.whole({q.x, random.vector(n), q.u, {}, lambda, {q.t}, q.p})[0];
    require(whole.size() == (w + n) * (w + n), "size of impl_dae_hess");
    const auto place = [&](std::size_t i) { return i < n ? i : n + i; };
    Vector H(w * w);
    for (std::size_t c = 0; c < w; ++c)
        for (std::size_t r = 0; r < w; ++r) H[c * w + r] = -whole[place(c) * (w + n) + place(r)];
    const Vector middle = gradient(plant, q, lambda);
    for (std::size_t c = 0; c < w; ++c) {
        const double at = c < n ? q.x[c] : q.u[c - n], h = 1e-5 * std::max(1e-3, std::abs(at));
        Point a = q, b = q;
        (c < n ? a.x[c] : a.u[c - n]) = at - h, (c < n ? b.x[c] : b.u[c - n]) = at + h;
        const Vector low = gradient(plant, a, lambda), high = gradient(plant, b, lambda);
        for (std::size_t r = 0; r < w; ++r) {
            const double slope = (high[r] - low[r]) / (2 * h), found = H[c * w + r];
            // Differences lose the digits of large values, and see a kink from both sides.
            const double error = 1e-4 * (std::abs(slope) + std::abs(found)) + (1e-13 / h + 1e-9) * std::abs(middle[r]) + 1e-9;
            char text[200];
            std::snprintf(text, sizeof text, "second derivative [%zu, %zu]: %.12g, by differences %.12g", r, c, found, slope);
            require(!std::isfinite(slope) || std::abs(slope - found) <= error, text);
            require(!std::isfinite(found) || found == H[r * w + c], "second derivatives are not symmetric");
        }
    }
    compared() += w * w;
    check_second_products(of_casadi, casadi, plant, q, H, lambda, random);
    if (casadi.has_time) return true;
    const Vector Sx = random.vector(n * n), Su = random.vector(n * m);
    const std::vector<Vector> found = AcadosFunction(library, name + "_expl_ode_hess")({q.x, Sx, Su, lambda, q.u, q.p});
    plant.at(q);
    same("expl_ode_hess, adjoint", found[0], middle, 1e-13, size_of(plant.by_x, lambda) + size_of(plant.by_u, lambda));
    Vector S(w * w, 0.0), expected;
    for (std::size_t c = 0; c < w; ++c)
        for (std::size_t r = 0; r < w; ++r) S[c * w + r] = r >= n ? (r == c ? 1 : 0) : c < n ? Sx[c * n + r] : Su[(c - n) * n + r];
    for (std::size_t c = 0; c < w; ++c) {
        const Vector along(S.begin() + static_cast<long>(c * w), S.begin() + static_cast<long>((c + 1) * w));
        const Vector column = transposed_product(S, product(H, along, w), w);
        expected.insert(expected.end(), column.begin() + static_cast<long>(c), column.end());
    }
    same("expl_ode_hess", found[1], expected, 1e-12, size_of(H, {1}) * static_cast<double>(w));
    return true;
}

// SPDX-License-Identifier: BSL-1.0
// Temperatures of nodes that store nothing and hold each other in balance, of a fixed number, without heap. The generator copies what
// stands between the marks into headers that need it; "needs" names the sections that have to stand before.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/scalar_functions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin network:
/// Eliminates the nodes of a network in place. `flow` holds in row i what flows to i for each unit at j, nothing negative, and on the
/// diagonal what leaves j for good. Only sums, products and quotients of what is not negative occur (Grassmann, Taksar and Heyman,
/// 1985), so that no digits are lost, however weak the link to outside is.
template <class Scalar, std::size_t n>
void network_factor(std::array<Scalar, n * n>& flow) noexcept {
    for (std::size_t k = n; k-- > 0;) {
        const Scalar for_good = flow[k * n + k];
        Scalar leaving = for_good;
        for (std::size_t i = 0; i < k; ++i) leaving += flow[i * n + k];
        const Scalar inverse = Scalar(1) / leaving;
        flow[k * n + k] = inverse;
        for (std::size_t i = 0; i < k; ++i) flow[i * n + k] *= inverse;
        for (std::size_t j = 0; j < k; ++j) {
            const Scalar arriving = flow[k * n + j];
            for (std::size_t i = 0; i < k; ++i)
                if (i != j) flow[i * n + j] += flow[i * n + k] * arriving;
            flow[j * n + j] += for_good * inverse * arriving;
        }
    }
}

/// Solves for what stands at the nodes when `b` flows into them, in place; `flow` as network_factor leaves it.
template <class Scalar, std::size_t n>
void network_solve(const std::array<Scalar, n * n>& flow, Scalar* b) noexcept {
    for (std::size_t k = n; k-- > 0;)
        for (std::size_t i = 0; i < k; ++i) b[i] += flow[i * n + k] * b[k];
    for (std::size_t k = 0; k < n; ++k) {
        Scalar sum = b[k];
        for (std::size_t j = 0; j < k; ++j) sum += flow[k * n + j] * b[j];
        b[k] = sum * flow[k * n + k];
    }
}
// end network

// begin network_inverse: network
/// What stands at node i for each unit that flows into node j, row by row: the inverse of A with A_ij = -flow[i, j] and A_jj all that
/// leaves j. Needs network.
template <class Scalar, std::size_t n>
std::array<Scalar, n * n> network_inverse(std::array<Scalar, n * n> flow) noexcept {
    network_factor<Scalar, n>(flow);
    std::array<Scalar, n * n> inverse{};
    for (std::size_t j = 0; j < n; ++j) {
        std::array<Scalar, n> unit;
        for (std::size_t i = 0; i < n; ++i) unit[i] = Scalar(i == j ? 1 : 0);
        network_solve<Scalar, n>(flow, unit.data());
        for (std::size_t i = 0; i < n; ++i) inverse[i * n + j] = unit[i];
    }
    return inverse;
}
// end network_inverse

// begin is_certain:
/// Whether a comparison holds; of several numbers at once, whether it holds for all of them. Types that cannot tell are never certain.
inline bool is_certain(bool condition, int) noexcept { return condition; }
template <class Condition>
auto is_certain(const Condition& condition, int) noexcept -> decltype(static_cast<bool>(all(condition))) {
    return static_cast<bool>(all(condition));
}
template <class Condition>
bool is_certain(const Condition&, ...) noexcept {
    return false;
}
// end is_certain

// begin balanced_temperature: select, network, is_certain
/// The T >= 0 with g T + r T^4 = y, to a hundredth part, where Newton's steps begin: two of them from the least of what either loss alone
/// would ask for, which is above T; radiant_temperature has their errors. Needs select.
template <class Scalar>
Scalar temperature_giving_off(const Scalar& g, const Scalar& r, const Scalar& y) noexcept {
    using std::sqrt;
    const auto only_radiates = g == Scalar(0);
    const auto only_conducts = r == Scalar(0);
    const Scalar by_conduction = y / select(only_radiates, Scalar(1), g);
    const Scalar by_radiation = sqrt(Scalar(sqrt(Scalar(y / select(only_conducts, Scalar(1), r)))));
    Scalar T = select(by_radiation < by_conduction, by_radiation, by_conduction);
    T = select(only_radiates, by_radiation, select(only_conducts, by_conduction, T));
    for (int step = 0; step < 2; ++step) {
        const Scalar radiated = r * T * T * T;
        const Scalar slope = g + Scalar(4) * radiated;
        const auto is_flat = slope == Scalar(0);  // at T = 0 without conduction
        T = T - select(is_flat, Scalar(0), Scalar(((g + radiated) * T - y) / select(is_flat, Scalar(1), slope)));
    }
    return T;
}

/// The temperatures of n nodes that give off g[i, j]*(T_i - T_j) + r[i, j]*(T_i^4 - T_j^4) to each other and g[i, i]*T_i + r[i, i]*T_i^4
/// to outside, and take up b[i]; the arrays stand one behind the other in `data`, g and r symmetric and not negative. Newton's steps;
/// heat between nodes is computed from differences, so that strong links do not hide weak ones. What would change by more than an
/// eighth what a node gives off, y_i = G_i*T_i + R_i*T_i^4, is taken in y_i, of which the shares to others have bounded slopes;
/// smaller steps are as good in T_i itself and need no roots. Stops when a step changes less than half of the digits, one step later,
/// and always after 40 steps; types that cannot tell take them all. Over coefficients that differ by eight powers of ten at
/// most 30 were needed. Needs select, network.
template <class Scalar, std::size_t n>
std::array<Scalar, n> balanced_temperature(const std::array<Scalar, 2 * n * n + n>& data) noexcept {
    using std::abs;
    using std::sqrt;
    const Scalar* const g = data.data();
    const Scalar* const r = g + n * n;
    const Scalar* const b = r + n * n;
    std::array<Scalar, n> all_g;
    std::array<Scalar, n> all_r;
    Scalar g_outside(0);
    Scalar r_outside(0);
    Scalar all_b(0);
    for (std::size_t i = 0; i < n; ++i) {
        all_g[i] = all_r[i] = Scalar(0);
        for (std::size_t j = 0; j < n; ++j) {
            all_g[i] += g[i * n + j];
            all_r[i] += r[i * n + j];
        }
        g_outside += g[i * n + i];
        r_outside += r[i * n + i];
        all_b += b[i];
    }
    std::array<Scalar, n> T;
    T.fill(temperature_giving_off(g_outside, r_outside, all_b));
    const Scalar half_the_digits = sqrt(std::numeric_limits<Scalar>::is_specialized ? std::numeric_limits<Scalar>::epsilon() : Scalar(1e-9));
    bool is_last = false;
    for (int step = 0; step < 40 && !is_last; ++step) {
        std::array<Scalar, n * n> flow;
        std::array<Scalar, n> change;
        for (std::size_t i = 0; i < n; ++i) change[i] = b[i];
        for (std::size_t j = 0; j < n; ++j) {
            const Scalar cube = T[j] * T[j] * T[j];
            for (std::size_t i = 0; i < n; ++i) flow[i * n + j] = g[i * n + j] + r[i * n + j] * (Scalar(4) * cube);
            change[j] -= (g[j * n + j] + r[j * n + j] * cube) * T[j];
            for (std::size_t i = 0; i < j; ++i) {
                const Scalar heat = (T[j] - T[i]) * (g[i * n + j] + r[i * n + j] * (T[j] + T[i]) * (T[j] * T[j] + T[i] * T[i]));
                change[j] -= heat;
                change[i] += heat;
            }
        }
        network_factor<Scalar, n>(flow);
        network_solve<Scalar, n>(flow, change.data());
        bool is_close = true;
        for (std::size_t j = 0; j < n; ++j) {
            const Scalar radiates = all_r[j] * T[j] * T[j] * T[j];
            const Scalar gives_off = (all_g[j] + radiates) * T[j];
            const Scalar more = (all_g[j] + Scalar(4) * radiates) * change[j];
            Scalar next = T[j] + change[j];
            const auto is_small = abs(more) * Scalar(8) <= gives_off;
            if (!is_certain(is_small, 0)) {
                const Scalar y = gives_off + more;
                const Scalar least = T[j] / Scalar(4);
                const auto is_positive = y > Scalar(0);
                const Scalar asked = select(is_positive, temperature_giving_off<Scalar>(all_g[j], all_r[j], select(is_positive, y, Scalar(1))), least);
                next = select(is_small, next, select(asked < least, least, asked));
            }
            is_close = is_close && is_certain(abs(Scalar(next - T[j])) <= half_the_digits * next, 0);
            T[j] = next;
        }
        is_last = is_close;
    }
    return T;
}
// end balanced_temperature

}  // namespace detail

using detail::balanced_temperature;
using detail::network_inverse;

}  // namespace v1
}  // namespace dalembert

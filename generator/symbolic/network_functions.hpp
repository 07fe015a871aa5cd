// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures of several nodes that store nothing and are linked to each other in rings, or by conduction and radiation at once: what
// no closed form gives. They are functions of all conductances and sources of their network, with exact derivatives.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <vector>

namespace dalembert {

/// Element (i, j) of the inverse of A, where -A_ij is what flows to i for each unit at j, and A_jj all that leaves j. The sequence has n*n
/// entries, none negative: flow to i from j in row i, on the diagonal what leaves j for good.
DECLARE_FUNCTION_3P(network_inverse)
/// T_i >= 0 of a network with, for each node, conduction*(T_i - T_j) + radiation*(T_i^4 - T_j^4) to the others, conduction*T_i +
/// radiation*T_i^4 to outside and a source. The sequence has the n*n conductances, those to outside on the diagonal, the n*n radiances
/// likewise, and the n sources.
DECLARE_FUNCTION_2P(balanced_temperature)

/// s_k of a junction at pressure p, s_k = signed_root(P_k - p), where b - G*p + sum of r_k*s_k = 0, with G and all r_k >= 0. The sequence
/// is G, b, P_1, r_1, P_2, r_2 and so on.
DECLARE_FUNCTION_2P(junction_root)

struct NetworkData {
    std::vector<std::vector<GiNaC::ex>> conduction;  ///< W/K, symmetric; on the diagonal to outside
    std::vector<std::vector<GiNaC::ex>> radiation;   ///< W/K^4, likewise
    std::vector<GiNaC::ex> sources;                  ///< W, with what comes from temperatures outside

    explicit NetworkData(std::size_t n);
    /// Of balanced_temperature.
    explicit NetworkData(const GiNaC::ex& list);
    std::size_t size() const { return sources.size(); }
    GiNaC::ex list() const;
    std::vector<GiNaC::ex> temperatures() const;
    /// W into node i at these temperatures.
    GiNaC::ex balance(std::size_t i, const std::vector<GiNaC::ex>& temperatures) const;
    bool is_linear() const;
};

/// Likewise of junction_root alone.
GiNaC::ex derivative_of_junction(const GiNaC::ex& function, const std::function<GiNaC::ex(const GiNaC::ex&)>& derivative);
/// n of the list of an inverse.
unsigned long network_order(const GiNaC::ex& inverse_list);
/// Whether an expression is one of the three.
bool is_network_function(const GiNaC::ex& e);
/// balanced_temperature where nothing radiates: a sum of sources times elements of the inverse.
GiNaC::ex in_inverse(const GiNaC::ex& temperature);
/// The derivative of one of the three, given those of what it depends on.
GiNaC::ex derivative_of_network(const GiNaC::ex& function, const std::function<GiNaC::ex(const GiNaC::ex&)>& derivative);

}  // namespace dalembert

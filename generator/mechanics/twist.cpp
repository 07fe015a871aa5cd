// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/twist.hpp"

namespace dalembert {

using GiNaC::ex;

ex inner_product(const Twist& a, const Twist& b) {
    GiNaC::exvector terms;
    for (std::size_t i = 0; i < 6; ++i)
        if (!a[i].is_zero() && !b[i].is_zero()) terms.push_back(a[i] * b[i]);
    return GiNaC::add(terms);
}

Twist image_under(const TwistMatrix& m, const Twist& v) {
    Twist result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = inner_product(m[i], v);
    return result;
}

Twist image_under_transposed(const TwistMatrix& m, const Twist& v) {
    Twist result;
    for (std::size_t c = 0; c < 6; ++c) result[c] = inner_product(Twist{m[0][c], m[1][c], m[2][c], m[3][c], m[4][c], m[5][c]}, v);
    return result;
}

Twist twist_sum(const Twist& a, const Twist& b) {
    Twist result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = a[i] + b[i];
    return result;
}

Twist kept(const Twist& twist) { return joined(kept(angular(twist)), kept(linear(twist))); }

}  // namespace dalembert

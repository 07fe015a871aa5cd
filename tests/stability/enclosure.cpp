// SPDX-License-Identifier: GPL-3.0-or-later
// Exchange factors keep their digits next to black surfaces and next to mirrors, where (4.51) as it is printed has a matrix that is
// nearly singular.
#include <doctest/doctest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "enclosure.hpp"

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Emissivities = std::array<double, 4>;

template <class Scalar>
typename enclosure::full::System<Scalar>::Output exchange_factors(const Emissivities& eps) {
    enclosure::full::Parameters<Scalar> p;
    // The same in every arithmetic.
    for (const auto& [to, from] : {std::pair(&p.a, 2.0), {&p.b, 1.5}, {&p.c, 0.6875}, {&p.H, 3.0}, {&p.F, 0.3125}, {&p.eps_1, eps[0]}, {&p.eps_2, eps[1]}, {&p.eps_3, eps[2]}, {&p.eps_4, eps[3]}})
        *to = static_cast<Scalar>(from);
    const enclosure::full::System<Scalar> system(p);
    typename enclosure::full::System<Scalar>::Output y;
    system.output({}, {}, Scalar(0), y);
    return y;
}

/// The largest relative error of an exchange factor in double.
double worst_error(const Emissivities& eps) {
    const auto computed = exchange_factors<double>(eps);
    const auto exact = exchange_factors<Digits50>(eps);
    double worst = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        CHECK(std::isfinite(computed[k]));
        if (exact[k] == 0) CHECK(computed[k] == 0);
        else worst = std::max(worst, std::abs(static_cast<double>((Digits50(computed[k]) - exact[k]) / exact[k])));
    }
    return worst;
}

}  // namespace

TEST_CASE("exchange factors from nearly no to nearly full emission are right to 1e-14") {
    const double small = 1e-12;
    const double large = 1 - 1e-12;
    double worst = 0;
    // Every combination of next to nothing, nearly black, what is common, and the two ends.
    const std::array<double, 6> values{small, large, 0.25, 0, 1, 1e-6};
    for (const double a : values)
        for (const double b : values)
            for (const double c : values)
                for (const double d : values) worst = std::max(worst, worst_error({a, b, c, d}));
    MESSAGE("largest relative error: ", worst);
    CHECK(worst <= 1e-14);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/sizes.hpp"

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

ex without_waves(const ex& term) {
    const auto is_wave = [](const ex& factor) {
        const bool is_power = GiNaC::is_exactly_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
        const ex& base = is_power ? factor.op(0) : factor;
        return GiNaC::is_the_function<GiNaC::sin_SERIAL>(base) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(base);
    };
    if (is_wave(term)) return 1;
    if (!GiNaC::is_exactly_a<GiNaC::mul>(term)) return term;
    ex product = 1;
    for (const ex& factor : term)
        if (!is_wave(factor)) product *= factor;
    return product;
}

}  // namespace

ex least_square(const ex& sum) {
    const bool is_sum = GiNaC::is_exactly_a<GiNaC::add>(sum);
    ex size = is_sum ? ex(0) : magnitude(without_waves(sum));
    for (std::size_t i = 0; is_sum && i < sum.nops(); ++i) size += magnitude(without_waves(sum.op(i)));
    return GiNaC::pow(size, 2) / 1000000000000;
}

}  // namespace dalembert

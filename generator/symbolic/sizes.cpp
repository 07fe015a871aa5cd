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

template <class Part>
ex sum_of(const ex& sum, const Part& part) {
    if (!GiNaC::is_exactly_a<GiNaC::add>(sum)) return magnitude(part(sum));
    GiNaC::exvector terms;
    for (const ex& term : sum) terms.push_back(magnitude(part(term)));
    return GiNaC::add(terms);
}

}  // namespace

ex size_of_terms(const ex& sum) {
    return sum_of(sum, [](const ex& term) { return term; });
}

ex size_at_any_angle(const ex& sum) { return sum_of(sum, without_waves); }

ex least_square(const ex& sum) { return GiNaC::pow(size_at_any_angle(sum), 2) / 1000000000000; }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/constants.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

Value constant_value(const ex& value) {
    for (const int power : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
        const ex ratio = (value / GiNaC::pow(GiNaC::Pi, power)).expand();
        if (!GiNaC::is_exactly_a<GiNaC::numeric>(ratio) || !ex_to<GiNaC::numeric>(ratio).is_rational()) continue;
        const Rational rational = cln::the<cln::cl_RA>(ex_to<GiNaC::numeric>(ratio).to_cl_N());
        if (power == 0) return Value::constant(rational);
        std::vector<Value> factors{written_out(cln::abs(rational))}, divisors;
        (power > 0 ? factors : divisors).resize(static_cast<std::size_t>(std::abs(power)) + (power > 0 ? 1 : 0), Value::pi());
        const Value size = Value::product(std::move(factors), std::move(divisors));
        return is_negative(rational) ? Value::sum({size}, {true}) : size;
    }
    const auto number = value_at(value, {}, 60);
    if (!number) throw std::logic_error("a constant without a value");
    return Value::constant(cln::rational(*number));
}

bool contains_pi(const Value& value) {
    return value.kind() == Value::Kind::pi ||
           (value.kind() != Value::Kind::none && std::any_of(value.parts().begin(), value.parts().end(), contains_pi));
}

double double_value(const ex& value) {
    const auto number = value_at(value, {}, 40);
    return number ? cln::double_approx(*number) : 0.0;
}

std::string double_text(const ex& value) { return fmt::format("{}", double_value(value)); }

}  // namespace dalembert

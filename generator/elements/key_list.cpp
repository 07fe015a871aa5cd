// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/key_list.hpp"

namespace dalembert {

std::string unit_of(const Key& key) {
    if (key.unit) return key.names == nothing ? key.unit->written : "that of the name";
    if (!key.dimension) return {};
    const int power = key.dimension->exponent(6).numerator;
    const std::string usual = (*key.dimension / own_unit().dimension.raised({power, 1})).usual_unit();
    if (power == 0) return usual;
    const std::string rest = usual.substr(0, usual.find(" or "));
    const std::string own = std::abs(power) == 1 ? "U" : fmt::format("U^{}", std::abs(power));
    if (power < 0) return rest + "/" + own;
    return rest == "1" ? own : rest.starts_with("1/") ? own + rest.substr(1) : rest + "*" + own;
}

std::string bounds_of(const SignRule& sign) {
    if (sign.up_to_one) return "from 0 to 1";
    return sign.is_above_zero ? "above zero" : "not below zero";
}

}  // namespace dalembert

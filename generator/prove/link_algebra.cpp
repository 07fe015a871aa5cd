// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/link_algebra.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"

namespace dalembert {

using GiNaC::ex;

Twist letters(const char* name) {
    Twist result;
    for (std::size_t k = 0; k < 6; ++k) result[k] = GiNaC::realsymbol(fmt::format("any {}[{}]", name, k));
    return result;
}

bool LinkAlgebra::same(const ex& a, const ex& b) const {
    return a.is_equal(b) || prover_.have_same_form(a, b) || (!symbols_.attitudes().empty() && prover_.proven_equal(a, b));
}

bool LinkAlgebra::same(const Twist& a, const Twist& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), [&](const ex& one, const ex& other) { return same(one, other); });
}

Twist LinkAlgebra::twist_of(const ChainLink* link) {
    Twist result{};
    for (std::size_t k = 0; link != nullptr && k < 6; ++k) result[k] = link->letters[k].first;
    return result;
}

Twist LinkAlgebra::value_of(const ChainLink& link) {
    Twist result;
    for (std::size_t k = 0; k < 6; ++k) result[k] = link.letters[k].second;
    return result;
}

const Twist& LinkAlgebra::direction(const ChainLink& link, std::size_t coordinate) {
    const auto place = std::find(link.coordinates.begin(), link.coordinates.end(), coordinate) - link.coordinates.begin();
    return link.directions.at(static_cast<std::size_t>(place));
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/chain_motion.hpp"

#include <algorithm>

#include "symbolic/functions.hpp"

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

MeantMotion meant_motion(const Chain& chain) {
    const std::size_t n = chain.rest.size();
    MeantMotion result{std::vector<std::vector<ex>>(n, std::vector<ex>(n, 0)), chain.rest};
    GiNaC::exmap meaning;
    const auto written_out = [&](const ex& e) { return e.subs(meaning, GiNaC::subs_options::no_pattern); };
    const auto all_written_out = [&](Twist twist) {
        std::transform(twist.begin(), twist.end(), twist.begin(), written_out);
        return twist;
    };
    const auto kept = [](Twist twist) {
        std::transform(twist.begin(), twist.end(), twist.begin(), [](const ex& e) { return ex(whole(e)); });
        return twist;
    };
    // Of each link: the columns of its Jacobian that are not zero, and its acceleration without qdd, and the part of that in which
    // gravity is.
    std::vector<std::vector<std::pair<std::size_t, Twist>>> jacobians;
    std::vector<Twist> accelerations, falling;
    for (const ChainLink& link : chain.links) {
        GiNaC::exmap own;
        for (const auto& [letter, value] : link.letters) own[letter] = whole(written_out(value));
        meaning.insert(own.begin(), own.end());
        TwistMatrix transfer = link.transfer, inertia = link.inertia;
        std::transform(transfer.begin(), transfer.end(), transfer.begin(), all_written_out);
        std::transform(inertia.begin(), inertia.end(), inertia.begin(), all_written_out);
        auto& jacobian = jacobians.emplace_back();
        if (link.base)
            for (const auto& [j, column] : jacobians[*link.base]) jacobian.emplace_back(j, kept(image_under(transfer, column)));
        for (std::size_t j = 0; j < link.coordinates.size(); ++j)
            jacobian.emplace_back(link.coordinates[j], kept(all_written_out(link.directions[j])));
        const Twist still{};
        accelerations.push_back(
            kept(twist_sum(image_under(transfer, link.base ? accelerations[*link.base] : still), all_written_out(link.remainder))));
        falling.push_back(kept(image_under(transfer, link.base ? falling[*link.base] : chain.ground)));
        const Twist needed = twist_sum(image_under(inertia, twist_sum(accelerations.back(), falling.back())), all_written_out(link.force));
        for (const auto& [j, column] : jacobian) {
            result.force[j] -= inner_product(column, needed);
            const Twist image = image_under(inertia, column);
            for (const auto& [i, other] : jacobian) result.mass[i][j] += inner_product(other, image);
        }
    }
    return result;
}

}  // namespace dalembert

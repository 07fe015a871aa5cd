// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/chain_motion.hpp"

#include <algorithm>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/load.hpp"

#include "elements/statics.hpp"

namespace dalembert {

std::vector<LoadShare> load_shares(const Load& load, const Translator& translate, const Letters& unknowns) {
    const auto vector = [&](const std::optional<VectorExpression>& v) {
        SpaceVector result{0, 0, 0};
        for (std::size_t i = 0; v && i < 3; ++i) result[i] = translate(*(*v)[i], {}, unknowns);
        return result;
    };
    const SpaceVector about = vector(load.about);
    std::vector<LoadShare> shares;
    for (const LoadPart& part : load.parts) {
        if (part.moment) {
            shares.push_back({&part, {0, 0, 0}, vector(part.moment)});
            continue;
        }
        const SpaceVector force = vector(part.force);
        shares.push_back({&part, force, cross(vector(part.at) - about, force)});  // (2.37)
    }
    return shares;
}

}  // namespace dalembert

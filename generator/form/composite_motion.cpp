// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/composite_motion.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;

namespace {

using dalembert::kept;
ex kept(const ex& e) { return kept(SpaceVector{e, 0, 0})[0]; }

RigidBody kept(RigidBody body) {
    body.mass = kept(body.mass);
    body.moment = kept(body.moment);
    for (SpaceVector& row : body.tensor) row = kept(row);
    return body;
}

RigidBody sum(RigidBody a, const RigidBody& b) {
    a.mass += b.mass;
    a.moment = a.moment + b.moment;
    for (std::size_t r = 0; r < 3; ++r) a.tensor[r] = a.tensor[r] + b.tensor[r];
    return a;
}

Twist momentum(const RigidBody& body, const Twist& twist) {
    const SpaceVector w = angular(twist), v = linear(twist);
    return joined(body.tensor * w + cross(body.moment, v), body.mass * v + cross(w, body.moment));
}

/// What a link is made of; the letters of its base, and its own, written out.
class Writer {
public:
    void add(const ChainLink& link) {
        GiNaC::exmap own;
        for (const auto& [letter, value] : link.letters) own[letter] = kept((*this)(value));
        meaning_.insert(own.begin(), own.end());
    }
    ex operator()(const ex& e) const { return e.subs(meaning_, GiNaC::subs_options::no_pattern); }
    Twist operator()(Twist twist) const {
        std::transform(twist.begin(), twist.end(), twist.begin(), [&](const ex& e) { return (*this)(e); });
        return twist;
    }

private:
    GiNaC::exmap meaning_;
};

/// Nothing where the inertia of a link is none of a rigid body about its origin.
std::optional<RigidBody> body_of(const ChainLink& link) {
    const TwistMatrix& m = link.inertia;
    const RigidBody body{m[3][3],
                         {m[2][4], m[0][5], m[1][3]},
                         {SpaceVector{m[0][0], m[0][1], m[0][2]}, SpaceVector{m[1][0], m[1][1], m[1][2]},
                          SpaceVector{m[2][0], m[2][1], m[2][2]}}};
    const TwistMatrix found = matrix_of(body);
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t c = 0; c < 6; ++c)
            if (!(found[r][c] - m[r][c]).expand().is_zero()) return std::nullopt;
    return body;
}

/// Whether nothing moves where no coordinate does.
bool stands_still(const ChainLink& link, const Chain& chain, const Symbols& symbols) {
    GiNaC::exmap still;
    for (const Variable& velocity : symbols.all(SymbolKind::velocity)) still[velocity.symbol] = 0;
    if (link.base)
        for (std::size_t k = 0; k < 6; ++k) still[chain.links[*link.base].letters[k].first] = 0;
    return std::all_of(link.letters.begin(), link.letters.end(),
                       [&](const NamedValue& letter) { return letter.second.subs(still, GiNaC::subs_options::no_pattern).is_zero(); });
}

}  // namespace

TwistMatrix matrix_of(const RigidBody& body) {
    TwistMatrix result;
    for (std::size_t c = 0; c < 6; ++c) {
        Twist unit{};
        unit[c] = 1;
        const Twist column = momentum(body, unit);
        for (std::size_t r = 0; r < 6; ++r) result[r][c] = column[r];
    }
    return result;
}

RigidBody seen_from_base(const RigidBody& body, const Frame& placed) {
    const SpaceVector& r = placed.origin;
    const SpaceVector moment = kept(placed.axes * body.moment);
    // Turned about one axis, or about several: then the sums between are long.
    const auto is_long = [](const SpaceVector& row) { return !row[0].is_zero() && !row[1].is_zero() && !row[2].is_zero(); };
    SpaceMatrix half;
    for (std::size_t i = 0; i < 3; ++i) {
        const SpaceVector row = transposed(body.tensor) * placed.axes[i];
        half[i] = is_long(placed.axes[i]) ? kept(row) : row;
    }
    RigidBody result{body.mass, moment + body.mass * r, {}};
    const ex square = 2 * dot(r, moment) + body.mass * dot(r, r);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k <= i; ++k)
            result.tensor[i][k] = result.tensor[k][i] = dot(half[i], placed.axes[k]) + (i == k ? square : ex(0)) - r[i] * moment[k] -
                                                        moment[i] * r[k] - body.mass * r[i] * r[k];
    return result;
}

std::optional<CompositeMotion> composite_motion(const Chain& chain, const std::vector<BodyMotion>& bodies, const Symbols& symbols) {
    const unsigned n = static_cast<unsigned>(symbols.degrees());
    CompositeMotion result{GiNaC::matrix(n, n), std::vector<ex>(n, 0), std::vector<ex>(n, 0)};
    const auto frame_of = [&](const ChainLink& link) -> const Frame& { return *bodies[link.body].frame; };
    std::vector<RigidBody> composites;
    std::vector<std::vector<Twist>> directions;
    std::vector<Twist> accelerations, needed;  // without qdd
    Writer written_out;
    for (const ChainLink& link : chain.links) {
        const auto body = body_of(link);
        if (!bodies[link.body].frame || !body || !stands_still(link, chain, symbols)) return std::nullopt;
        written_out.add(link);
        const Twist of_base = link.base ? accelerations[*link.base] : Twist{};
        composites.push_back(*body);
        accelerations.push_back(kept(twist_sum(image_under(link.transfer, of_base), written_out(link.remainder))));
        needed.push_back(twist_sum(momentum(*body, accelerations.back()), written_out(link.force)));
        std::vector<Twist>& own = directions.emplace_back();
        for (const Twist& direction : link.directions) own.push_back(kept(direction));
    }
    const SpaceVector pull = SpaceVector{0, 0, 0} - linear(chain.ground);
    for (std::size_t b = chain.links.size(); b-- > 0;) {
        const ChainLink& link = chain.links[b];
        composites[b] = kept(composites[b]);
        needed[b] = kept(needed[b]);
        const SpaceVector pulled = kept(frame_of(link).from_ground(pull));
        for (std::size_t own = 0; own < link.coordinates.size(); ++own) {
            const unsigned j = static_cast<unsigned>(link.coordinates[own]);
            result.coriolis[j] = inner_product(directions[b][own], needed[b]);
            Twist force = kept(momentum(composites[b], directions[b][own]));
            result.gravity[j] = dot(linear(force), pulled);
            for (std::size_t at = b;; at = *chain.links[at].base) {
                const std::vector<std::size_t>& moved = chain.links[at].coordinates;
                for (std::size_t k = 0; k < moved.size(); ++k) {
                    const unsigned i = static_cast<unsigned>(moved[k]);
                    result.mass(i, j) = result.mass(j, i) = inner_product(directions[at][k], force);
                }
                if (!chain.links[at].base) break;
                force = on_base(force, frame_of(chain.links[at]));
            }
        }
        if (!link.base) continue;
        composites[*link.base] = sum(composites[*link.base], seen_from_base(composites[b], frame_of(link)));
        needed[*link.base] = twist_sum(needed[*link.base], on_base(needed[b], frame_of(link)));
    }
    return result;
}

MeantMotion meant_motion(const Chain& chain, const CompositeMotion& composites) {
    MeantMotion result{{}, chain.rest};
    for (unsigned i = 0; i < chain.rest.size(); ++i) {
        std::vector<ex>& row = result.mass.emplace_back();
        for (unsigned j = 0; j < chain.rest.size(); ++j) row.push_back(composites.mass(i, j));
        result.force[i] += composites.gravity[i] - composites.coriolis[i];
    }
    return result;
}

}  // namespace dalembert

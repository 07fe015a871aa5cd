// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/chain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/gravity.hpp"
#include "symbolic/squares.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr std::size_t first_linear = 3;

/// What a body is placed on, in letters.
struct Base {
    Twist twist;
    bool turns_in_plane = false;
    ex cos = 1, sin = 0;
    bool has_axes = false;
};

class ChainFinder {
public:
    ChainFinder(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies, Symbols& symbols)
        : scene_(scene),
          translate_(translate),
          bodies_(bodies),
          symbols_(symbols),
          taken_(symbols.degrees(), false),
          places_(bodies.size()) {}

    std::optional<Chain> run() {
        if (!scene_.kinetic.empty() || !scene_.jets.empty() || bodies_.empty()) return std::nullopt;
        ground_ = base_of("ground", {});
        while (chain_.links.size() < bodies_.size()) {
            const std::size_t before = chain_.links.size();
            for (std::size_t i = 0; i < bodies_.size(); ++i)
                if (!places_[i] && base_is_there(i) && !add(i)) return std::nullopt;
            if (chain_.links.size() == before) return std::nullopt;
        }
        if (std::find(taken_.begin(), taken_.end(), false) != taken_.end()) return std::nullopt;
        if (scene_.gravity != nullptr) {
            const SpaceVector acceleration = translate_(scene_.gravity->acceleration, {});
            for (std::size_t i = 0; i < 3; ++i) chain_.ground[first_linear + i] = -acceleration[i];
        }
        return std::move(chain_);
    }

private:
    /// The body that one is placed on, by place; nothing: the ground.
    std::optional<std::size_t> base_place(std::size_t i) const {
        const Body& item = *bodies_[i].member.item;
        if (!item.on) return std::nullopt;
        const BodyMotion* motion = find_motion(bodies_, *item.on, scene_, Translator::indices_of(bodies_[i].member));
        if (motion == nullptr) return std::nullopt;
        return static_cast<std::size_t>(motion - bodies_.data());
    }

    bool base_is_there(std::size_t i) const {
        const auto base = base_place(i);
        return !base || places_[*base];
    }

    Twist twist_letters(const std::string& name) {
        Twist twist;
        for (std::size_t k = 0; k < 6; ++k) twist[k] = symbols_.letter(fmt::format("twist of {}[{}]", name, k));
        return twist;
    }

    Base base_of(const std::string& name, const std::optional<BodyMotion>& body) {
        Base base{twist_letters(name)};
        base.has_axes = body && body->frame;
        base.turns_in_plane = body && !body->frame && body->has_rotation;
        if (!base.turns_in_plane) return base;
        base.cos = symbols_.letter(fmt::format("cos of {}", name));
        base.sin = symbols_.letter(fmt::format("sin of {}", name));
        return base;
    }

    /// Along the motion, with the twist of the base held.
    ex moved(const ex& e, const Base& base) const {
        const ex own = symbols_.time_derivative(e);
        return base.turns_in_plane ? own + base.twist[2] * (partial(e, base.sin) * base.cos - partial(e, base.cos) * base.sin) : own;
    }

    /// The same without accelerations.
    ex rate(const ex& e, const Base& base) const {
        const ex result = moved(e, base);
        GiNaC::exmap still;
        for (const Variable& a : symbols_.all(SymbolKind::acceleration)) still[a.symbol] = 0;
        return result.subs(still, GiNaC::subs_options::no_pattern);
    }

    /// Null for a body that turns by angles.
    const Symbols::AttitudeSymbols* attitude_of(const BodyMotion& body) const {
        const auto& attitude = body.member.item->attitude;
        return attitude ? symbols_.find_attitude(attitude->name) : nullptr;
    }

    /// The coordinates in what places a body. False where one of them has moved another body already, or a plain state does.
    bool take_coordinates(const std::vector<ex>& placement, const Symbols::AttitudeSymbols* attitude,
                          std::vector<std::size_t>& coordinates) {
        const auto occurs = [&](const ex& symbol) {
            return std::any_of(placement.begin(), placement.end(), [&](const ex& e) { return e.has(symbol); });
        };
        const auto is_part = [&](std::size_t state) {
            return attitude != nullptr && std::find(attitude->parts.begin(), attitude->parts.end(), state) != attitude->parts.end();
        };
        for (const Variable& state : symbols_.all(SymbolKind::state))
            if (!is_part(state.position) && occurs(state.symbol)) return false;
        if (attitude != nullptr)
            for (const std::size_t j : attitude->coordinates) {
                if (taken_[j]) return false;
                taken_[j] = true;
                coordinates.push_back(j);
            }
        for (std::size_t j = 0; j < taken_.size(); ++j) {
            if (!occurs(symbols_.get(SymbolKind::coordinate, j))) continue;
            if (occurs(symbols_.get(SymbolKind::velocity, j)) || taken_[j]) return false;
            taken_[j] = true;
            coordinates.push_back(j);
        }
        return true;
    }

    bool add(std::size_t i) {
        const BodyMotion& body = bodies_[i];
        const auto base = base_place(i);
        ChainLink link;
        link.body = i;
        if (base) link.base = places_[*base];
        const Base& on = base ? bases_[*link.base] : ground_;
        if (!symbols_.is_constant(body.mass) || !symbols_.is_constant(body.inertia)) return false;
        Base own = base_of(body.member.name(), body);
        Twist velocity;  // of letters of the base
        if (!(body.frame ? add_in_space(link, body, on, own, velocity) : add_in_plane(link, body, on, own, velocity))) return false;
        finish(link, on, own, velocity, !base);
        places_[i] = chain_.links.size();
        chain_.links.push_back(std::move(link));
        bases_.push_back(std::move(own));
        return true;
    }

    bool add_in_plane(ChainLink& link, const BodyMotion& body, const Base& on, const Base& own, Twist& velocity) {
        const Body& item = *body.member.item;
        const Indices indices = Translator::indices_of(body.member);
        if (item.angular_velocity || on.has_axes || (!body.has_position && link.base)) return false;
        SpaceVector position{0, 0, 0};
        if (item.position) position = translate_(*item.position, indices);
        const ex angle = item.rotation ? translate_(item.rotation, indices) : ex(0);
        if (!take_coordinates({position[0], position[1], position[2], angle}, nullptr, link.coordinates)) return false;
        if (on.turns_in_plane)
            position = {on.cos * position[0] - on.sin * position[1], on.sin * position[0] + on.cos * position[1], position[2]};
        SpaceVector omega{0, 0, 0};
        if (body.has_rotation) {
            const ex c = GiNaC::cos(angle), s = GiNaC::sin(angle);
            omega[2] = symbols_.time_derivative(angle) + (on.turns_in_plane ? on.twist[2] : ex(0));
            link.letters = {{own.cos, on.cos * c - on.sin * s}, {own.sin, on.sin * c + on.cos * s}};
        }
        // What has no place is at the origin.
        velocity =
            joined(omega, linear(on.twist) + SpaceVector{moved(position[0], on), moved(position[1], on), moved(position[2], on)});
        link.inertia.fill({0, 0, 0, 0, 0, 0});
        link.inertia[2][2] = body.inertia;
        for (std::size_t k = first_linear; body.has_position && k < 6; ++k) link.inertia[k][k] = body.mass;
        link.force.fill(0);
        return true;
    }

    bool add_in_space(ChainLink& link, const BodyMotion& body, const Base& on, const Base& own, Twist& velocity) {
        const Frame& frame = *body.frame;
        const SpaceVector& centre = body.centre;
        for (std::size_t r = 0; r < 3; ++r)
            if (!symbols_.is_constant(centre[r]) || !symbols_.is_constant(body.tensor[r][0]) || !symbols_.is_constant(body.tensor[r][1]) ||
                !symbols_.is_constant(body.tensor[r][2]))
                return false;
        std::vector<ex> placement(frame.origin.begin(), frame.origin.end());
        for (const SpaceVector& row : frame.axes) placement.insert(placement.end(), row.begin(), row.end());
        const Symbols::AttitudeSymbols* attitude = attitude_of(body);
        if (!take_coordinates(placement, attitude, link.coordinates)) return false;
        SpaceVector base_omega = angular(on.twist), base_velocity = linear(on.twist);
        if (on.turns_in_plane)
            base_velocity = {on.cos * base_velocity[0] + on.sin * base_velocity[1], on.cos * base_velocity[1] - on.sin * base_velocity[0],
                             base_velocity[2]};
        const SpaceMatrix into = transposed(frame.axes);
        // What the frame turns by itself is its angular velocity less that of its base.
        const SpaceVector omega = own_turning(frame, attitude) + into * base_omega;
        velocity = joined(omega, into * (base_velocity + cross(base_omega, frame.origin) + time_derivative(frame.origin, symbols_)));

        const SpaceVector w = angular(own.twist), v = linear(own.twist);
        const ex& m = body.mass;
        const SpaceVector c = centre;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t k = 0; k < 3; ++k) {
                SpaceVector unit{0, 0, 0};
                unit[k] = 1;
                link.inertia[r][k] = body.tensor[r][k] + m * cross(c, cross(unit, c))[r];
                link.inertia[r][first_linear + k] = m * cross(c, unit)[r];
                link.inertia[first_linear + r][k] = m * cross(unit, c)[r];
                link.inertia[first_linear + r][first_linear + k] = r == k ? m : ex(0);
            }
        const SpaceVector push = m * cross(w, v + cross(w, c));
        link.force = joined(cross(w, body.tensor * w) + cross(c, push), push);
        return true;
    }

    /// From d(axes)/dt = axes*(omega x); of an attitude these are its velocities.
    SpaceVector own_turning(const Frame& frame, const Symbols::AttitudeSymbols* attitude) const {
        if (attitude != nullptr) {
            const auto about = [&](std::size_t axis) { return symbols_.get(SymbolKind::velocity, attitude->coordinates[axis]); };
            return {about(0), about(1), about(2)};
        }
        const SpaceMatrix& a = frame.axes;
        const auto entry = [&](std::size_t column, std::size_t of_rate) {
            ex sum = 0;
            for (std::size_t r = 0; r < 3; ++r) sum += a[r][column] * symbols_.time_derivative(a[r][of_rate]);
            return in_cosines(sum);  // of three turns about axes of their own little is left
        };
        return {entry(2, 1), entry(0, 2), entry(1, 0)};
    }

    void finish(ChainLink& link, const Base& on, const Base& own, const Twist& velocity, bool is_on_ground) {
        GiNaC::exmap at_ground;
        for (const ex& letter : on.twist) at_ground[letter] = 0;
        const auto settled = [&](const ex& e) { return is_on_ground ? e.subs(at_ground, GiNaC::subs_options::no_pattern) : e; };
        for (std::size_t r = 0; r < 6; ++r) {
            for (std::size_t k = 0; k < 6; ++k) link.transfer[r][k] = settled(partial(velocity[r], on.twist[k]));
            link.remainder[r] = settled(rate(velocity[r], on));
        }
        for (const std::size_t j : link.coordinates) {
            Twist direction;
            for (std::size_t r = 0; r < 6; ++r) direction[r] = partial(velocity[r], symbols_.get(SymbolKind::velocity, j));
            link.directions.push_back(direction);
        }
        std::vector<NamedValue> turned = std::move(link.letters);
        link.letters.clear();
        for (std::size_t k = 0; k < 6; ++k) link.letters.emplace_back(own.twist[k], settled(velocity[k]));
        link.letters.insert(link.letters.end(), turned.begin(), turned.end());
    }

    const Scene& scene_;
    const Translator& translate_;
    const std::vector<BodyMotion>& bodies_;
    Symbols& symbols_;
    std::vector<bool> taken_;
    std::vector<std::optional<std::size_t>> places_;  ///< of bodies among the links
    std::vector<Base> bases_;                         ///< by link
    Base ground_;
    Chain chain_;
};

}  // namespace

std::vector<ex> ChainLink::parts() const {
    std::vector<ex> all;
    each_part(*this, [&](const Twist& twist) { all.insert(all.end(), twist.begin(), twist.end()); });
    return all;
}

std::optional<Chain> find_chain(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies, Symbols& symbols) {
    return ChainFinder(scene, translate, bodies, symbols).run();
}

}  // namespace dalembert

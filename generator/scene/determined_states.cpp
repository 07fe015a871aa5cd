// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/determined_states.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/circuits.hpp"
#include "elements/conduction.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

class Determination {
public:
    Determination(const Scene& scene, const Names& names) : scene_(scene), names_(names) {}

    void run() {
        for (const auto& member : scene_.volumes) {
            const Volume& volume = *member.item;
            for (const ExpressionPtr& state : {volume.filling ? nullptr : volume.pressure, volume.density, volume.mass, volume.filling,
                                               scene_.has_temperature(volume, names_) ? volume.temperature : nullptr})
                claim(state, member);
        }
        for (const auto& member : scene_.flows) claim(member.item->velocity, member);
        for (const auto& member : scene_.nodes) {
            if (!scene_.has_capacity(*member.item, names_)) continue;
            claim(member.item->temperature, member);
            if (member.item->boiling) claim(member.item->boiling->mass, member);
        }
        for (const auto& member : scene_.rods) claim_all(member.item->temperature, member);
        for (const auto& member : scene_.blocks) claim_all(member.item->temperature, member);
        for (const auto& member : scene_.branches) {
            if (member.item->law == Branch::Law::capacitor) claim(member.item->voltage, member);
            if (member.item->law == Branch::Law::inductor) claim(member.item->current, member);
        }
        for (const auto& member : scene_.states) is_claimed(member);
    }

private:
    struct Claimant {
        std::string name;
        Span place;
    };

    template <class T>
    void claim(const ExpressionPtr& state, const Member<T>& member) {
        if (!state) return;
        const Indices indices = member.item->family ? Indices{{member.item->family->index, member.index}} : Indices{};
        const int index = state->children.empty() ? 0 : index_value(*state->children[0], scene_, indices);
        claim_one({state->name, index}, state->written(), state->span, {member.name(), member.item->span});
    }

    /// The cells of a rod or block.
    template <class T>
    void claim_all(const Reference& states, const Member<T>& member) {
        for (const auto& state : scene_.states)
            if (state.item->name == states.name)
                claim_one({states.name, state.index}, state.name(), states.span, {member.name(), member.item->span});
    }

    void claim_one(const std::pair<std::string, int>& state, const std::string& written, const Span& place, const Claimant& by) {
        const auto [first, is_new] = by_.emplace(state, by);
        if (is_new) return;
        fail(Id::doubly_determined, place,
             fmt::format("scene '{}': '{}' and '{}' both determine state '{}'", scene_.name, first->second.name, by.name, written),
             {{first->second.place, fmt::format("'{}' is defined here", first->second.name)}});
    }

    void is_claimed(const Member<State>& member) const {
        if (member.item->derivative || by_.contains({member.item->name, member.index})) return;
        const bool is_any =
            std::any_of(by_.begin(), by_.end(), [&](const auto& determined) { return determined.first.first == member.item->name; });
        fail(Id::undetermined, member.item->span,
             fmt::format("nothing in scene '{}' determines state '{}'{}", scene_.name, member.name(),
                         is_any ? "" : "; give it the same 'when' as the element that determines it"));
    }

    const Scene& scene_;
    const Names& names_;
    std::map<std::pair<std::string, int>, Claimant> by_;
};

}  // namespace

void check_determined(const Scene& scene, const Names& names) { Determination(scene, names).run(); }

}  // namespace dalembert

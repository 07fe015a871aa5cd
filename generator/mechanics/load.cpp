// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/load.hpp"

#include <algorithm>

#include "elements/statics.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class LoadReading {
public:
    LoadReading(const Load& load, const Translator& translate, const Letters& unknowns)
        : load_(load), translate_(translate), unknowns_(unknowns), bodies_(load_bodies(load)), about_(vector(load.about)) {}

    std::vector<LoadShare> shares() const {
        std::vector<LoadShare> result;
        for (const LoadPart& part : load_.parts) {
            const LoadPoint* point = find(part.on);
            const std::size_t body = load_.is_one_body() ? 0 : place_of(part.on);
            LoadShare share{&part, body, vector(part.force), vector(part.moment)};
            if (part.force) share.moment = moment(point != nullptr ? vector(point->at) : vector(part.at), share.force);
            result.push_back(share);
            if (!part.against.empty())
                result.push_back({&part, place_of(part.against), opposite(share.force), opposite(share.moment)});
        }
        for (const Bar& bar : load_.bars) {
            const SpaceVector along = direction(bar);
            const ex per_length = unknowns_.at(bar.name) / length(along);
            for (const std::size_t end : {0, 1}) {
                const LoadPoint& point = *find(bar.between[end].first);
                SpaceVector force = along;
                for (ex& component : force) component *= end == 0 ? per_length : ex(-per_length);
                result.push_back({&bar, place_of(point.name), force, moment(vector(point.at), force)});
            }
        }
        return result;
    }

    std::vector<ex> lengths() const {
        std::vector<ex> result;
        for (const Bar& bar : load_.bars) result.push_back(length(direction(bar)));
        return result;
    }

private:
    SpaceVector vector(const VectorExpression& v) const {
        return {translate_(*v[0], {}, unknowns_), translate_(*v[1], {}, unknowns_), translate_(*v[2], {}, unknowns_)};
    }
    SpaceVector vector(const std::optional<VectorExpression>& v) const { return v ? vector(*v) : SpaceVector{0, 0, 0}; }
    static SpaceVector opposite(const SpaceVector& v) { return {-v[0], -v[1], -v[2]}; }
    SpaceVector moment(const SpaceVector& at, const SpaceVector& force) const { return cross(at - about_, force); }  // (2.37)

    /// From the first point of a bar to the second.
    SpaceVector direction(const Bar& bar) const {
        return vector(find(bar.between[1].first)->at) - vector(find(bar.between[0].first)->at);
    }
    static ex length(const SpaceVector& along) {
        ex square = 0;
        for (const ex& component : along) square += GiNaC::pow(component, 2);
        return GiNaC::sqrt(square);
    }

    const LoadPoint* find(const std::string& name) const {
        const auto found = std::find_if(load_.points.begin(), load_.points.end(), [&](const LoadPoint& p) { return p.name == name; });
        return found == load_.points.end() ? nullptr : &*found;
    }
    std::size_t place_of(const std::string& name) const {
        const LoadPoint* point = find(name);
        const std::string& body = point != nullptr && !point->of.empty() ? point->of : name;
        const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const LoadBody& b) { return b.name == body; });
        return static_cast<std::size_t>(found - bodies_.begin());
    }

    const Load& load_;
    const Translator& translate_;
    const Letters& unknowns_;
    std::vector<LoadBody> bodies_;
    SpaceVector about_;
};

}  // namespace

std::vector<LoadBody> load_bodies(const Load& load) {
    if (load.is_one_body()) return {{}};
    std::vector<LoadBody> result;
    for (const auto& [name, place] : load.bodies) result.push_back({name});
    for (const LoadPoint& point : load.points)
        if (point.of.empty()) result.push_back({point.name, true});
    return result;
}

std::vector<LoadShare> load_shares(const Load& load, const Translator& translate, const Letters& unknowns) {
    return LoadReading(load, translate, unknowns).shares();
}

std::vector<ex> bar_lengths(const Load& load, const Translator& translate, const Letters& unknowns) {
    return LoadReading(load, translate, unknowns).lengths();
}

}  // namespace dalembert

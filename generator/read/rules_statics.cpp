// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "elements/statics.hpp"
#include "read/rules.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// What a solid that is put together does not have itself.
void check_composed(const Entry& e) {
    for (const char* key : {"size", "radius", "inner_radius", "height", "top_radius", "density", "mass"})
        if (e.has(key))
            e.error(Id::not_allowed_here, e.span_of(key),
                    fmt::format("solid '{}' consists of other solids, which have their own {}; leave it out here", e.name(), key));
}

void check_shape(const Entry& e, const Solid& solid) {
    if (solid.shape == Solid::Shape::point) return;
    if (e.has("density") == e.has("mass"))
        e.error(Id::missing_key, e.has("mass") ? e.span_of("mass") : e.span(),
                fmt::format("solid '{}' needs either a density or a mass, and not both", e.name()));
    const bool is_flat = solid.size && (*solid.size)[2]->kind == Expression::Kind::number && is_zero((*solid.size)[2]->value);
    if (is_flat)
        e.error(Id::wrong_type, e.span_of("size"), fmt::format("the size of box '{}' is three lengths, none of them zero", e.name()));
}

/// The names of bodies and points in a load, and what each key may name.
class LoadRules {
public:
    LoadRules(const Entry& e, const Load& load) : e_(e), load_(load) {}

    void check() const {
        for (const LoadPoint& point : load_.points) check(point);
        for (const Bar& bar : load_.bars) check(bar);
        for (const LoadPart& part : load_.parts) check(part);
    }

private:
    const LoadPoint* point(const std::string& name) const {
        const auto found = std::find_if(load_.points.begin(), load_.points.end(), [&](const LoadPoint& p) { return p.name == name; });
        return found == load_.points.end() ? nullptr : &*found;
    }
    bool is_body(const std::string& name) const {
        return std::any_of(load_.bodies.begin(), load_.bodies.end(), [&](const auto& body) { return body.first == name; });
    }
    /// The body or joint that a name stands for.
    const std::string& carrier(const std::string& name) const {
        const LoadPoint* at = point(name);
        return at != nullptr && !at->of.empty() ? at->of : name;
    }

    enum Kinds { bodies = 1, points = 2 };
    void unknown(const Span& place, int kinds, const std::string& name) const {
        static constexpr const char* words[]{"", "body", "point", "body or point"};
        const char* what = words[kinds];
        std::vector<std::string> known;
        if ((kinds & bodies) != 0)
            for (const auto& body : load_.bodies) known.push_back(body.first);
        if ((kinds & points) != 0)
            for (const LoadPoint& p : load_.points) known.push_back(p.name);
        e_.error(Id::unknown_name, place, fmt::format("load '{}' has no {} '{}'{}", e_.name(), what, name, did_you_mean(name, known)));
    }

    void check(const LoadPoint& p) const {
        if (is_body(p.name))
            e_.error(Id::doubly_defined, p.span, fmt::format("load '{}' has a body and a point '{}'", e_.name(), p.name));
        if (!p.of.empty() && !is_body(p.of)) unknown(p.span, bodies, p.of);
    }

    void check(const Bar& bar) const {
        if (bar.between.size() != 2)
            return e_.error(Id::wrong_arguments, bar.span,
                            fmt::format("bar '{}' of load '{}' joins two points, not {}", bar.name, e_.name(), bar.between.size()));
        for (const auto& [name, place] : bar.between)
            if (point(name) == nullptr) return unknown(place, points, name);
        const std::string &from = carrier(bar.between[0].first), &to = carrier(bar.between[1].first);
        if (from != to) return;
        e_.error(Id::not_allowed_here, bar.span,
                 is_body(from) ? fmt::format("bar '{}' joins two points of body '{}', which is rigid: its force has no effect", bar.name,
                                             from)
                               : fmt::format("bar '{}' begins and ends at '{}'", bar.name, from));
    }

    void check(const LoadPart& part) const {
        const std::string owner = fmt::format("{} '{}' of load '{}'", noun_of(part), part.name, e_.name());
        if (load_.is_one_body()) {
            if (!part.on.empty() || !part.against.empty())
                e_.error(Id::not_allowed_here, part.span,
                         fmt::format("{} says on what it acts, but the load is one body; name several with 'bodies' or 'points'", owner));
            return;
        }
        if (part.on.empty())
            return e_.error(Id::missing_key, part.span,
                            fmt::format("{} needs 'on': the body or point that it acts on, since the load has several", owner));
        const LoadPoint* on = point(part.on);
        if (on == nullptr && !is_body(part.on)) return unknown(part.span, bodies | points, part.on);
        if (on != nullptr && part.at)
            e_.error(Id::not_allowed_here, part.span,
                     fmt::format("{} acts on point '{}', which has a place; leave out 'at'", owner, part.on));
        if (on != nullptr && on->of.empty() && part.moment)
            e_.error(Id::not_allowed_here, part.span,
                     fmt::format("{} acts on joint '{}', but bars are hinged to a joint, which takes no moment", owner, part.on));
        if (part.against.empty()) return;
        if (!is_body(part.against)) return unknown(part.span, bodies, part.against);
        if (carrier(part.on) == part.against)
            e_.error(Id::not_allowed_here, part.span, fmt::format("{} acts on body '{}' and against it", owner, part.against));
    }

    const Entry& e_;
    const Load& load_;
};

}  // namespace

void check_rules(const Entry& e, Solid& solid) {
    if (e.has("shape") == e.has("of")) return;
    if (e.has("without") && !e.has("of"))
        e.error(Id::not_allowed_here, e.span_of("without"),
                fmt::format("solid '{}' has a shape and takes no 'without'; make another solid with 'of' and 'without'", e.name()));
    if (e.has("shape")) check_shape(e, solid);
    else check_composed(e);
    if (e.has("of") && solid.of.empty())
        e.error(Id::missing_key, e.span_of("of"), fmt::format("solid '{}' is empty; 'of' needs at least one solid", e.name()));
}

void check_rules(const Entry& e, Load& load) {
    for (const Bar& bar : load.bars) {
        Unknown& force = load.unknowns.emplace_back();
        static_cast<Item&>(force) = bar;
        force.unit = Unit{Dimension::force(), 1, 0, 0, "N"};
    }
    for (Unknown& unknown : load.unknowns) unknown.when = load.when;
    LoadRules(e, load).check();
    if (e.has("forces") && load.parts.empty())
        e.error(Id::missing_key, e.span_of("forces"), fmt::format("load '{}' has no force", e.name()));
}

void check_rules(const Entry& e, Sticking& sticking) {
    const bool is_rope = e.has("tensions") || e.has("angle");
    const bool is_surface = e.has("normal") || e.has("tangential");
    if (is_rope == is_surface || e.has("tensions") != e.has("angle") || e.has("normal") != e.has("tangential"))
        return e.error(
            Id::missing_key, e.span(),
            fmt::format("sticking '{}' needs either normal and tangential force of a surface, or the tensions of a rope and its angle",
                        e.name()));
    if (is_rope && sticking.tensions.size() != 2)
        e.error(Id::wrong_type, e.span_of("tensions"),
                fmt::format("the rope of sticking '{}' has two ends, so it has 2 tensions, not {}", e.name(), sticking.tensions.size()));
}

}  // namespace dalembert

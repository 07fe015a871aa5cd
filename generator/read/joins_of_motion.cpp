// SPDX-License-Identifier: GPL-3.0-or-later
// Joins of shafts and flanges: of two coordinates one goes, or follows an expression, or a constraint holds both together.
#include "check/checks.hpp"
#include "elements/rename.hpp"
#include "language/expression_text.hpp"
#include "read/join_work.hpp"

namespace dalembert {

namespace {

bool is_same_value(const Expression& one, const Expression& other) {
    constexpr auto number = Expression::Kind::number;
    if (one.kind == number && other.kind == number) return one.value == other.value;
    return in_model_language(one) == in_model_language(other);
}

bool is_same_value(const MemberValues& one, const MemberValues& other) {
    return one.is_list == other.is_list && std::equal(one.begin(), one.end(), other.begin(), other.end(),
                                                      [](const ExpressionPtr& a, const ExpressionPtr& b) { return is_same_value(*a, *b); });
}

/// Two coordinates of parts become one, and neither part counts more than the other: what both say must agree, and what one alone says
/// holds for both.
class Agreement {
public:
    Agreement(Coordinate& staying, const Coordinate& going, const Span& place) : staying_(staying), going_(going), place_(place) {}

    void run() {
        agree(&Coordinate::start, "starts");
        agree(&Coordinate::start_rate, "velocities at the start");
        agree(&Coordinate::guess, "guesses of the start");
        if (!staying_.start.empty()) staying_.guess.clear();
        if (going_.range) both_ranges();
    }

private:
    /// Numbers are in SI since they were read.
    void agree(MemberValues Coordinate::*value, const char* what) {
        const MemberValues &going = going_.*value, &staying = staying_.*value;
        if (staying.empty()) staying_.*value = going;
        if (!going.empty() && !is_same_value(going, staying))
            fail(Id::doubly_defined, place_,
                 fmt::format("'{}' and '{}' become one coordinate, but have different {}; join both to a coordinate of this file, or give "
                             "one of them the value of the other with 'start'",
                             going_.name, staying_.name, what),
                 {{going.span, fmt::format("that of '{}' stands here", going_.name)},
                  {staying.span, fmt::format("that of '{}' stands here", staying_.name)}});
    }

    /// The coordinate is where both may be.
    void both_ranges() {
        if (!staying_.range) staying_.range = Range{nullptr, nullptr, going_.range->span};
        both_bounds(staying_.range->low, going_.range->low, "max");
        both_bounds(staying_.range->high, going_.range->high, "min");
    }
    static void both_bounds(ExpressionPtr& staying, const ExpressionPtr& going, const char* tighter) {
        if (going && !staying) staying = going;
        if (going && !is_same_value(*going, *staying))
            staying = std::make_shared<Expression>(Expression{Expression::Kind::call, staying->span, 0, tighter, {staying, going}});
    }

    Coordinate& staying_;
    const Coordinate& going_;
    Span place_;
};

}  // namespace

Joins::Motion Joins::motion(ExpressionPtr place) const {
    Motion made{std::move(place)};
    if (made.place->kind == Expression::Kind::name && made.place->children.empty())
        made.coordinate = find(model_.coordinates, made.place->name);
    made.can_go = made.coordinate != nullptr && made.coordinate->span.source != model_.source;
    return made;
}

Joins::Motion Joins::motion(const PartPort& port) const {
    return motion(port.port.coordinate ? make_name(port.port.coordinate->name, port.port.coordinate->span) : port.port.value);
}

void Joins::join_motion(PartPort& port, PartPort* other, const RunEntry& entry) {
    const Motion mine = motion(port), theirs = other != nullptr ? motion(*other) : motion(entry.value);
    // Where only expressions name a coordinate, a definition can take its place.
    const auto can_follow = [&](const Motion& motion) {
        return motion.can_go && !is_named_as_coordinate(model_, motion.coordinate->name);
    };
    if (mine.coordinate != nullptr && theirs.coordinate != nullptr) {
        if (mine.coordinate == theirs.coordinate) return;
        if (mine.coordinate->unit.dimension != theirs.coordinate->unit.dimension)
            fail(Id::unit_mismatch, entry.value->span,
                 fmt::format("'{}' counts in {}, but '{}' in {}", shown(port), mine.coordinate->unit.written, entry.value->written(),
                             theirs.coordinate->unit.written),
                 {{mine.coordinate->span, "that of the part is declared here"},
                  {theirs.coordinate->span, "the other one is declared here"}});
        if (mine.can_go) return become_one(port, mine, theirs, entry);
        if (theirs.can_go) return become_one(port, theirs, mine, entry);
    }
    if (can_follow(mine)) return follow(port, mine, theirs, entry);
    if (other != nullptr && can_follow(theirs)) return follow(*other, theirs, mine, entry);
    constrain(port, mine, theirs, entry);
}

void Joins::become_one(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry) {
    const std::string name = going.coordinate->name, by = staying.coordinate->name;
    if (staying.can_go) {
        Agreement(*staying.coordinate, *going.coordinate, entry.span).run();
        for (auto set = set_starts_.extract(name); !set.empty(); set = set_starts_.extract(name)) {
            set.key() = by;
            set_starts_.insert(std::move(set));
        }
    } else {
        refuse_lost_start(port, going, staying, entry);
    }
    stand_for(name, make_name(by, staying.place->span));
    std::erase_if(model_.coordinates, [&](const Coordinate& item) { return item.name == name; });
    tell(port, fmt::format("coordinate '{}' is '{}'", name, by));
}

void Joins::follow(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry) {
    refuse_lost_start(port, going, staying, entry);
    tell(port, fmt::format("coordinate '{}' is '{}'", going.coordinate->name, shown(*staying.place)));
    define(*going.coordinate, staying.place, entry.span);
    std::erase_if(model_.coordinates, [&, name = going.coordinate->name](const Coordinate& item) { return item.name == name; });
}

/// A start that [use] sets for a coordinate that goes would not count.
void Joins::refuse_lost_start(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry) {
    if (const auto set = set_starts_.find(going.coordinate->name); set != set_starts_.end())
        fail(Id::doubly_defined, set->second,
             fmt::format("the start of '{}' is set here, but it follows from '{}', to which '{}' is joined; leave it out",
                         going.coordinate->name, shown(*staying.place), shown(port)),
             {{entry.span, "the port is joined here"}});
}

void Joins::constrain(const PartPort& port, const Motion& mine, const Motion& theirs, const RunEntry& entry) {
    Constraint constraint;
    constraint.name = port.port.name;
    constraint.span = entry.span;
    constraint.doc = fmt::format("joins '{}'", shown(port));
    constraint.position = make_binary(Expression::Kind::subtract, mine.place, theirs.place);
    model_.constraints.push_back(std::move(constraint));
    tell(port, fmt::format("constraint '{0}' holds it there, because no coordinate can go; constraint_force[{0}] is its force",
                           port.port.name));
}

/// Inserts `by` for the name, also in expressions that already stand for other names.
void Joins::stand_for(const std::string& name, const ExpressionPtr& by) {
    Renaming now;
    now.values[name] = by;
    for (auto& [other, value] : everywhere_.values) value = renamed(value, now);
    everywhere_.values[name] = by;
    for (PartPort& port : ports_)
        if (port.port.coordinate && port.port.coordinate->name == name) port.port.coordinate->name = by->name;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/sites.hpp"

#include <fmt/format.h>

#include "elements/describe_fluids.hpp"
#include "elements/describe_heat.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

namespace {

/// Visits the expressions of one item; null expressions are skipped.
class Visit {
public:
    Visit(const Item& item, const char* kind, const SiteVisitor& visitor) : visitor_(visitor), owner_(fmt::format("{} '{}'", kind, item.name)) {
        if (!item.family) return;
        for (const ExpressionPtr& bound : {item.family->from, item.family->to})
            visitor_({bound.get(), constant_only, "the members of " + owner_, {}, true});
        bound_.push_back(item.family->index);
    }
    Visit(std::string owner, const SiteVisitor& visitor) : visitor_(visitor), owner_(std::move(owner)) {}

    void operator()(const ExpressionPtr& expression, unsigned allowed, const char* part) const {
        if (expression) visitor_({expression.get(), allowed, fmt::format("the {} of {}", part, owner_), bound_});
    }
    void operator()(const std::optional<VectorExpression>& vector, unsigned allowed, const char* part) const {
        if (!vector) return;
        for (const ExpressionPtr& component : *vector) (*this)(component, allowed, part);
    }
    void operator()(const std::optional<Law>& law, unsigned allowed, const char* part) const {
        if (!law) return;
        std::vector<std::string> bound = bound_;
        bound.push_back(law->variable);
        visitor_({law->body.get(), allowed, fmt::format("the {} of {}", part, owner_), bound});
    }
    void operator()(const std::optional<Property>& property, unsigned allowed, const char* part) const {
        if (!property) return;
        std::vector<std::string> bound = bound_;
        bound.insert(bound.end(), property->variables.begin(), property->variables.end());
        visitor_({property->body.get(), allowed, fmt::format("the {} of {}", part, owner_), bound, false, false, true});
    }
    void operator()(const Reference& part) const {
        if (part.index) visitor_({part.index.get(), constant_only, fmt::format("the index of '{}'", part.name), bound_, true});
    }
    void operator()(const std::optional<Reference>& body) const {
        if (body && body->index) visitor_({body->index.get(), constant_only, fmt::format("the index of '{}'", body->name), bound_, true});
    }
    void operator()(const CoordinateEntry& entry, unsigned allowed, const char* part) const {
        if (entry.index) visitor_({entry.index.get(), constant_only, fmt::format("the index of '{}'", entry.coordinate), bound_, true});
        (*this)(entry.value, allowed, part);
    }
    void operator()(const std::vector<RunEntry>& resets) const {
        for (const RunEntry& entry : resets) {
            (*this)(entry.variable, on_coordinates | on_velocities | on_states, "reset");
            (*this)(entry.value, on_state_and_inputs, "reset");
        }
    }
    void operator()(const std::optional<Range>& range) const {
        if (!range) return;
        (*this)(range->low, nothing, "range");
        (*this)(range->high, nothing, "range");
    }

    const SiteVisitor& visitor_;
    std::string owner_;
    std::vector<std::string> bound_;
};

/// Visits the expressions of an item by its description.
class DescribedSites {
public:
    DescribedSites(const Visit& each, std::string prefix) : each_(each), prefix_(std::move(prefix)) {}

    void operator()(const char* name, const ExpressionPtr& expression, const Key& key) const {
        if (!expression) return;
        each_.visitor_({expression.get(), key.depends, fmt::format("the {}{} of {}", prefix_, words_of(name, key), each_.owner_), each_.bound_, false, key.may_be_absent});
    }
    void operator()(const char*, const Reference& reference, const Key&) const { each_(reference); }
    void operator()(const char*, const std::optional<bool>&, const Key&) const {}
    void operator()(const char* name, const std::optional<Law>& law, const Key& key) const { each_(law, key.depends, words_of(name, key).c_str()); }
    void operator()(const char* name, const std::optional<Property>& property, const Key& key) const {
        each_(property, key.depends, words_of(name, key).c_str());
    }
    void choice(const char*, const Key&) const {}
    template <class Part>
    void table(const char*, const std::optional<Part>& part, const Key& key) const {
        if (!part) return;
        const DescribedSites inside(each_, key.words == nullptr ? "" : std::string(key.words) + " ");
        describe(inside, *part);
    }
    void item(const ItemKeys&) const {}

private:
    const Visit& each_;
    std::string prefix_;
};

template <class Described>
void visit_described(const Described& item, const SiteVisitor& visitor) {
    const Visit each(item, kind_of<Described>.word, visitor);
    const DescribedSites sites(each, "");
    describe(sites, item);
}

}  // namespace

void visit(const Size& item, const SiteVisitor& visitor) {
    const Visit each(item, "size", visitor);
    visitor({item.value.get(), constant_only, "the value of " + each.owner_, {}, true});
    each(item.range);
}

void visit(const Parameter& item, const SiteVisitor& visitor) {
    const Visit each(item, "parameter", visitor);
    for (const ExpressionPtr& value : item.values) each(value, nothing, "value");
    each(item.range);
}

void visit(const Definition& item, const SiteVisitor& visitor) {
    Visit(item, "definition", visitor)(item.value, on_state_and_inputs | on_places, "value");
}

void visit(const Coordinate& item, const SiteVisitor& visitor) {
    const Visit each(item, "coordinate", visitor);
    each(item.start, constant_only, "start");
    each(item.start_rate, constant_only, "start rate");
    each(item.range);
}

void visit(const Input& item, const SiteVisitor& visitor) { Visit(item, "input", visitor)(item.range); }

void visit(const State& item, const SiteVisitor& visitor) {
    const Visit each(item, "state", visitor);
    each(item.start, constant_only, "start");
    each(item.derivative, on_state_and_inputs | on_places, "derivative");
    each(item.range);
}

void visit(const Output& item, const SiteVisitor& visitor) {
    Visit(item, "output", visitor)(item.value, on_anything & ~on_outputs, "value");
}

void visit(const Gravity& item, const SiteVisitor& visitor) {
    const Visit each("gravity", visitor);
    each(item.acceleration, constant_only, "acceleration");
    each(item.reference, constant_only, "reference");
}

void visit(const Attitude& item, const SiteVisitor& visitor) {
    const Visit each(item, "attitude", visitor);
    for (const ExpressionPtr& part : item.start) each(part, constant_only, "start");
    for (const ExpressionPtr& rate : item.start_rate) each(rate, constant_only, "start rate");
}

void visit(const Body& item, const SiteVisitor& visitor) {
    const Visit each(item, "body", visitor);
    each(item.mass, on_parameters | on_states, "mass");
    each(item.position, on_configuration, "position");
    each(item.rotation, on_configuration, "rotation");
    each(item.angular_velocity, on_motion, "angular velocity");
    each(item.inertia, on_parameters | on_states, "inertia");
    for (const auto& row : item.tensor)
        for (const ExpressionPtr& moment : row) each(moment, on_parameters | on_states, "inertia");
    for (const Turn& turn : item.turns) each(turn.angle, on_configuration, "turns");
    each(item.origin, on_configuration, "origin");
    each(item.centre, on_configuration, "centre");
    each(item.on);
}

void visit(const Solid& item, const SiteVisitor& visitor) {
    const Visit each(item, "solid", visitor);
    each(item.size, constant_only, "size");
    each(item.radius, constant_only, "radius");
    each(item.inner_radius, constant_only, "inner radius");
    each(item.top_radius, constant_only, "radius at the top");
    each(item.height, constant_only, "height");
    if (item.density) visitor({item.density.get(), constant_only, "the density of " + each.owner_, {"x", "y", "z"}, false, false, true});
    each(item.mass, constant_only, "mass");
    each(item.at, constant_only, "place");
    for (const Turn& turn : item.turns) each(turn.angle, constant_only, "turns");
}

void visit(const Load& item, const SiteVisitor& visitor) {
    const Visit each(item, "load", visitor);
    constexpr unsigned anything = on_anything & ~on_outputs;
    each(item.about, anything, "point of reference");
    for (const LoadPart& part : item.parts) {
        const auto named = [&](const char* what) { return fmt::format("{} '{}'", what, part.name); };
        each(part.at, anything, named("point of force").c_str());
        each(part.force, anything, named("force").c_str());
        each(part.moment, anything, named("moment").c_str());
    }
}

void visit(const Sticking& item, const SiteVisitor& visitor) {
    const Visit each(item, "sticking", visitor);
    constexpr unsigned anything = on_anything & ~on_outputs;
    each(item.normal, anything, "normal force");
    for (const ExpressionPtr& force : item.tangential) each(force, anything, "tangential force");
    for (const ExpressionPtr& force : item.tensions) each(force, anything, "tensions");
    each(item.angle, anything, "angle");
    each(item.coefficient, anything, "coefficient");
}

void visit(const Cut& item, const SiteVisitor& visitor) {
    const Visit each(item, "cut", visitor);
    for (const Reference& body : item.bodies) each(body);
    each(item.direction, on_configuration | on_places, "direction");
    each(item.about, on_configuration | on_places, "point");
}

void visit(const Spring& item, const SiteVisitor& visitor) {
    const Visit each(item, "spring", visitor);
    each(item.elongation, on_configuration | on_places, "elongation");
    each(item.stiffness, constant_only, "stiffness");
    each(item.force, constant_only, "force law");
    each(item.energy, constant_only, "energy law");
}

void visit(const Damper& item, const SiteVisitor& visitor) {
    const Visit each(item, "damper", visitor);
    each(item.rate, on_motion | on_places, "rate");
    each(item.on);
    each(item.coefficient, on_state_and_inputs | on_places, "coefficient");
    each(item.force, on_state_and_inputs | on_places, "force law");
}

void visit(const Force& item, const SiteVisitor& visitor) {
    const Visit each(item, "force", visitor);
    each(std::optional(item.force), on_state_and_inputs | on_places, "vector");
    each(item.on);
    each(item.at, on_configuration | on_places, "point");
}

void visit(const Torque& item, const SiteVisitor& visitor) {
    const Visit each(item, "torque", visitor);
    each(item.torque, on_state_and_inputs | on_places, "value");
    each(item.vector, on_state_and_inputs | on_places, "value");
    each(item.on);
    each(item.against);
    each(item.rate, on_motion | on_places, "rate");
}

void visit(const Jet& item, const SiteVisitor& visitor) {
    const Visit each(item, "jet", visitor);
    each(item.from);
    each(item.mass_flow, on_state_and_inputs | on_places, "mass flow");
    each(std::optional(item.velocity), on_state_and_inputs | on_places, "velocity");
}

void visit(const KineticTerm& item, const SiteVisitor& visitor) {
    Visit(item, "kinetic term", visitor)(item.energy, on_parameters | on_coordinates | on_velocities, "energy");
}

void visit(const PotentialTerm& item, const SiteVisitor& visitor) {
    const Visit each(item, "potential", visitor);
    each(item.energy, on_motion | on_places, "energy");
    for (const CoordinateEntry& entry : item.forces) each(entry, on_parameters | on_coordinates, "forces");
    for (const CoordinateEntry& entry : item.reference) each(entry, constant_only, "reference");
}

void visit(const GeneralisedForce& item, const SiteVisitor& visitor) {
    Visit(item, "generalised force", visitor)(item.coordinate, on_state_and_inputs | on_places, "force");
}

void visit(const Medium& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Reservoir& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Junction& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Volume& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Flow& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const HeatNode& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Link& item, const SiteVisitor& visitor) { visit_described(item, visitor); }
void visit(const Rod& item, const SiteVisitor& visitor) { visit_described(item, visitor); }

void visit(const Block& item, const SiteVisitor& visitor) {
    const Visit each(item, "block", visitor);
    for (const auto* pieces : {&item.columns, &item.rows})
        for (const BlockPiece& piece : *pieces) {
            each(piece.length, constant_only, "piece lengths");
            if (piece.cells) visitor({piece.cells.get(), constant_only, "the cells of " + each.owner_, {}, true});
        }
    each(item.depth, constant_only, "depth");
    for (const auto& [table, part] : {std::pair(&item.conductivity, "conductivity"), std::pair(&item.density, "density"), std::pair(&item.heat_capacity, "heat capacity")})
        for (const auto& column : *table)
            for (const ExpressionPtr& value : column) each(value, constant_only, part);
    each(item.source, on_plain_states_and_inputs, "source");
    const DescribedSites sides(each, "side ");
    for (const auto* side : {&item.left, &item.right, &item.bottom, &item.top}) {
        if (!*side) continue;
        describe(sides, **side);
        each((*side)->node);
    }
}

void visit(const Enclosure& item, const SiteVisitor& visitor) {
    const Visit each(item, "enclosure", visitor);
    for (const Reference& surface : item.surfaces) each(surface);
    for (const ExpressionPtr& emissivity : item.emissivities) each(emissivity, on_plain_states_and_inputs, "emissivities");
    for (const ExpressionPtr& area : item.areas) each(area, on_plain_states_and_inputs, "areas");
    for (const auto& row : item.view_factors)
        for (const ExpressionPtr& factor : row) each(factor, on_plain_states_and_inputs, "view factors");
    for (const auto& corner : item.polygon)
        for (const ExpressionPtr& coordinate : corner) each(coordinate, constant_only, "polygon");
    each(item.height, constant_only, "height");
}

void visit(const Constraint& item, const SiteVisitor& visitor) {
    const Visit each(item, "constraint", visitor);
    each(item.rate, on_motion | on_places, "rate");
    each(item.position, on_configuration | on_places, "position");
    each(item.eliminates);
    each(item.elsewhere, on_state_and_inputs | on_places, "force");
    each(item.share, on_states, "share");
}

void visit(const Event& item, const SiteVisitor& visitor) {
    const Visit each(item, "event", visitor);
    each(item.guard, on_anything & ~on_outputs, "guard");
    each(item.meets);
    each(item.restitution, constant_only, "restitution");
    each(item.reset);
    each(item.rest_reset);
}

void visit(const Friction& item, const SiteVisitor& visitor) {
    const Visit each(item, "friction", visitor);
    each(item.rate, on_motion | on_places, "rate");
    each(item.normal_force, on_state_and_inputs | on_places, "normal force");
    each(item.coefficient, on_state_and_inputs | on_places, "coefficient");
    each(item.static_coefficient, on_state_and_inputs | on_places, "static coefficient");
}

void visit(const Stop& item, const SiteVisitor& visitor) {
    const Visit each(item, "stop", visitor);
    each(item.gap, on_configuration | on_places, "gap");
    each(item.restitution, constant_only, "restitution");
}

void visit(const Contact& item, const SiteVisitor& visitor) {
    const Visit each(item, "contact", visitor);
    each(item.elongation, on_configuration | on_places, "elongation");
    each(item.stiffness, constant_only, "stiffness");
    each(item.damping, on_state_and_inputs | on_places, "damping");
    each(item.play, constant_only, "play");
}

void visit(const Saturation& item, const SiteVisitor& visitor) {
    const Visit each(item, "saturation", visitor);
    each(item.value, on_state_and_inputs | on_places, "value");
    each(item.low, on_state_and_inputs | on_places, "lower limit");
    each(item.high, on_state_and_inputs | on_places, "upper limit");
}

void visit(const Profile& item, const SiteVisitor& visitor) {
    const Visit each(item, "profile", visitor);
    for (const Phase& phase : item.phases) {
        each(phase.value, on_state_and_inputs | on_places, "values");
        each(phase.until, on_state_and_inputs, "times");
        each(phase.reset);
    }
}

void visit(const PrintedEquation& item, const SiteVisitor& visitor) {
    Visit each(item, "printed equation", visitor);
    for (const PrintedLetter& letter : item.letters) each.bound_.push_back(letter.name);
    if (!item.solved.empty())
        for (const Equation& equation : item.equations) each.bound_.push_back(equation.sides[0]->name);
    for (const PrintedLetter& letter : item.letters) each(letter.value, on_anything, "letters");
    for (const Equation& equation : item.equations)
        for (const ExpressionPtr& side : equation.sides) each(side, on_anything, "sides");
    for (const Equation& equation : item.solved)
        for (const ExpressionPtr& side : equation.sides) each(side, on_anything, "equations to be solved");
    for (const AtPoint& at : item.at) {
        each(at.variable, on_anything, "point");
        each(at.value, on_anything, "point");
    }
}

void visit(const Run& item, const SiteVisitor& visitor) {
    const Visit each(item, "run", visitor);
    each(item.until, constant_only, "end");
    each(item.period, constant_only, "period");
    each(item.step, constant_only, "step");
    for (const RunEntry& entry : item.start) {
        each(entry.variable, on_parameters | on_coordinates | on_velocities | on_states, "start");
        each(entry.value, constant_only, "start");
    }
    for (const RunEntry& entry : item.inputs) {
        each(entry.variable, on_inputs, "inputs");
        each(entry.value, on_motion | on_states, "inputs");
    }
    for (const RunEntry& entry : item.parameters) {
        each(entry.variable, on_parameters, "parameters");
        each(entry.value, constant_only, "parameters");
    }
    for (const RunEntry& entry : item.exact) {
        each(entry.variable, on_coordinates | on_velocities | on_states | on_outputs, "closed forms");
        each(entry.value, on_parameters | on_time, "closed forms");
    }
}

void visit(const Model& model, const SiteVisitor& visitor) {
    const auto walk = [&](const auto& item) {
        if constexpr (requires { item.is_made; })
            if (item.is_made) return;
        visit(item, visitor);
    };
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        if constexpr (std::is_same_v<Items, std::optional<Gravity>>) {
            if (items) walk(*items);
        } else if constexpr (!std::is_same_v<Items, std::vector<ModeGroup>>) {
            for (const auto& item : items) walk(item);
        }
    });
}

}  // namespace dalembert

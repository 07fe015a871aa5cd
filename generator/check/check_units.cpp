// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "check/units.hpp"
#include "elements/describe_fluids.hpp"
#include "elements/describe_heat.hpp"

namespace dalembert {

namespace {

/// What the description of an item says about units.
class DescribedUnits {
public:
    DescribedUnits(Units& units, std::string owner, std::string prefix) : units_(units), owner_(std::move(owner)), prefix_(std::move(prefix)) {}

    void operator()(const char* name, const ExpressionPtr& expression, const Key& key) const {
        if (!expression) return;
        if (key.dimension) expect(name, *expression, key, {});
        else units_.of(*expression, {});
    }
    void operator()(const char*, const Reference&, const Key&) const {}
    void operator()(const char*, const std::optional<bool>&, const Key&) const {}
    void operator()(const char* name, const std::optional<Law>& law, const Key& key) const {
        if (law) expect(name, *law->body, key, {{law->variable, key.variables[0]}});
    }
    void operator()(const char* name, const std::optional<Property>& property, const Key& key) const {
        if (!property) return;
        Units::Bound bound;
        for (std::size_t i = 0; i < property->variables.size(); ++i) bound.emplace(property->variables[i], key.variables[i]);
        expect(name, *property->body, key, bound);
    }
    void choice(const char*, const Key&) const {}
    template <class Part>
    void table(const char*, const std::optional<Part>& part, const Key& key) const {
        if (!part) return;
        const DescribedUnits inside(units_, owner_, key.words == nullptr ? "" : std::string(key.words) + " ");
        describe(inside, *part);
    }
    void item(const ItemKeys&) const {}

private:
    void expect(const char* name, const Expression& expression, const Key& key, const Units::Bound& bound) const {
        units_.expect(expression, *key.dimension, fmt::format("the {}{} of {}", prefix_, words_of(name, key), owner_), bound);
    }

    Units& units_;
    std::string owner_, prefix_;
};

/// What every kind of item must be in. Values of what is declared in a unit are checked where they are converted.
class UnitCheck {
public:
    UnitCheck(const Model& model, const Names& names, Diagnostics& diagnostics)
        : model_(model), units_(names, diagnostics), names_(names), diagnostics_(diagnostics) {}

    void run() {
        for (const Size& size : model_.sizes) expect(size.value, Dimension::none(), "the value", "size", size);
        for (const Definition& definition : model_.definitions) {
            if (definition.is_made) continue;
            if (definition.unit) expect(definition.value, definition.unit->dimension, "the value", "definition", definition);
            else units_.of(*definition.value, {});
        }
        for (const State& state : model_.states) expect(state.derivative, state.unit.dimension / Dimension::time(), "the derivative", "state", state);
        for (const Output& output : model_.outputs) {
            if (output.unit) expect(output.value, output.unit->dimension, "the value", "output", output);
            else units_.of(*output.value, {});
        }
        if (model_.gravity) {
            vector(model_.gravity->acceleration, Dimension::acceleration(), "the acceleration of gravity");
            if (model_.gravity->reference) vector(*model_.gravity->reference, Dimension::length(), "the reference of gravity");
        }
        for (const Solid& solid : model_.solids) check(solid);
        for (const Body& body : model_.bodies) check(body);
        for (const Load& load : model_.loads) check(load);
        for (const Sticking& sticking : model_.stickings) check(sticking);
        for (const Cut& cut : model_.cuts) {
            vector(cut.direction, Dimension::none(), fmt::format("the direction of cut '{}'", cut.name));
            if (cut.about) vector(*cut.about, Dimension::length(), fmt::format("the point of cut '{}'", cut.name));
        }
        const auto written = [this](const auto& items) {
            for (const auto& item : items)
                if (!item.is_made) check(item);
        };
        written(model_.springs);
        written(model_.dampers);
        for (const Force& force : model_.forces) {
            vector(force.force, Dimension::force(), fmt::format("force '{}'", force.name));
            if (force.at) vector(*force.at, Dimension::length(), fmt::format("the point of force '{}'", force.name));
        }
        for (const Torque& torque : model_.torques) {
            expect(torque.torque, Dimension::energy(), "the value", "torque", torque);
            if (torque.vector) vector(*torque.vector, Dimension::energy(), fmt::format("torque '{}'", torque.name));
            expect(torque.rate, Dimension::none() / Dimension::time(), "the rate", "torque", torque);
        }
        for (const Jet& jet : model_.jets) {
            expect(jet.mass_flow, Dimension::mass() / Dimension::time(), "the mass flow", "jet", jet);
            vector(jet.velocity, Dimension::speed(), fmt::format("the velocity of jet '{}'", jet.name));
        }
        for (const KineticTerm& term : model_.kinetic) expect(term.energy, Dimension::energy(), "the energy", "kinetic term", term);
        for (const PotentialTerm& term : model_.potentials) {
            expect(term.energy, Dimension::energy(), "the energy", "potential", term);
            for (const CoordinateEntry& entry : term.forces) force_on(entry, "potential", term);
        }
        written(model_.constraints);
        written(model_.events);
        written(model_.frictions);
        written(model_.stops);
        written(model_.contacts);
        written(model_.saturations);
        written(model_.profiles);
        for (const GeneralisedForce& force : model_.generalised_forces) force_on(force.coordinate, "generalised force", force);
        described(model_.media);
        described(model_.reservoirs);
        described(model_.junctions);
        described(model_.volumes);
        described(model_.flows);
        described(model_.nodes);
        described(model_.links);
        described(model_.rods);
        for (const Block& block : model_.blocks) check(block);
        for (const Enclosure& enclosure : model_.enclosures) check(enclosure);
    }

private:
    template <class Described>
    void described(const std::vector<Described>& items) {
        for (const Described& item : items) {
            const DescribedUnits units(units_, fmt::format("{} '{}'", kind_of<Described>.word, item.name), "");
            describe(units, item);
        }
    }

    void expect(const ExpressionPtr& expression, const Dimension& expected, const char* part, const char* kind, const Item& item,
                const Units::Bound& bound = {}) {
        if (expression) units_.expect(*expression, expected, fmt::format("{} of {} '{}'", part, kind, item.name), bound);
    }

    void vector(const VectorExpression& vector, const Dimension& expected, const std::string& what, const Units::Bound& bound = {}) {
        static constexpr const char* axis[]{"x", "y", "z"};
        for (std::size_t i = 0; i < 3; ++i) units_.expect(*vector[i], expected, fmt::format("the {} component of {}", axis[i], what), bound);
    }

    void force_on(const CoordinateEntry& entry, const char* kind, const Item& item) {
        expect(entry.value, Dimension::energy() / units_.of_coordinate(entry.coordinate),
               fmt::format("the force on '{}'", entry.coordinate).c_str(), kind, item);
    }

    void check(const Solid& solid) {
        const auto length = [&](const ExpressionPtr& e, const char* part) { expect(e, Dimension::length(), part, "solid", solid); };
        if (solid.size) vector(*solid.size, Dimension::length(), fmt::format("the size of solid '{}'", solid.name));
        length(solid.radius, "the radius");
        length(solid.inner_radius, "the inner radius");
        length(solid.top_radius, "the radius at the top");
        length(solid.height, "the height");
        const Units::Bound place{{"x", Dimension::length()}, {"y", Dimension::length()}, {"z", Dimension::length()}};
        expect(solid.density, density, "the density", "solid", solid, place);
        expect(solid.mass, Dimension::mass(), "the mass", "solid", solid);
        if (solid.at) vector(*solid.at, Dimension::length(), fmt::format("the place of solid '{}'", solid.name));
        for (const Turn& turn : solid.turns) expect(turn.angle, Dimension::none(), "a turn", "solid", solid);
    }

    void check(const Load& load) {
        Units::Bound unknowns;
        for (const Unknown& unknown : load.unknowns) unknowns[unknown.name] = unknown.unit.dimension;
        if (load.about) vector(*load.about, Dimension::length(), fmt::format("the point of reference of load '{}'", load.name), unknowns);
        for (const LoadPart& part : load.parts) {
            const auto check_part = [&](const std::optional<VectorExpression>& e, const Dimension& expected, const char* what) {
                if (e) vector(*e, expected, fmt::format("{} '{}' of load '{}'", what, part.name, load.name), unknowns);
            };
            check_part(part.at, Dimension::length(), "the point of force");
            check_part(part.force, Dimension::force(), "force");
            check_part(part.moment, Dimension::energy(), "moment");
        }
    }

    void check(const Sticking& sticking) {
        expect(sticking.coefficient, Dimension::none(), "the coefficient", "sticking", sticking);
        expect(sticking.angle, Dimension::none(), "the angle", "sticking", sticking);
        expect(sticking.normal, Dimension::force(), "the normal force", "sticking", sticking);
        for (const auto* forces : {&sticking.tangential, &sticking.tensions})
            for (const ExpressionPtr& force : *forces) expect(force, Dimension::force(), forces == &sticking.tensions ? "a tension" : "the tangential force", "sticking", sticking);
    }

    void check(const Body& body) {
        if (body.solid) return check_placement(body);  // what the solid brings has its units
        expect(body.mass, Dimension::mass(), "the mass", "body", body);
        expect(body.inertia, Dimension::inertia(), "the inertia", "body", body);
        for (const auto& row : body.tensor)
            for (const ExpressionPtr& moment : row) expect(moment, Dimension::inertia(), "the inertia", "body", body);
        check_placement(body);
    }

    void check_placement(const Body& body) {
        if (body.position) vector(*body.position, Dimension::length(), fmt::format("the position of body '{}'", body.name));
        expect(body.rotation, Dimension::none(), "the rotation", "body", body);
        expect(body.angular_velocity, Dimension::none() / Dimension::time(), "the angular velocity", "body", body);
        for (const Turn& turn : body.turns) expect(turn.angle, Dimension::none(), "a turn", "body", body);
        if (body.origin) vector(*body.origin, Dimension::length(), fmt::format("the origin of body '{}'", body.name));
        if (body.centre) vector(*body.centre, Dimension::length(), fmt::format("the centre of body '{}'", body.name));
    }

    void check(const Spring& spring) {
        const Dimension elongation = units_.of(*spring.elongation, {}).dimension;
        expect(spring.stiffness, Dimension::energy() / elongation / elongation, "the stiffness", "spring", spring);
        law(spring.force, elongation, Dimension::energy() / elongation, "the force law", "spring", spring);
        law(spring.energy, elongation, Dimension::energy(), "the energy law", "spring", spring);
    }

    void check(const Damper& damper) {
        const Dimension rate = damper.rate ? units_.of(*damper.rate, {}).dimension : Dimension::speed();
        expect(damper.coefficient, Dimension::power() / rate / rate, "the coefficient", "damper", damper);
        law(damper.force, rate, Dimension::power() / rate, "the force law", "damper", damper);
    }

    void check(const Constraint& constraint) {
        for (const ExpressionPtr& held : {constraint.rate, constraint.position})
            if (held) units_.of(*held, {});
    }

    void check(const Event& event) {
        units_.of(*event.guard, {});
        expect(event.restitution, Dimension::none(), "the restitution", "event", event);
        reset(event.reset, "event", event);
        reset(event.rest_reset, "event", event);
    }

    void reset(const std::vector<RunEntry>& entries, const char* kind, const Item& item) {
        for (const RunEntry& entry : entries) expect(entry.value, units_.of(*entry.variable, {}).dimension, fmt::format("the new value of '{}'", entry.variable->written()).c_str(), kind, item);
    }

    void check(const Friction& friction) {
        const Dimension force = Dimension::power() / units_.of(*friction.rate, {}).dimension;
        const Measure normal = units_.of(*friction.normal_force, {});
        const Measure sliding = units_.of(*friction.coefficient, {});
        if (!normal.fits_all && !sliding.fits_all && normal.dimension * sliding.dimension != force)
            diagnostics_.error(Id::unit_mismatch, friction.coefficient->span,
                               fmt::format("along its rate, friction '{}' acts with its coefficient times its normal force, which must be in '{}', but is in '{}'", friction.name, force.described(),
                                           (normal.dimension * sliding.dimension).described()),
                               {{friction.normal_force->span, fmt::format("the normal force is in '{}'", normal.dimension.described())}});
        if (!sliding.fits_all) expect(friction.static_coefficient, sliding.dimension, "the static coefficient", "friction", friction);
    }

    void check(const Stop& stop) {
        units_.of(*stop.gap, {});
        expect(stop.restitution, Dimension::none(), "the restitution", "stop", stop);
    }

    void check(const Contact& contact) {
        const Dimension elongation = units_.of(*contact.elongation, {}).dimension;
        const Dimension rate = elongation / Dimension::time();
        expect(contact.stiffness, Dimension::energy() / elongation / elongation, "the stiffness", "contact", contact);
        expect(contact.damping, Dimension::power() / rate / rate, "the damping", "contact", contact);
        expect(contact.play, elongation, "the play", "contact", contact);
    }

    void check(const Saturation& saturation) {
        const Measure value = units_.of(*saturation.value, {});
        if (value.fits_all) return;
        expect(saturation.low, value.dimension, "the lower limit", "saturation", saturation);
        expect(saturation.high, value.dimension, "the upper limit", "saturation", saturation);
    }

    void check(const Profile& profile) {
        Measure value{Dimension::none(), true};
        for (const Phase& phase : profile.phases) {
            if (value.fits_all) value = units_.of(*phase.value, {});
            else expect(phase.value, value.dimension, fmt::format("the value in phase '{}', as in those before,", phase.name).c_str(), "profile", profile);
            expect(phase.until, Dimension::time(), fmt::format("the end of phase '{}'", phase.name).c_str(), "profile", profile);
            reset(phase.reset, "profile", profile);
        }
    }

    void check(const Block& block) {
        for (const auto* pieces : {&block.columns, &block.rows})
            for (const BlockPiece& piece : *pieces) expect(piece.length, Dimension::length(), "a piece length", "block", block);
        expect(block.depth, Dimension::length(), "the depth", "block", block);
        const auto table = [&](const Block::Table& values, const Dimension& expected, const char* part) {
            for (const auto& column : values)
                for (const ExpressionPtr& value : column) expect(value, expected, part, "block", block);
        };
        table(block.conductivity, Dimension::power() / Dimension::temperature() / Dimension::length(), "the conductivity");
        table(block.density, density, "the density");
        table(block.heat_capacity, specific_energy / Dimension::temperature(), "the heat capacity");
        if (block.source) {
            Units::Bound places;
            for (const std::string& variable : block.source->variables) places.emplace(variable, Dimension::length());
            expect(block.source->body, Dimension::power() / Dimension::volume(), "the source", "block", block, places);
        }
        const DescribedUnits sides(units_, fmt::format("block '{}'", block.name), "side ");
        for (const auto* side : {&block.left, &block.right, &block.bottom, &block.top})
            if (*side) describe(sides, **side);
    }

    void check(const Enclosure& enclosure) {
        for (const ExpressionPtr& emissivity : enclosure.emissivities) expect(emissivity, Dimension::none(), "an emissivity", "enclosure", enclosure);
        for (const ExpressionPtr& size : enclosure.areas) expect(size, area, "an area", "enclosure", enclosure);
        for (const auto& row : enclosure.view_factors)
            for (const ExpressionPtr& factor : row) expect(factor, Dimension::none(), "a view factor", "enclosure", enclosure);
        for (const auto& corner : enclosure.polygon)
            for (const ExpressionPtr& coordinate : corner) expect(coordinate, Dimension::length(), "a corner", "enclosure", enclosure);
        expect(enclosure.height, Dimension::length(), "the height", "enclosure", enclosure);
    }

    void law(const std::optional<Law>& law, const Dimension& variable, const Dimension& expected, const char* part, const char* kind, const Item& item) {
        if (law) expect(law->body, expected, part, kind, item, {{law->variable, variable}});
    }

    const Dimension area = Dimension::length() * Dimension::length();
    const Dimension density = Dimension::mass() / Dimension::volume();
    const Dimension specific_energy = Dimension::energy() / Dimension::mass();
    const Model& model_;
    Units units_;
    const Names& names_;
    Diagnostics& diagnostics_;
};

}  // namespace

void check_units(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    UnitCheck(model, names, diagnostics).run();
}

}  // namespace dalembert

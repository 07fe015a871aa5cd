// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/expand_statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "elements/bodies.hpp"
#include "elements/model.hpp"
#include "elements/statics.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// QUANTITY[NAME], QUANTITY[NAME, i], QUANTITY[NAME, i, j]
ExpressionPtr of_solid(const char* quantity, const Reference& solid, std::initializer_list<int> indices) {
    std::vector<ExpressionPtr> children{make_name(solid.name, solid.span)};
    for (const int index : indices) children.push_back(make_number(index, solid.span));
    return std::make_shared<Expression>(Expression{Expression::Kind::name, solid.span, 0, quantity, std::move(children)});
}

/// Whether a body turns in space: by axes of its own, or because the body does that it is placed on.
bool is_in_space(const Model& model, const Body& body) {
    std::set<std::string> seen;
    const Body* at = &body;
    while (at != nullptr && seen.insert(at->name).second) {
        if (at->has_axes()) return true;
        if (!at->on) return false;
        const auto base =
            std::find_if(model.bodies.begin(), model.bodies.end(), [&](const Body& other) { return other.name == at->on->name; });
        at = base == model.bodies.end() ? nullptr : &*base;
    }
    return false;
}

}  // namespace

void expand_solids(Model& model, Diagnostics& diagnostics) {
    std::vector<bool> in_space;
    for (const Body& body : model.bodies) in_space.push_back(is_in_space(model, body));
    for (std::size_t k = 0; k < model.bodies.size(); ++k) {
        Body& body = model.bodies[k];
        if (!body.solid) continue;
        if (std::none_of(model.solids.begin(), model.solids.end(), [&](const Solid& solid) { return solid.name == body.solid->name; })) {
            std::vector<std::string> known;
            for (const Solid& solid : model.solids) known.push_back(solid.name);
            diagnostics.error(Id::unknown_name, body.solid->span,
                              fmt::format("there is no solid '{}'{}", body.solid->name, did_you_mean(body.solid->name, known)));
            continue;
        }
        const auto quantity = [&](const char* name, std::initializer_list<int> indices) { return of_solid(name, *body.solid, indices); };
        body.mass = quantity("solid_mass", {});
        if (in_space[k]) {
            for (int i = 1; i <= 3; ++i)
                body.tensor.push_back({quantity("inertia_about_centre", {i, 1}), quantity("inertia_about_centre", {i, 2}),
                                       quantity("inertia_about_centre", {i, 3})});
            if (!body.position)
                body.centre =
                    VectorExpression{quantity("centre_of_mass", {1}), quantity("centre_of_mass", {2}), quantity("centre_of_mass", {3})};
            continue;
        }
        if (!body.position)
            diagnostics.error(
                Id::missing_key, body.span,
                fmt::format(
                    "body '{}' has a solid and needs the position of its centre of mass or, if it turns in space, the 'origin' of its axes",
                    body.name));
        if (body.rotation || body.angular_velocity) body.inertia = quantity("inertia_about_centre", {3, 3});
    }
}

void expand_loads(Model& model) {
    for (const Load& load : model.loads)
        for (const Unknown& unknown : load.unknowns) {
            Definition definition;
            static_cast<Item&>(definition) = unknown;
            definition.unit = unknown.unit;
            definition.is_made = true;
            definition.value =
                std::make_shared<Expression>(Expression{Expression::Kind::name,
                                                        unknown.span,
                                                        0,
                                                        "reaction",
                                                        {make_name(load.name, unknown.span), make_name(unknown.name, unknown.span)}});
            model.definitions.push_back(std::move(definition));
        }
}

}  // namespace dalembert

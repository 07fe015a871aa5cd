// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/statics.hpp"
#include "form/quantities.hpp"
#include "language/vocabulary.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

ex of_solid(const System& system, const Expression& e, const Indices& indices) {
    const SolidProperties& solid = system.solids.of(e.children[0]->name);
    if (e.name == "solid_mass") return solid.mass;
    const std::size_t i = axis_place(system, *e.children[1], indices);
    if (e.name == "centre_of_mass") return solid.centre[i];
    const std::size_t j = axis_place(system, *e.children[2], indices);
    return e.name == "inertia_about_centre" ? solid.about_centre[i][j] : solid.about_origin[i][j];
}

ex of_load(const System& system, const Expression& e, const Indices& indices) {
    const LoadSolution& load = system.load(e.children[0]->name, e.children[0]->span);
    if (e.name == "resultant_force") return load.force()[axis_place(system, *e.children[1], indices)];
    if (e.name == "resultant_moment") return load.moment()[axis_place(system, *e.children[1], indices)];
    for (std::size_t k = 0; k < load.unknowns.size(); ++k)
        if (load.load->unknowns[k].name == e.children[1]->name) return load.unknowns[k];
    throw Failure(Diagnostic{Id::unknown_name, e.span, fmt::format("'{}' has no meaning here", e.written())});
}

ex of_sticking(const System& system, const Expression& e) {
    const Sticking& sticking = *system.names.find_element<Sticking>(e.children[0]->name);
    if (!system.scene.holds(sticking.when))
        throw Failure(Diagnostic{Id::needs_absent,
                                 e.children[0]->span,
                                 fmt::format("scene '{}' has no sticking '{}'", system.scene.name, sticking.name),
                                 {{sticking.span, "it is defined here"}}});
    const StickingState state = sticking_state(system, sticking);
    return e.name == "sticks" ? state.sticks : e.name == "sticking_margin" ? state.margin : state.needed;
}

}  // namespace

StickingState sticking_state(const System& system, const Sticking& sticking) {
    const auto value = [&](const ExpressionPtr& expression) { return system.translate(expression, {}); };
    const ex coefficient = value(sticking.coefficient);
    StickingState result;
    if (sticking.normal) {
        const ex normal = value(sticking.normal);
        ex square = 0;
        for (const ExpressionPtr& force : sticking.tangential) square += GiNaC::pow(value(force), 2);
        const ex tangential = sticking.tangential.size() == 1 ? ex(magnitude(value(sticking.tangential[0]))) : ex(norm(square));
        result.margin = coefficient * normal - tangential;
        result.needed = tangential / normal;
    } else {
        const ex first = value(sticking.tensions[0]), second = value(sticking.tensions[1]), angle = value(sticking.angle);
        result.margin = minimum(first, second) * GiNaC::exp(coefficient * angle) - maximum(first, second);
        result.needed = magnitude(GiNaC::log(first / second)) / angle;
    }
    result.sticks = 1 - maximum(sign_of(-result.margin), 0);  // also where nothing is missing and nothing left
    return result;
}

std::optional<ex> statics_quantity(const System& system, const Expression& e, const Indices& indices) {
    const Subscript subscript = find_quantity(e.name)->subscript;
    if (subscript == Subscript::sticking) return of_sticking(system, e);
    if (subscript == Subscript::load_and_axis || subscript == Subscript::load_and_unknown) return of_load(system, e, indices);
    if (subscript >= Subscript::solid && subscript <= Subscript::solid_and_axes) return of_solid(system, e, indices);
    return std::nullopt;
}

}  // namespace dalembert

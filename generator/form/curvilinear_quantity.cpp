// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "form/quantities.hpp"
#include "mechanics/curvilinear.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::vector<Note> place_of(const BodyMotion& body) { return {{body.member.item->span, "the body is defined here"}}; }

/// Where constraints tie the coordinates of a position together, none of them can move along its line alone.
void refuse_bound(const System& system, const BodyMotion& body, const CurvilinearCoordinates& lines, const Expression& e) {
    if (!system.scene.modes.empty()) return;  // what switches lets go again
    for (const ConstraintEquation& constraint : system.constraints)
        for (const std::size_t j : lines.lines()) {
            if (!constraint.holds || partial(constraint.whole_rate, system.symbols.get(SymbolKind::velocity, j)).is_zero()) continue;
            throw Failure(Diagnostic{
                Id::not_allowed_here,
                e.span,
                fmt::format("'{}' needs lines along which body '{}' can move, but constraint '{}' binds '{}'; describe its position by "
                            "free coordinates",
                            e.written(), body.member.name(), constraint.name, system.symbols.all(SymbolKind::coordinate)[j].name),
                {{constraint.item->span, "the constraint is defined here"}}});
        }
}

}  // namespace

ex curvilinear_quantity(const System& system, const Expression& e, const BodyMotion& body, const std::vector<std::size_t>& q) {
    const CurvilinearCoordinates lines(body, system.translate, e.span);
    refuse_bound(system, body, lines, e);
    for (std::size_t i = 0; i < q.size(); ++i)
        if (lines.scale_factor(q[i]).is_zero())
            throw Failure(
                Diagnostic{Id::not_allowed_here, e.children[i + 1]->span,
                           fmt::format("'{}' does not move body '{}': its scale factor is zero everywhere, so it has no line in space",
                                       e.children[i + 1]->written(), body.member.name()),
                           place_of(body)});
    if (e.name == "scale_factor") return lines.scale_factor(q[0]);
    if (e.name == "velocity_along") return lines.velocity_along(q[0]);
    if (e.name == "acceleration_along") return lines.acceleration_along(q[0]);
    if (e.name == "christoffel_first") return lines.christoffel_first(q[0], q[1], q[2]);
    if (lines.determinant().is_zero())
        throw Failure(Diagnostic{
            Id::not_allowed_here, e.span,
            fmt::format(
                "the metric of body '{}' is singular everywhere: its {} coordinates move it along fewer lines, and '{}' has no value",
                body.member.name(), lines.lines().size(), e.written()),
            place_of(body)});
    return lines.christoffel_second(q[0], q[1], q[2]);
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/curves.hpp"
#include "elements/model.hpp"
#include "form/model_edges.hpp"
#include "run/settings.hpp"
#include "symbolic/bounds.hpp"
#include "symbolic/curve_functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

/// An argument outside of the points of a curve, and how far.
struct PlaceOutside {
    Rational distance, place;
};

std::string doubt_of(const Curve& curve, const Rational& place) {
    const bool is_above = place > curve.points.back().x;
    const Curve::Point& end = is_above ? curve.points.back() : curve.points.front();
    Diagnostics diagnostics;
    diagnostics.warning(Id::value_out_of_range, curve.span,
                        fmt::format("curve '{}' is taken at {} = {}, {} its {} point at {}; a run ends there, and the numbers here are "
                                    "those of a curve that goes straight on",
                                    curve.name, curve.variable, written_in(place, curve.of), is_above ? "above" : "below",
                                    is_above ? "last" : "first", written_in(end.x, curve.of)));
    return render(diagnostics.all().front());
}

}  // namespace

std::string doubts_of_curves(const Values& values, const System& system) {
    const std::vector<Curve>& curves = system.scene.model->curves;
    if (std::none_of(curves.begin(), curves.end(), [](const Curve& curve) { return curve.outside == Curve::Outside::error; })) return "";
    GiNaC::exmap at = values.substitution();
    add_steps(at, system.symbols, 20);
    std::map<std::string, PlaceOutside> worst;
    for (const GiNaC::ex& equation : equations_with_outputs(system))
        for (auto part = equation.preorder_begin(); part != equation.preorder_end(); ++part) {
            const auto call = curve_call(*part);
            if (!call || !call->curve->ends_runs) continue;
            const auto place = rational_near(part->op(0).subs(at, GiNaC::subs_options::no_pattern));
            if (!place || call->curve->points().holds(*place)) continue;
            const Rational distance = cln::max(call->curve->knots.front() - *place, *place - call->curve->knots.back());
            PlaceOutside& known = worst[call->curve->name];
            if (distance > known.distance) known = {distance, *place};
        }
    std::string doubts;
    for (const Curve& curve : curves)
        if (const auto found = worst.find(curve.name); found != worst.end()) doubts += doubt_of(curve, found->second.place);
    return doubts;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/curves.hpp"
#include "elements/model.hpp"
#include "form/model_edges.hpp"
#include "run/settings.hpp"
#include "symbolic/bounds.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/parts.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

/// An argument outside of the points of a curve, and how far.
struct PlaceOutside {
    Rational distance, place;
    PointsOfCall points;
};

std::string doubt_of(const Curve& curve, const PlaceOutside& outside) {
    const bool is_above = outside.place > outside.points.last;
    const Unit& unit = outside.points.axis == 0 ? curve.of : curve.grid->of;
    const std::string& variable = outside.points.axis == 0 ? curve.variable : curve.grid->variable;
    Diagnostics diagnostics;
    diagnostics.warning(Id::value_out_of_range, curve.span,
                        fmt::format("curve '{}' is taken at {} = {}, {} its {} point at {}; a run ends there, and the numbers here are "
                                    "those of a curve that goes straight on",
                                    curve.name, variable, written_in(outside.place, unit), is_above ? "above" : "below",
                                    is_above ? "last" : "first", written_in(is_above ? outside.points.last : outside.points.first, unit)));
    return render(diagnostics.all().front());
}

}  // namespace

std::string doubts_of_curves(const Values& values, const System& system) {
    const std::vector<Curve>& curves = system.scene.model->curves;
    if (std::none_of(curves.begin(), curves.end(), [](const Curve& curve) { return curve.outside == Curve::Outside::error; })) return "";
    GiNaC::exmap at = values.substitution();
    add_steps(at, system.symbols, 20);
    std::map<std::pair<std::string, std::size_t>, PlaceOutside> worst;
    for (const GiNaC::ex& equation : equations_with_outputs(system))
        each_part_once(equation, [&](const GiNaC::ex& part) {
            for (const PointsOfCall& points : points_that_end_runs(part)) {
                const auto place = rational_near(points.argument.subs(at, GiNaC::subs_options::no_pattern));
                if (!place || Bounds{points.first, points.last}.holds(*place)) continue;
                const Rational distance = cln::max(points.first - *place, *place - points.last);
                const auto [known, is_new] = worst.emplace(std::pair(points.curve, points.axis), PlaceOutside{distance, *place, points});
                if (!is_new && distance > known->second.distance) known->second = {distance, *place, points};
            }
        });
    std::string doubts;
    for (const Curve& curve : curves)
        for (const std::size_t axis : {0U, 1U})
            if (const auto found = worst.find({curve.name, axis}); found != worst.end()) doubts += doubt_of(curve, found->second);
    return doubts;
}

}  // namespace dalembert

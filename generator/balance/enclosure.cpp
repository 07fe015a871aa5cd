// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/enclosure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/crossed_strings.hpp"
#include "balance/view_factors.hpp"
#include "elements/heat.hpp"
#include "elements/walk.hpp"
#include "symbolic/heat_formulas.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class EnclosureMaking {
public:
    EnclosureMaking(HeatNetwork& network, const Enclosure& item, const Scene& scene, const Translator& translate, Symbols& symbols)
        : network_(network),
          item_(item),
          scene_(scene),
          translate_(translate),
          symbols_(symbols),
          value_(scene, translate),
          n_(item.surfaces.size()) {}

    void run() {
        check_signs();
        for (const Reference& surface : item_.surfaces) nodes_.push_back(&node(surface));
        Surroundings surroundings;
        for (std::size_t i = 0; i < n_; ++i) surroundings.emissivities.push_back(translate_(item_.emissivities[i], {}));
        item_.is_prism() ? see_in_prism(surroundings) : see_as_given(surroundings);
        Steps steps = steps_for(surroundings.emissivities);
        EnclosureState& state = network_.enclosures.emplace_back(
            EnclosureState{item_.name, nodes_, view_factors_, surroundings, net_radiation(surroundings, steps)});
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i + 1; j < n_; ++j) join(i, j, state.radiation.exchange[i][j]);
    }

private:
    const NodeState& node(const Reference& surface) const {
        const std::string name =
            surface.index ? fmt::format("{}[{}]", surface.name, index_value(*surface.index, scene_, {})) : surface.name;
        if (const NodeState* found = network_.find_node(name)) return *found;
        throw Failure(Diagnostic{Id::index_out_of_range, surface.span, fmt::format("the scene has no '{}'", name)});
    }

    /// What its description says about signs, at the defaults.
    void check_signs() const {
        const auto check = [&](const Written& written) {
            const std::optional<SignRule>& rule = written.key.sign;
            if (!rule) return;
            const std::string what =
                written.place ? fmt::format("the {} of surface {}", written.key.words, surface_name(item_, *written.place)) : written.what;
            const auto number = value_(translate_(written.expression, {}));
            const bool has_none = !number && written.depends == constant_only;
            const char* must = has_none  ? "must be above zero"
                               : !number ? nullptr
                                         : broken(*rule, sign_of_value(*number), sign_of_value(*number - 1));
            if (must != nullptr)
                throw Failure(Diagnostic{Id::value_out_of_range, written.expression.span,
                                         fmt::format("{} is {}{}, but {}", what, has_none ? "no number" : shown(*number),
                                                     has_none ? "" : with_space(rule->unit), must)});
        };
        walk(item_, check);
    }

    /// With letters where all depends on parameters alone; written out the exchange factors grow exponentially.
    Steps steps_for(const std::vector<ex>& expressions) {
        const bool with_letters = of_parameters_ && std::all_of(expressions.begin(), expressions.end(),
                                                                [&](const ex& e) { return is_of_parameters(e, symbols_); });
        constexpr std::size_t most = 3;
        if (!with_letters && n_ > most)
            throw Failure(Diagnostic{Id::too_large, item_.span,
                                     fmt::format("enclosure '{}' has {} surfaces, but can have at most {} where emissivities, areas or "
                                                 "view factors depend on more than parameters",
                                                 item_.name, n_, most)});
        return {symbols_, item_.name, with_letters};
    }

    void see_as_given(Surroundings& s) {
        for (std::size_t i = 0; i < n_; ++i) s.areas.push_back(translate_(item_.areas[i], {}));
        std::vector<std::vector<std::optional<ex>>> factors(n_, std::vector<std::optional<ex>>(n_));
        std::vector<ex> all = s.areas;
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                if (!item_.view_factors[i][j]) continue;
                factors[i][j] = translate_(item_.view_factors[i][j], {});
                all.push_back(*factors[i][j]);
            }
        const auto direct = complete_view_factors(item_, s.areas, factors, value_);
        Steps steps = steps_for(all);
        of_parameters_ = steps.with_letters();
        s.direct.assign(n_, std::vector<ex>(n_));
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = i; j < n_; ++j) s.direct[i][j] = s.direct[j][i] = steps("view_area", {i, j}, direct[i][j]);
        view_factors_ = s.direct;
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) view_factors_[i][j] = s.direct[i][j] / s.areas[i];
        // Where parameters can break (4.45) or (4.47), areas are what the rows add up to: heat is neither made nor lost.
        for (std::size_t i = 0; i < n_; ++i) {
            ex by_summation = 0;
            ex sum = 0;
            for (std::size_t j = 0; j < n_; ++j) {
                by_summation += direct[i][j];
                sum += s.direct[i][j];
            }
            const bool is_identity = (by_summation - s.areas[i]).expand().is_zero();
            s.areas[i] = steps("area", {i}, is_identity ? s.areas[i] : sum);
        }
    }

    void see_in_prism(Surroundings& s) {
        std::vector<Corner> corners;
        std::vector<PlanePoint> numbers;
        for (const auto& [x, y] : item_.polygon) {
            corners.push_back({translate_(x, {}), translate_(y, {})});
            const auto x_number = value_(corners.back().x);
            const auto y_number = value_(corners.back().y);
            if (!x_number || !y_number)
                throw Failure(Diagnostic{Id::division_by_zero, (x_number ? y : x)->span,
                                         fmt::format("'{}' has no value at the default parameters", (x_number ? y : x)->written())});
            numbers.push_back({*x_number, *y_number});
        }
        const ex height = translate_(item_.height, {});
        const Polygon polygon(numbers);
        if (const auto problem = polygon.problem()) {
            const auto [i, j] = *problem;
            const Span place = item_.polygon[j][0]->span;
            if (i == j)
                throw Failure(Diagnostic{Id::wrong_enclosure, place,
                                         fmt::format("surface {} of enclosure '{}' has no length: it ends at the corner where it begins",
                                                     surface_name(item_, i), item_.name)});
            throw Failure(Diagnostic{
                Id::wrong_enclosure,
                place,
                fmt::format(
                    "the polygon of enclosure '{}' crosses or touches itself: surfaces {} and {} meet away from a corner that they share",
                    item_.name, surface_name(item_, i), surface_name(item_, j)),
                {{item_.polygon[i][0]->span, fmt::format("surface {} begins here", surface_name(item_, i))}}});
        }
        Steps steps = steps_for({});
        PrismAreas prism = crossed_strings(corners, polygon, numbers, height, steps);
        s.areas = std::move(prism.areas);
        s.direct = std::move(prism.direct);
        view_factors_ = s.direct;
        for (std::size_t i = 0; i < n_; ++i)
            for (ex& factor : view_factors_[i]) factor /= s.areas[i];
    }

    void join(std::size_t i, std::size_t j, const ex& exchange) {
        if (exchange.is_zero() || nodes_[i] == nodes_[j]) return;
        LinkState link{fmt::format("{}, {} - {}", item_.name, nodes_[i]->name, nodes_[j]->name),
                       item_.span,
                       {},
                       {},
                       radiate(exchange, nodes_[i]->warmth, nodes_[j]->warmth),
                       true};
        link.from.node = nodes_[i];
        link.to.node = nodes_[j];
        network_.links.push_back(std::move(link));
    }

    HeatNetwork& network_;
    const Enclosure& item_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    Defaults value_;
    std::size_t n_;
    std::vector<const NodeState*> nodes_;
    std::vector<std::vector<ex>> view_factors_;
    bool of_parameters_ = true;
};

}  // namespace

void add_enclosure(HeatNetwork& network, const Enclosure& enclosure, const Scene& scene, const Translator& translate, Symbols& symbols) {
    EnclosureMaking(network, enclosure, scene, translate, symbols).run();
}

/// (4.48) with (4.51): what arrives at j comes from the emission of all, straight or by reflections.
ex EnclosureState::irradiation(std::size_t j) const {
    ex sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        sum += radiation.reach[j][i] * surroundings.emissivities[i] / surroundings.areas[j] * GiNaC::numeric(stefan_boltzmann()) *
               nodes[i]->warmth.fourth;
    return sum;
}

ex EnclosureState::radiosity(std::size_t i) const {
    const ex& eps = surroundings.emissivities[i];
    return eps * GiNaC::numeric(stefan_boltzmann()) * nodes[i]->warmth.fourth + (1 - eps) * irradiation(i);
}

}  // namespace dalembert

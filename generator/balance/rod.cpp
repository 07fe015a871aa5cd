// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/rod.hpp"

#include <fmt/format.h>

#include "symbolic/functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::pow;

namespace {

class RodMaking {
public:
    RodMaking(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols)
        : network_(network), rod_(rod), translate_(translate), symbols_(symbols) {
        for (const auto& member : scene.states)
            if (member.item->name == rod.temperature.name) states_.push_back(symbols.find(SymbolKind::state, member.item->name, member.index));
        if (states_.size() < 2)
            throw Failure(Diagnostic{Id::value_out_of_range, rod.temperature.span, fmt::format("rod '{}' has {} cell{}, but needs at least 2", rod.name, states_.size(), states_.size() == 1 ? "" : "s")});
    }

    void run() {
        make_grid();
        for (std::size_t k = 0; k < states_.size(); ++k) cell(k);
        for (std::size_t k = 0; k + 1 < states_.size(); ++k) join(fmt::format("between {} and {}", cells_[k]->name, cells_[k + 1]->name), *cells_[k], *cells_[k + 1], centres_[k], centres_[k + 1]);
        end(rod_.first, "first", faces_.front(), cells_.front(), centres_.front());
        end(rod_.last, "last", faces_.back(), cells_.back(), centres_.back());
    }

private:
    ex value(const ExpressionPtr& e) const { return translate_(e, {}); }
    ex value(const Property& property, const ex& x) const {
        return property.variables.empty() ? value(property.body) : translate_(*property.body, {}, {{property.variables[0], x}});
    }
    bool is_held(const std::optional<RodEnd>& end) const { return end && end->temperature; }
    bool has_points() const { return rod_.scheme == Rod::Scheme::points; }

    /// Where along the rod or its radius the fraction j/n of the cells lies (4.94).
    ex position(std::size_t j, std::size_t n) const {
        const ex s = numeric(static_cast<long>(j), static_cast<long>(n));
        const ex part = rod_.grid ? translate_(*rod_.grid->body, {}, {{rod_.grid->variable, s}}) : s;
        if (rod_.shape == Rod::Shape::bar) return (value(rod_.length) * part).expand();
        return (value(rod_.inner) + (value(rod_.outer) - value(rod_.inner)) * part).expand();
    }

    /// Points lie on the ends of the rod and have their faces half way between them; where an end is held, its point is no state. Cells
    /// have their faces on the grid and their centres half way between these.
    void make_grid() {
        const std::size_t m = states_.size();
        const auto middle = [](const ex& a, const ex& b) { return ((a + b) / 2).expand(); };
        if (!has_points()) {
            for (std::size_t j = 0; j <= m; ++j) faces_.push_back(position(j, m));
            for (std::size_t j = 0; j < m; ++j) centres_.push_back(middle(faces_[j], faces_[j + 1]));
            return;
        }
        const std::size_t skipped = is_held(rod_.first) ? 1 : 0;
        const std::size_t n = m - 1 + skipped + (is_held(rod_.last) ? 1 : 0);
        for (std::size_t j = 0; j < m; ++j) centres_.push_back(position(j + skipped, n));
        const ex before = position(0, n);
        const ex behind = position(n, n);
        faces_.push_back(skipped == 1 ? middle(before, centres_.front()) : before);
        for (std::size_t j = 0; j + 1 < m; ++j) faces_.push_back(middle(centres_[j], centres_[j + 1]));
        faces_.push_back(is_held(rod_.last) ? middle(centres_.back(), behind) : behind);
        ends_ = {before, behind};
    }

    /// The area across the flow of heat.
    ex area(const ex& x) const {
        switch (rod_.shape) {
            case Rod::Shape::bar: return value(*rod_.area, x);
            case Rod::Shape::cylinder: return 2 * GiNaC::Pi * value(rod_.height) * x;
            case Rod::Shape::sphere: break;
        }
        return 4 * GiNaC::Pi * pow(x, 2);
    }

    ex volume(const ex& from, const ex& to) const {
        switch (rod_.shape) {
            case Rod::Shape::bar: return area((from + to) / 2) * (to - from).expand();
            case Rod::Shape::cylinder: return GiNaC::Pi * value(rod_.height) * (to - from).expand() * (to + from).expand();
            case Rod::Shape::sphere: break;
        }
        return 4 * GiNaC::Pi / 3 * (to - from).expand() * (pow(to, 2) + to * from + pow(from, 2)).expand();
    }

    /// Heat flow over the integral of the conductivity: of a bar by the area half way, else exact for steady heat flow (4.68); from the
    /// centre of a solid cylinder or sphere by the area half way too.
    ex shape_factor(const ex& from, const ex& to) const {
        const ex width = (to - from).expand();
        if (rod_.shape == Rod::Shape::bar || from.is_zero()) return area(((from + to) / 2).expand()) / width;
        if (rod_.shape == Rod::Shape::cylinder) return 2 * GiNaC::Pi * value(rod_.height) / log_ratio(to, from);
        return 4 * GiNaC::Pi * from * to / width;
    }

    void cell(std::size_t k) {
        const Variable& state = *states_[k];
        NodeState& node = network_.nodes.emplace_back(
            NodeState{NodeState::Kind::storing, fmt::format("{}[{}]", rod_.name, state.index), &rod_, rod_.temperature.span, warmth_of(state.symbol), state.position});
        const ex& from = faces_[k];
        const ex& to = faces_[k + 1];
        const ex size = volume(from, to);
        store(node, *rod_.heat_capacity, value(rod_.density) * size, translate_, symbols_, {});
        if (rod_.source) node.source += value(*rod_.source, centres_[k]) * size;
        if (rod_.ambient) {
            const ex surface = value(rod_.perimeter) * (to - from).expand();
            node.source += taken_up(node.warmth, surface, rod_.side_coefficient, rod_.side_emissivity, rod_.ambient);
            node.radiates = rod_.side_emissivity != nullptr;
        }
        cells_.push_back(&node);
    }

    /// What a surface takes up by convection and radiation.
    ex taken_up(const Warmth& surface, const ex& size, const ExpressionPtr& coefficient, const ExpressionPtr& emissivity, const ExpressionPtr& ambient) const {
        const Warmth around = warmth_of(value(ambient));
        ex heat = 0;
        if (coefficient) heat += exchange(value(coefficient) * size, around, surface);
        if (emissivity) heat += radiate(value(emissivity) * size * stefan_boltzmann(), around, surface);
        return heat;
    }

    void join(std::string name, const NodeState& a, const NodeState& b, const ex& from, const ex& to) {
        LinkState link{std::move(name), rod_.span, {}, {}, conduct(*rod_.conductivity, shape_factor(from, to), a.warmth, b.warmth, translate_, symbols_, {})};
        link.from.node = &a;
        link.to.node = &b;
        network_.links.push_back(std::move(link));
    }

    void end(const std::optional<RodEnd>& what, const char* which, const ex& face, NodeState* nearest, const ex& centre) {
        if (!what) return;
        const bool is_first = which == std::string_view("first");
        const std::string name = fmt::format("{}.{}", rod_.name, which);
        const ex surface = has_points() && is_held(what) ? (is_first ? ends_.first : ends_.second) : face;
        NodeState* at_surface = nearest;
        if (is_held(what)) {
            at_surface = &network_.nodes.emplace_back(NodeState{NodeState::Kind::held, name, &rod_, what->temperature->span, warmth_of(value(what->temperature)), {}});
        } else if (!has_points() && what->ambient) {
            at_surface = &add_sought(network_, name, rod_, what->span, symbols_);
        }
        if (at_surface != nearest) {
            if (is_first) join(fmt::format("between {} and {}", name, nearest->name), *at_surface, *nearest, surface, centre);
            else join(fmt::format("between {} and {}", nearest->name, name), *nearest, *at_surface, centre, surface);
        }
        if (what->flux) at_surface->source += value(what->flux) * area(surface);
        at_surface->radiates = at_surface->radiates || what->emissivity;
        if (what->ambient) at_surface->source += taken_up(at_surface->warmth, area(surface), what->coefficient, what->emissivity, what->ambient);
    }

    HeatNetwork& network_;
    const Rod& rod_;
    const Translator& translate_;
    Symbols& symbols_;
    std::vector<const Variable*> states_;
    std::vector<ex> faces_;    ///< one more than there are cells
    std::vector<ex> centres_;
    std::pair<ex, ex> ends_;   ///< of points
    std::vector<NodeState*> cells_;
};

}  // namespace

void add_rod(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols) { RodMaking(network, rod, scene, translate, symbols).run(); }

}  // namespace dalembert

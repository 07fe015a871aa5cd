// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/rod.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/field.hpp"
#include "elements/conduction.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class RodMaking {
public:
    RodMaking(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols)
        : network_(network),
          rod_(rod),
          translate_(translate),
          symbols_(symbols),
          field_(scene.find_field(rod)),
          geometry_(rod, translate, cell_count(rod, scene)) {
        for (const auto& member : scene.states)
            if (member.item->name == rod.temperature.name)
                states_.push_back(symbols.find(SymbolKind::state, member.item->name, member.index));
    }

    void run() {
        for (const Variable* state : states_) cells_.push_back(&cell(*state));
        if (field_ == nullptr) {
            for (std::size_t k = 0; k < cells_.size(); ++k) fill(*cells_[k], geometry_.place(k));
            for (std::size_t k = 0; k + 1 < cells_.size(); ++k)
                join(*cells_[k], *cells_[k + 1], geometry_.shape_factor(geometry_.place(k), geometry_.place(k + 1)));
        } else {
            for (std::size_t i = 0; i < cells_.size(); ++i)
                fill_tapped(*cells_[i], geometry_.place(static_cast<std::size_t>(states_[i]->index - field_->from)));
            network_.fields.push_back(field());
        }
        end(rod_.first, "first", cells_.front(), geometry_.place(0));
        end(rod_.last, "last", cells_.back(), geometry_.place(geometry_.cells() - 1));
    }

private:
    static std::size_t cell_count(const Rod& rod, const Scene& scene) {
        const Field* field = scene.find_field(rod);
        const auto count =
            field != nullptr ? static_cast<std::size_t>(field->to - field->from + 1)
                             : static_cast<std::size_t>(std::count_if(scene.states.begin(), scene.states.end(),
                                                                      [&](const auto& s) { return s.item->name == rod.temperature.name; }));
        if (count >= 2) return count;
        throw Failure(Diagnostic{Id::value_out_of_range, rod.temperature.span,
                                 fmt::format("rod '{}' has {} cell{}, but needs at least 2", rod.name, count, count == 1 ? "" : "s")});
    }

    ex value(const ExpressionPtr& e) const { return translate_(e, {}); }

    NodeState& cell(const Variable& state) {
        return network_.nodes.emplace_back(NodeState{NodeState::Kind::storing, fmt::format("{}[{}]", rod_.name, state.index), &rod_,
                                                     rod_.temperature.span, warmth_of(state.symbol), state.position});
    }

    ex mass(const GridPlace& place) const { return value(rod_.density) * geometry_.volume(place); }

    /// What a cell takes up from outside, but for the ends.
    ex source(const Warmth& warmth, const GridPlace& place) const {
        ex heat = 0;
        if (rod_.source) {
            const ex density = rod_.source->variables.empty()
                                   ? value(rod_.source->body)
                                   : translate_(*rod_.source->body, {}, {{rod_.source->variables[0], geometry_.centre(place)}});
            heat += density * geometry_.volume(place);
        }
        if (rod_.ambient)
            heat += taken_up(warmth, value(rod_.perimeter) * geometry_.width(place), rod_.side_coefficient, rod_.side_emissivity,
                             rod_.ambient, translate_);
        return heat;
    }

    void fill(NodeState& node, const GridPlace& place) {
        store(node, *rod_.heat_capacity, mass(place), translate_, symbols_, {});
        node.source += source(node.warmth, place);
        node.radiates = rod_.side_emissivity != nullptr;
    }

    /// A cell of a field balances what comes from elsewhere; its energy counts with the field.
    void fill_tapped(NodeState& node, const GridPlace& place) {
        store(node, *rod_.heat_capacity, mass(place), translate_, symbols_, {});
        node.is_tapped = true;
    }

    CellField field() {
        const auto letter = [&](const char* name) { return symbols_.grid_letter(fmt::format("{}[{}]", name, rod_.name)); };
        // In this order differences of them are written as what is positive.
        const ex beyond = letter("beyond");
        const ex right = letter("right");
        const ex middle = letter("here");
        GridPlace place{letter("left"), middle, right};
        if (!geometry_.has_points()) place.here = (place.left + place.right) / 2;
        CellField f = make_field(*field_, translate_, symbols_, RodLetters{geometry_, place, beyond});
        const GridPlace next{place.right, place.right, beyond};
        const Warmth here = warmth_of(f.here);
        f.faces.push_back({{0, f.cells - 1},
                           1,
                           conduct(*rod_.conductivity, geometry_.shape_factor(place, next), here, warmth_of(f.next), translate_, symbols_,
                                   {})});
        NodeState generic{NodeState::Kind::storing, rod_.name, &rod_, rod_.span, here, {}};
        store(generic, *rod_.heat_capacity, mass(place), translate_, symbols_, {});
        f.laws.push_back({f.all(), source(here, place), generic.capacity, generic.stored_energy});
        f.tapped.assign(cells_.begin(), cells_.end());
        refuse_variables_outside(f, symbols_);
        return f;
    }

    ex join(const NodeState& a, const NodeState& b, const ex& shape) {
        const ex heat = conduct(*rod_.conductivity, shape, a.warmth, b.warmth, translate_, symbols_, {});
        add_link(network_, rod_, a, b, heat);
        return heat;
    }

    void end(const std::optional<Boundary>& what, const char* which, NodeState* nearest, const GridPlace& place) {
        const std::string name = fmt::format("{}.{}", rod_.name, which);
        network_.borders.push_back({name, what ? enter(*what, which == std::string_view("first"), name, nearest, place) : 0});
    }

    /// Lets heat through an end; W into the rod.
    ex enter(const Boundary& what, bool is_first, const std::string& name, NodeState* nearest, const GridPlace& place) {
        NodeState* surface = nearest;
        if (what.temperature)
            surface = &network_.nodes.emplace_back(
                NodeState{NodeState::Kind::held, name, &rod_, what.temperature->span, warmth_of(value(what.temperature)), {}});
        else if (!geometry_.has_points() && what.ambient)
            surface = &add_sought(network_, name, rod_, what.span, symbols_);
        const ex area = geometry_.end_area(is_first);
        ex heat = 0;
        if (what.flux) heat += value(what.flux) * area;
        if (what.ambient) heat += taken_up(surface->warmth, area, what.coefficient, what.emissivity, what.ambient, translate_);
        surface->radiates = surface->radiates || what.emissivity;
        surface->source += heat;
        if (surface == nearest) return heat;
        surface->is_surface = !what.temperature;
        const ex shape = geometry_.end_factor(place, is_first);
        const ex through = is_first ? join(*surface, *nearest, shape) : -join(*nearest, *surface, shape);
        return what.temperature ? through : heat;
    }

    HeatNetwork& network_;
    const Rod& rod_;
    const Translator& translate_;
    Symbols& symbols_;
    const Field* field_;  ///< null: every cell is a node
    RodGeometry geometry_;
    std::vector<const Variable*> states_;
    std::vector<NodeState*> cells_;
};

}  // namespace

void add_rod(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols) {
    RodMaking(network, rod, scene, translate, symbols).run();
}

}  // namespace dalembert

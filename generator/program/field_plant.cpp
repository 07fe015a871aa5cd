// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/field_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "elements/conduction.hpp"
#include "program/constants.hpp"
#include "program/identifiers.hpp"
#include "program/field_bodies.hpp"
#include "program/plant_tables.hpp"
#include "graph/notation.hpp"

namespace dalembert {

namespace {

class FieldMaker {
public:
    explicit FieldMaker(const FieldCode& code) : code_(code), system_(code.code.system), places_(place_states(system_)), bodies_(code) {}

    PlantFields run() {
        fields_.states = places_.count;
        fields_.plain_states = places_.count - system_.symbols.positions() - system_.symbols.degrees();
        fields_.positions = places_.positions;
        indices();
        rods();
        equations();
        fields_.update = bodies_.update();
        fields_.start_state = bodies_.start_state();
        fields_.rates = bodies_.rates();
        fields_.jacobian = bodies_.jacobian();
        fields_.by_input = bodies_.jacobian(By::input);
        fields_.by_parameter = bodies_.jacobian(By::parameter);
        fields_.by_time = bodies_.jacobian(By::time);
        fields_.energy = bodies_.energy();
        fields_.power = bodies_.power();
        if (!code_.sums.empty())
            fields_.sums = PlantSums{code_.sums.size(),         bodies_.sums(),
                                     bodies_.sum_slopes(),      bodies_.sum_slopes_by_inputs(),
                                     bodies_.output_values(),   bodies_.output_by_state(),
                                     bodies_.output_by_input(), bodies_.output_by_sum()};
        for (const FieldBodies::CachedMember& member : bodies_.cached_members())
            fields_.cached.push_back({member.name, "", member.cells.value_or(0)});
        fields_.helpers = bodies_.helpers();
        fields_.curves = curve_tables({&code_.code});
        for (const PlantCurve& curve : fields_.curves) fields_.helpers.insert(curve.helper());
        return std::move(fields_);
    }

private:
    const CellField& field(std::size_t r) const { return *code_.fields[r].field; }

    void indices() {
        std::set<std::string> seen;
        const auto add = [&](const std::string& name, std::size_t at) {
            if (seen.insert(name).second) fields_.indices.emplace_back(name, at);
        };
        std::size_t i = 0;
        for (const Variable* variable : system_.symbols.state_variables()) {
            const std::size_t at = places_.positions[i++];
            const auto r = std::find_if(code_.fields.begin(), code_.fields.end(), [&](const FieldFunctions& f) {
                return variable->kind == SymbolKind::state && f.field->states->name == variable->base;
            });
            if (r == code_.fields.end()) add(identifier(*variable), at);
            else add(variable->base, places_.firsts[static_cast<std::size_t>(r - code_.fields.begin())]);
        }
    }

    void rods() {
        for (std::size_t r = 0; r < code_.fields.size(); ++r) {
            const State& states = *field(r).states;
            PlantField one{places_.firsts[r],
                         field(r).cells,
                         field(r).columns,
                         field(r).first_index,
                         {states.name, states.name, states.unit.si(), states.doc, {}, {}},
                         states.range.has_value()};
            const auto bound = [&](const ExpressionPtr& e) {
                return e ? std::optional(double_value(system_.translate(*e, {}))) : std::nullopt;
            };
            if (states.range) {
                one.states.low = bound(states.range->low);
                one.states.high = bound(states.range->high);
            }
            fields_.list.push_back(std::move(one));
        }
    }

    void equations() {
        const Notation write(system_.symbols, Style::text);
        for (std::size_t r = 0; r < code_.fields.size(); ++r) {
            const CellField& f = field(r);
            fields_.equations.push_back(fmt::format("{} {}: {}, with", f.is_block() ? "Block" : "Rod", f.body->name, f.balance()));
            for (const FieldPart& part : f.parts())
                if (part.key != "energy") fields_.equations.push_back(fmt::format("  {} = {}", f.title(part), write(part.value)));
            fields_.equations.push_back(f.is_block() ? "  column, row: numbers of the cell, from 0." :
                                                       "  left, here, right, beyond: numbers of points or faces on the grid.");
        }
        for (const CellSum& sum : system_.cell_sums) {
            const std::string cells = sum.cells.stride > 0 ? fmt::format("{} cells", sum.cells.count()) :
                                                             fmt::format("cells {} to {}", sum.cells.first + 1,
                                                                         sum.cells.first + sum.cells.columns);
            fields_.equations.push_back(fmt::format("{} = sum over {} of {}", write(sum.letter), cells, write(sum.term)));
        }
    }

    const FieldCode& code_;
    const System& system_;
    const StatePlaces places_;
    FieldBodies bodies_;
    PlantFields fields_;
};

}  // namespace

PlantFields make_fields(const FieldCode& code) { return FieldMaker(code).run(); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// note [order of edges]: At a jump of a derivative of second or higher order of the right-hand side the control of steps loses next to
// nothing: the error of a step of length h that crosses it goes like h^3. So |v|*v is no edge, v -> |v| and max(x, 0)^(3/2) are. But a
// curve has knots all along, where a run at 1e-13 then keeps 8 digits of the energy, and Taylor series see nothing of them: all of its
// knots are edges.
#include "form/model_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "form/expression_writer.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/parts.hpp"
#include "symbolic/switches.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

const numeric smooth_enough = 2;

class EdgeFinder {
public:
    explicit EdgeFinder(System& system) : system_(system), write_(system.symbols) {}

    void run() {
        ends_of_curves();
        for (const ex& equation : equations_of_motion(system_)) look_at(equation);
        for (const auto& [text, by] : found_) add(text, by, "kink or jump");
        for (const auto& [text, by] : knots_) add(text, by, "knot of a curve");
    }

private:
    void add(const std::string& text, const ex& by, const char* what) {
        const bool is_known = std::any_of(system_.guards.begin(), system_.guards.end(), [&by](const Guard& guard) {
            return (guard.value - by).expand().is_zero() || (guard.value + by).expand().is_zero();
        });
        if (!is_known) system_.guards.push_back({text, fmt::format("{} where {} is zero", what, text), false, by});
    }

    /// Curves that are known between their first and their last point alone end runs.
    void ends_of_curves() {
        refuse_in_loops();
        std::map<std::string, Guard> ends;
        for (const ex& equation : equations_with_outputs(system_))
            each_part_once(equation, [&](const ex& part) {
                for (const PointsOfCall& points : points_that_end_runs(part)) {
                    if (!moves(points.argument)) continue;
                    const std::string &name = points.curve, argument = write_(points.argument);
                    const std::string doc = fmt::format("the argument {}of curve '{}' is about to ",
                                                        points.variable.empty() ? "" : "'" + points.variable + "' ", name);
                    ends.emplace(name + " above " + argument,
                                 Guard{name, doc + "rise above its last point", true, numeric(points.last) - points.argument});
                    ends.emplace(name + " below " + argument,
                                 Guard{name, doc + "fall below its first point", true, points.argument - numeric(points.first)});
                }
            });
        for (auto& [key, guard] : ends) system_.guards.push_back(std::move(guard));
    }

    /// Loops over cells do not watch where a curve ends.
    void refuse_in_loops() const {
        for (const CellField& field : system_.heat.fields)
            for (const ex& e : field.expressions())
                for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
                    if (const auto ends = points_that_end_runs(*part); !ends.empty())
                        throw Failure(Diagnostic{
                            Id::not_allowed_here, field.body->span,
                            fmt::format("the cells of {} are computed in loops, which do not watch where curve '{}' ends; give the "
                                        "curve outside = \"held\" or \"straight\", or the {} loops = false",
                                        field.written(), ends.front().curve, field.kind)});
    }

    void look_at(const ex& equation) {
        std::map<std::string, ex> switches;
        for (const Switch& one : switches_in(equation))
            if (one.is_located && moves(one.by)) (one.is_knot ? knots_ : switches).insert(with_positive_begin(one.by));
        for (const auto& [text, by] : switches) {
            if (found_.contains(text)) continue;
            const auto order = order_of_kink(equation, by);
            if (!order || *order < smooth_enough) found_[text] = by;
        }
    }

    /// The same place may be written in two ways.
    std::pair<std::string, ex> with_positive_begin(const ex& by) const {
        ex value = by.expand();
        const ex content = value.integer_content();
        if (!content.is_zero()) value = (value / content).expand();
        std::string text = write_(value);
        if (!text.starts_with('-')) return {text, value};
        value = (-value).expand();
        return {write_(value), value};
    }

    /// What parameters alone determine has no edge in a run; accelerations and forces are not known where guards are asked.
    bool moves(const ex& by) const {
        bool any = false;
        for (auto part = by.preorder_begin(); part != by.preorder_end(); ++part) {
            if (!GiNaC::is_a<GiNaC::symbol>(*part)) continue;
            const Variable* variable = system_.symbols.find(*part);
            if (variable == nullptr) return false;
            switch (variable->kind) {
                case SymbolKind::parameter:
                case SymbolKind::definition: break;
                case SymbolKind::time:
                case SymbolKind::input:
                case SymbolKind::coordinate:
                case SymbolKind::velocity:
                case SymbolKind::state: any = true; break;
                default: return false;
            }
        }
        return any;
    }

    System& system_;
    ExpressionWriter write_;
    std::map<std::string, ex> found_, knots_;
};

}  // namespace

std::vector<ex> equations_of_motion(const System& system) {
    std::vector<ex> all = system.residual;
    all.insert(all.end(), system.state_rates.begin(), system.state_rates.end());
    for (const ConstraintEquation& constraint : system.constraints) {
        all.insert(all.end(), constraint.rate.jacobian.begin(), constraint.rate.jacobian.end());
        all.push_back(constraint.rate.drift);
        all.push_back(constraint.force);
    }
    return all;
}

std::vector<ex> equations_with_outputs(const System& system) {
    std::vector<ex> all = equations_of_motion(system);
    for (const OutputEquation& output : system.outputs) all.push_back(system.with_rates(output.value));
    return all;
}

void model_edges(System& system) { EdgeFinder(system).run(); }

}  // namespace dalembert

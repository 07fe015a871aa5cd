// SPDX-License-Identifier: GPL-3.0-or-later
// note [order of edges]: At a jump of a derivative of second or higher order of the right-hand side the control of steps loses next to
// nothing: the error of a step of length h that crosses it goes like h^3. So |v|*v is no edge, v -> |v| and max(x, 0)^(3/2) are. But a
// curve has knots all along, where a run at 1e-13 then keeps 8 digits of the energy, and Taylor series see nothing of them: all of its
// knots are edges.
#include "form/model_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/switches.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

const numeric smooth_enough = 2;

/// As people write it, in an order that does not depend on the run.
class Writer {
public:
    explicit Writer(const Symbols& symbols) : symbols_(symbols) {}

    std::string operator()(const ex& e) const {
        if (GiNaC::is_a<GiNaC::symbol>(e)) {
            const Variable* variable = symbols_.find(e);
            return variable != nullptr ? variable->name : ex_to<GiNaC::symbol>(e).get_name();
        }
        if (GiNaC::is_exactly_a<numeric>(e)) return fmt::format("{}", to_string(cln::the<cln::cl_RA>(ex_to<numeric>(e).to_cl_N())));
        if (e.is_equal(GiNaC::Pi)) return "pi";
        if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
        if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
        if (GiNaC::is_a<GiNaC::power>(e))
            return e.op(1).is_equal(numeric(1, 2)) ? "sqrt(" + (*this)(e.op(0)) + ")" : as_factor(e.op(0)) + "^" + as_factor(e.op(1));
        if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return (*this)(e.op(0));
        if (const auto curve = curve_call(e)) return fmt::format("{}({})", name_of_curve_function(*curve), (*this)(e.op(0)));
        if (const auto map = map_call(e)) return fmt::format("{}({}, {})", name_of_map_function(*map), (*this)(e.op(0)), (*this)(e.op(1)));
        std::vector<std::string> arguments;
        for (const ex& argument : e) arguments.push_back((*this)(argument));
        return fmt::format("{}({})", name_of_function(e), fmt::join(arguments, ", "));
    }

private:
    static std::string name_of_function(const ex& e) {
        static const std::map<std::string, std::string> names{{"magnitude", "abs"}, {"sign_of", "sign"}, {"unit_step", "step"},
                                                              {"minimum", "min"},   {"maximum", "max"},  {"floor_of", "floor"}};
        const std::string name = ex_to<GiNaC::function>(e).get_name();
        const auto known = names.find(name);
        return known == names.end() ? name : known->second;
    }

    std::string as_factor(const ex& e) const {
        const std::string text = (*this)(e);
        const bool is_whole = GiNaC::is_a<GiNaC::symbol>(e) || GiNaC::is_a<GiNaC::function>(e) || e.is_equal(GiNaC::Pi) ||
                              e.info(GiNaC::info_flags::nonnegint);
        return is_whole ? text : "(" + text + ")";
    }

    /// Numbers last.
    std::string sum(const ex& e) const {
        std::vector<std::pair<bool, std::string>> terms;
        for (const ex& term : e) terms.emplace_back(GiNaC::is_exactly_a<numeric>(term), (*this)(term));
        const auto unsigned_text = [](const std::string& text) { return text.starts_with('-') ? text.substr(1) : text; };
        std::sort(terms.begin(), terms.end(), [&](const auto& a, const auto& b) {
            return std::pair(a.first, unsigned_text(a.second)) < std::pair(b.first, unsigned_text(b.second));
        });
        std::string text;
        for (const auto& [is_number, term] : terms)
            text += text.empty() ? term : term.starts_with('-') ? " - " + term.substr(1) : " + " + term;
        return text;
    }

    std::string product(const ex& e) const {
        std::vector<std::string> above, below;
        std::string sign;
        for (const ex& factor : e) {
            if (GiNaC::is_exactly_a<numeric>(factor) && ex_to<numeric>(factor).is_rational()) {
                const numeric& value = ex_to<numeric>(factor);
                if (value.is_negative()) sign = sign.empty() ? "-" : "";
                if (!GiNaC::abs(value.numer()).is_equal(1)) above.push_back((*this)(GiNaC::abs(value.numer())));
                if (!value.denom().is_equal(1)) below.push_back((*this)(value.denom()));
            } else if (GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::negative)) {
                below.push_back(as_factor(1 / factor));
            } else if (GiNaC::is_a<GiNaC::add>(factor)) {
                // GiNaC turns a sum round by the order of its letters, which changes from run to run.
                const std::string text = (*this)(factor);
                const bool is_turned = text.starts_with('-');
                if (is_turned) sign = sign.empty() ? "-" : "";
                above.push_back("(" + (is_turned ? (*this)(-factor) : text) + ")");
            } else {
                above.push_back(as_factor(factor));
            }
        }
        std::sort(above.begin(), above.end());
        std::sort(below.begin(), below.end());
        std::string text = sign + (above.empty() ? "1" : fmt::format("{}", fmt::join(above, "*")));
        for (const std::string& factor : below) text += "/" + factor;
        return text;
    }

    const Symbols& symbols_;
};

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
            for (auto part = equation.preorder_begin(); part != equation.preorder_end(); ++part) {
                for (const PointsOfCall& points : points_that_end_runs(*part)) {
                    if (!moves(points.argument)) continue;
                    const std::string &name = points.curve, argument = write_(points.argument);
                    const std::string doc = fmt::format("the argument {}of curve '{}' is about to ",
                                                        points.variable.empty() ? "" : "'" + points.variable + "' ", name);
                    ends.emplace(name + " above " + argument,
                                 Guard{name, doc + "rise above its last point", true, numeric(points.last) - points.argument});
                    ends.emplace(name + " below " + argument,
                                 Guard{name, doc + "fall below its first point", true, points.argument - numeric(points.first)});
                }
            }
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
    Writer write_;
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/start_values.hpp"

#include <fmt/format.h>

#include "elements/curves.hpp"
#include "elements/model.hpp"
#include "form/curve_places.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

const char* to_string(ValueCondition::Rule rule) {
    static constexpr const char* names[]{"above_zero", "not_below_zero", "share",  "below",
                                         "not_above",  "square_of_one",  "rising", "inertia"};
    return names[static_cast<std::size_t>(rule)];
}

StartValues::StartValues(const System& system) : StartValues(system, Values(system.scene, system.translate)) {
    when_ = "at the start with the values of the model file";
}

StartValues::StartValues(const System& system, const Values& values, ValueConditions* conditions)
    : system_(system), start_(values.substitution()), conditions_(conditions) {
    add_steps(start_, system.symbols, 30);
    if (system.scene.model->curves.empty()) return;
    parameters_ = start_;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input, SymbolKind::time})
        for (const Variable& variable : system.symbols.all(kind)) parameters_.erase(variable.symbol);
}

std::optional<numeric> StartValues::operator()(const ex& e) const {
    const ex number = e.subs(start_, GiNaC::subs_options::no_pattern).evalf();
    if (!GiNaC::is_exactly_a<numeric>(number) || !ex_to<numeric>(number).is_real()) return std::nullopt;
    return ex_to<numeric>(number);
}

bool StartValues::depends_on_input(const ex& e) const {
    for (const Variable& input : system_.symbols.all(SymbolKind::input))
        if (e.has(input.symbol)) return true;
    return false;
}

void StartValues::positive(const ex& e, const Span& place, const std::string& what, const char* unit) const {
    check(above_zero(unit), e, place, what);
}

void StartValues::check(const SignRule& rule, const ex& e, const Span& place, const std::string& what) const {
    using Rule = ValueCondition::Rule;
    note({rule.up_to_one ? Rule::share : rule.is_above_zero ? Rule::above_zero : Rule::not_below_zero,
          {e},
          fmt::format("{} is {{}}{} {}, but {}", what, with_space(rule.unit), when_, broken(rule, -1, -1))});
    const auto number = (*this)(e);
    if (!number && !rule.is_above_zero) return;
    const char* must = number ? broken(rule, number->csgn(), (*number - 1).csgn()) : "must be above zero";
    if (must == nullptr) return check_curves(rule, e, place, what);
    const std::string shown = number ? fmt::format("{:.6g}{}", number->to_double(), with_space(rule.unit)) : "no number";
    throw Failure(Diagnostic{Id::value_out_of_range, place, fmt::format("{} is {} {}, but {}", what, shown, when_, must)});
}

ex StartValues::of_what_moves(const ex& e) const {
    return system_.symbols.without_definitions(e).subs(parameters_, GiNaC::subs_options::no_pattern);
}

Bounds StartValues::bounds(const Variable& variable) const {
    if (variable.kind == SymbolKind::time) return {Rational(0), std::nullopt};
    if (variable.declared == nullptr || variable.is_root || variable.kind == SymbolKind::velocity) return {};
    Bounds result;
    const auto& range = variable.declared->range;
    const auto end = [&](const ExpressionPtr& e) { return e ? rational_near(of_what_moves(system_.translate(*e, {}))) : std::nullopt; };
    if (range) result = {end(range->low), end(range->high)};
    const bool is_absolute = !is_zero(variable.declared->unit.offset);
    return is_absolute ? common(result, {Rational(0), std::nullopt}) : result;
}

Bounds StartValues::bounds(const ex& e) const {
    const ex moving = of_what_moves(e);
    BoundsOfLetters letters;
    for (auto part = moving.preorder_begin(); part != moving.preorder_end(); ++part)
        if (const Variable* variable = GiNaC::is_a<GiNaC::symbol>(*part) ? system_.symbols.find(*part) : nullptr)
            letters.emplace(*part, bounds(*variable));
    return bounds_of(moving, letters);
}

void StartValues::check_curves(const SignRule& rule, const ex& e, const Span& place, const std::string& what,
                               const BoundsOfLetters& of_letters) const {
    if (system_.scene.model->curves.empty()) return;
    const ex moving = of_what_moves(e);
    if (!has_moving_curve(moving)) return;
    BoundsOfLetters letters = of_letters;
    GiNaC::exmap start = start_;
    for (auto part = moving.preorder_begin(); part != moving.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part)) {
            const Variable* variable = system_.symbols.find(*part);
            const Bounds& known = letters.emplace(*part, variable != nullptr ? bounds(*variable) : Bounds{}).first->second;
            const Rational low = known.low.value_or(0);
            start.emplace(*part, numeric(known.high ? (low + *known.high) / 2 : low + 1));
        }
    const auto breaks = [&](const Rational& value) {
        return broken(rule, cln::zerop(value) ? 0 : cln::minusp(value) ? -1 : 1, value > 1 ? 1 : 0);
    };
    const Bounds all = bounds_of(moving, letters);
    if (all.low && breaks(*all.low) == nullptr && (!rule.up_to_one || (all.high && breaks(*all.high) == nullptr))) return;
    const auto found = worst_place(moving, letters, start, [&](const Rational& value) { return breaks(value) != nullptr; });
    if (!found) return;
    const Curve& curve = *system_.names.find_element<Curve>(found->curve);
    const bool is_beyond = curve.outside == Curve::Outside::straight && found->is_beyond;
    std::string taken_at = fmt::format("{} = {}", curve.variable, written_in(found->places[0], curve.of));
    if (curve.grid) taken_at += fmt::format(" and {} = {}", curve.grid->variable, written_in(found->places[1], curve.grid->of));
    throw Failure(Diagnostic{
        Id::value_out_of_range, place,
        fmt::format("{} is {:.6g}{} where curve '{}' is taken at {}, but {}; {}", what, cln::double_approx(found->value),
                    with_space(rule.unit), curve.name, taken_at, breaks(found->value),
                    is_beyond ? "outside = \"held\" or \"error\" would do, or a range of its argument that does not reach there"
                              : "other points would do, or a range of its argument that does not reach there"),
        {{curve.span, "the curve is defined here"}}});
}

}  // namespace dalembert

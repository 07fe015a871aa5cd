// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/units.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "check/written_values.hpp"
#include "elements/forces.hpp"
#include "elements/model.hpp"
#include "elements/statics.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// The exact value of an exponent written with numbers only.
std::optional<Rational> constant_value(const Expression& e) {
    if (e.kind == Kind::number) return e.value;
    std::vector<Rational> parts;
    for (const ExpressionPtr& child : e.children) {
        const auto value = constant_value(*child);
        if (!value || bit_length(*value) > 64) return std::nullopt;
        parts.push_back(*value);
    }
    switch (e.kind) {
        case Kind::negate: return -parts[0];
        case Kind::add: return parts[0] + parts[1];
        case Kind::subtract: return parts[0] - parts[1];
        case Kind::multiply: return parts[0] * parts[1];
        case Kind::divide: return is_zero(parts[1]) ? std::nullopt : std::optional<Rational>(parts[0] / parts[1]);
        default: return std::nullopt;
    }
}

constexpr Measure anything{{}, true};

/// The unit of a number that was written with one.
Unit unit_named(const std::string& name, const Span& span) {
    const auto source = std::make_shared<const Source>("unit", name);
    try {
        return parse_unit(excerpt_of(source));
    } catch (const Failure&) {
        throw Failure(Diagnostic{Id::unknown_unit, span, "the unit of this number cannot be read"});
    }
}

Measure raised(Measure measure, const Fraction& exponent) {
    measure.dimension = measure.dimension.raised(exponent);
    return measure;
}

}  // namespace

Measure Units::mismatch(const Expression& at, std::string message, std::initializer_list<const Expression*> sides) {
    // Where a side is a mere name, its unit is known from where it is defined.
    std::vector<Note> notes;
    for (const Expression* side : sides) {
        const Named* named = side->kind == Kind::name ? names_.find(side->name) : nullptr;
        if (named != nullptr) notes.push_back({named->item->span, fmt::format("'{}' is defined here", side->name)});
    }
    diagnostics_.error(Id::unit_mismatch, at.span, std::move(message), std::move(notes));
    return anything;
}

void Units::expect(const Expression& expression, const Dimension& expected, const std::string& what, const Bound& bound) {
    const Measure measure = of(expression, bound);
    if (!measure.fits_all && measure.dimension != expected)
        mismatch(expression, fmt::format("{} must be in '{}', but '{}' is in '{}'", what, expected.usual_unit(), expression.written(),
                                         measure.dimension.usual_unit()), {&expression});
}

Dimension Units::of_coordinate(std::string_view name) const {
    const Named* named = names_.find(name);
    return named == nullptr ? Dimension::none() : named->quantity().unit.dimension;
}

Measure Units::agreeing(const Expression& whole, const Expression& a, const Measure& ma, const Expression& b, const Measure& mb) {
    if (ma.fits_all) return mb;
    if (mb.fits_all || ma.dimension == mb.dimension) return ma;
    const bool lacks_unit = is_plain_number(a) || is_plain_number(b);
    return mismatch(
        whole,
        fmt::format("'{}' is in '{}' while '{}' is in '{}'; the two must agree{}", a.written(), ma.dimension.usual_unit(), b.written(),
                    mb.dimension.usual_unit(), lacks_unit ? "; write the unit of a number after it, as in '(5 bar)'" : ""),
        {&a, &b});
}

void Units::dimensionless(const Expression& e, const std::string& what, const Bound& bound) {
    const Measure measure = of(e, bound);
    if (!measure.fits_all && !measure.dimension.is_none())
        mismatch(e, fmt::format("{} must be dimensionless, but '{}' is in '{}'", what, e.written(), measure.dimension.usual_unit()), {&e});
}

Measure Units::of(const Expression& e, const Bound& bound) {
    const auto part = [&](std::size_t i) { return of(*e.children[i], bound); };
    switch (e.kind) {
        case Kind::number:
            if (!e.name.empty()) return {unit_named(e.name, e.span).dimension};
            return {Dimension::none(), is_zero(e.value)};
        case Kind::name: return name(e, bound);
        case Kind::call: return call(e, bound);
        case Kind::negate: return part(0);
        case Kind::add:
        case Kind::subtract: {
            const Measure left = part(0);
            return agreeing(e, *e.children[0], left, *e.children[1], part(1));
        }
        case Kind::multiply:
        case Kind::divide: {
            const Measure left = part(0);
            const Measure right = part(1);
            if (left.fits_all || right.fits_all) return anything;
            return {e.kind == Kind::multiply ? left.dimension * right.dimension : left.dimension / right.dimension};
        }
        case Kind::power: return power(e, bound);
        case Kind::sum: break;
    }
    Bound inner = bound;
    inner[e.name] = Dimension::none();
    return of(*e.children[2], inner);
}

Measure Units::power(const Expression& e, const Bound& bound) {
    const Measure base = of(*e.children[0], bound);
    dimensionless(*e.children[1], "an exponent", bound);
    if (base.fits_all || base.dimension.is_none()) return base;
    const auto exponent = constant_value(*e.children[1]);
    if (!exponent)
        return mismatch(e, fmt::format("'{}' is in '{}' and can only be raised to a power that is a number", e.children[0]->written(),
                                       base.dimension.usual_unit()), {e.children[0].get()});
    const auto numerator = to_int(cln::numerator(*exponent));
    const auto denominator = to_int(cln::denominator(*exponent));
    if (!numerator || !denominator || std::abs(*numerator) > 24 || *denominator > 24)
        return mismatch(e, fmt::format("the exponent of '{}' is too large for something with a unit", e.written()), {});
    return {base.dimension.raised({*numerator, *denominator})};
}

Measure Units::name(const Expression& e, const Bound& bound) {
    if (const auto found = bound.find(e.name); found != bound.end()) return {found->second};
    if (e.name == "pi") return {};
    if (e.name == "infinity") return anything;
    if (e.name == "stefan_boltzmann")
        return {Dimension::power() / Dimension::length().raised({2, 1}) / Dimension::temperature().raised({4, 1})};
    if (e.name == "t") return {is_time_plain_ ? Dimension::none() : Dimension::time()};
    if (find_quantity(e.name) != nullptr) return quantity(e, bound);
    const Named* named = names_.find(e.name);
    if (named == nullptr) return {};  // an index of a family
    switch (named->kind) {
        case Named::Kind::size:
        case Named::Kind::mode: return {};
        case Named::Kind::parameter:
        case Named::Kind::coordinate:
        case Named::Kind::input:
        case Named::Kind::state: return {named->quantity().unit.dimension};
        case Named::Kind::output: return of(*static_cast<const Output*>(named->item)->value, {});
        case Named::Kind::definition: break;
    }
    const Definition& definition = named->definition();
    if (const auto known = definitions_.find(&definition); known != definitions_.end()) return known->second;
    definitions_[&definition] = anything;
    // Disagreements within an element that switches are told of its entries.
    Diagnostics silent;
    const Measure measure = definition.unit      ? Measure{definition.unit->dimension}
                            : definition.is_made ? Units(names_, silent).of(*definition.value, {})
                                                 : of(*definition.value, {});
    return definitions_[&definition] = measure;
}

Measure Units::quantity(const Expression& e, const Bound& bound) {
    const QuantitySpec& spec = *find_quantity(e.name);
    if (spec.is_of_medium(e.children.size())) {  // a property of a medium at a pressure and a temperature
        expect(*e.children[1], Dimension::pressure(), fmt::format("the pressure in '{}'", e.written()), bound);
        expect(*e.children[2], Dimension::temperature(), fmt::format("the temperature in '{}'", e.written()), bound);
    }
    if (spec.unit != nullptr) return {parse_unit(excerpt_of(std::make_shared<const Source>(spec.name, spec.unit))).dimension};
    const auto coordinate = [&](std::size_t i) { return of_coordinate(e.children[i]->name); };
    const Dimension energy = Dimension::energy();
    if (e.name == "constraint_force") {
        const Constraint& constraint = *names_.find_element<Constraint>(e.children[0]->name);
        if (constraint.rate) return {Dimension::power() / of(*constraint.rate, {}).dimension};
        return {energy / of(*constraint.position, {}).dimension};
    }
    if (e.name == "cut_force") return {names_.find_element<Cut>(e.children[0]->name)->about ? energy : energy / Dimension::length()};
    if (e.name == "reaction") {
        for (const Unknown& unknown : names_.find_element<Load>(e.children[0]->name)->unknowns)
            if (unknown.name == e.children[1]->name) return {unknown.unit.dimension};
        return anything;
    }
    if (e.name == "sticking_margin") {
        const Sticking& sticking = *names_.find_element<Sticking>(e.children[0]->name);
        return of(sticking.normal ? *sticking.normal : *sticking.tensions[0], {});
    }
    if (e.name == "scale_factor") return {Dimension::length() / coordinate(1)};
    if (e.name == "christoffel") return {coordinate(1) / coordinate(2) / coordinate(3)};
    if (e.name == "christoffel_first") return {Dimension::length() * Dimension::length() / coordinate(1) / coordinate(2) / coordinate(3)};
    if (e.name == "generalised_force" || e.name == "nonpotential_force" || e.name == "bias") return {energy / coordinate(0)};
    if (e.name == "mass_matrix") return {energy * Dimension::time() * Dimension::time() / coordinate(0) / coordinate(1)};
    if (e.name == "damping_matrix") return {energy * Dimension::time() / coordinate(0) / coordinate(1)};
    if (e.name == "stiffness_matrix") return {energy / coordinate(0) / coordinate(1)};
    throw std::logic_error("no unit of quantity '" + e.name + "'");
}

Measure Units::call(const Expression& e, const Bound& bound) {
    const auto part = [&](std::size_t i) { return of(*e.children[i], bound); };
    if (e.name == "dot" || e.name == "ddot") {
        Measure result = part(0);
        result.dimension = result.dimension / Dimension::time().raised({e.name == "dot" ? 1 : 2, 1});
        return result;
    }
    if (e.name == "diff") {
        const Measure above = part(0);
        return {above.dimension / part(1).dimension, above.fits_all};
    }
    if (e.name == "integral") {
        const Measure low = part(2);
        const Measure limit = agreeing(e, *e.children[2], low, *e.children[3], part(3));
        Bound inner = bound;
        // From zero to infinity says nothing of the unit; a letter of that name does.
        const Dimension variable = limit.fits_all ? of(*e.children[1], bound).dimension : limit.dimension;
        inner[e.children[1]->name] = variable;
        const Measure function = of(*e.children[0], inner);
        return {function.dimension * variable, function.fits_all};
    }
    if (e.name == "quantity") {
        dimensionless(*e.children[0], "the number in front of a unit", bound);
        return {evaluate_unit(*e.children[1]).dimension};
    }
    if (e.name == "limit" || e.name == "at") {
        const Measure variable = part(1);
        agreeing(e, *e.children[1], variable, *e.children[2], part(2));
        return part(0);
    }
    if (const Curve* curve = names_.find_element<Curve>(e.name)) {
        const auto is_wrong = [&](const Expression& x, const std::string& variable, const Unit& unit) {
            expect(x, unit.dimension, fmt::format("the argument '{}' of curve '{}'", variable, e.name), bound);
            // 45 may be meant in deg; no dimension tells.
            const bool is_share = unit.dimension == Dimension::none() && (unit.factor != 1 || unit.pi_power != 0);
            return is_share && is_plain_number(x) && !(x.kind == Expression::Kind::number && is_zero(x.value));
        };
        for (std::size_t i = 0; i < e.children.size(); ++i) {
            const Expression& x = *e.children[i];
            const std::string& variable = i == 0 ? curve->variable : curve->grid->variable;
            const Unit& unit = i == 0 ? curve->of : curve->grid->of;
            if (is_wrong(x, variable, unit))
                return mismatch(x, fmt::format("the argument '{0}' of curve '{1}' is in '{2}', and '{3}' has no unit; write '{3} {2}'",
                                               variable, e.name, unit.written, x.written()), {&x});
        }
        return {curve->unit.dimension};
    }
    return function(*find_function(e.name), e, bound);
}

Measure Units::function(const FunctionSpec& function, const Expression& e, const Bound& bound) {
    const auto part = [&](std::size_t i) { return of(*e.children[i], bound); };
    const auto agreeing_up_to = [&](std::size_t count) {
        Measure result = part(0);
        for (std::size_t i = 1; i < count; ++i) result = agreeing(e, *e.children[0], result, *e.children[i], part(i));
        return result;
    };
    const std::size_t count = e.children.size();
    switch (function.units) {
        case UnitRule::dimensionless:
            for (const ExpressionPtr& argument : e.children)
                dimensionless(*argument, fmt::format("{} of '{}'", count == 1 ? "the argument" : "an argument", e.name), bound);
            return {};
        case UnitRule::same: return agreeing_up_to(count);
        case UnitRule::square_root: return raised(part(0), {1, 2});
        case UnitRule::sign: part(0); return {};
        case UnitRule::choice: part(0); return agreeing(e, *e.children[1], part(1), *e.children[2], part(2));
        case UnitRule::ratio: agreeing_up_to(count); return {};
        case UnitRule::ratio_and_angle:
            agreeing_up_to(count - 1);
            dimensionless(*e.children[count - 1], fmt::format("the angle in '{}'", e.name), bound);
            return {};
        case UnitRule::fourth_power: return raised(agreeing_up_to(count), {4, 1});
        case UnitRule::root_excess: {
            const Measure c = part(0);
            if (!c.fits_all) expect(*e.children[1], c.dimension.raised({2, 1}), fmt::format("the second argument of '{}'", e.name), bound);
            return c.fits_all ? raised(part(1), {1, 2}) : c;
        }
        case UnitRule::plate: {
            const Measure above = part(0), first = part(1), second = part(2);
            return {above.dimension / first.dimension / second.dimension, above.fits_all};
        }
        case UnitRule::pipe: {
            agreeing_up_to(2);
            const Measure conductivity = part(2), length = part(3);
            return {Dimension::none() / conductivity.dimension / length.dimension, conductivity.fits_all || length.fits_all};
        }
        case UnitRule::radiant: break;
    }
    const Measure b = part(1);
    if (!b.fits_all) expect(*e.children[0], b.dimension.raised({-3, 1}), fmt::format("the first argument of '{}'", e.name), bound);
    return b.fits_all ? raised(part(0), {-1, 3}) : b;
}

}  // namespace dalembert

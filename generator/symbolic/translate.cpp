// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/translate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/conduction.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/switches.hpp"
#include "symbolic/heat_formulas.hpp"
#include "symbolic/scalar_functions.hpp"
#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

using Kind = Expression::Kind;

[[noreturn]] void fail(Id id, const Expression& at, std::string message, std::vector<Note> notes = {}) {
    throw Failure(Diagnostic{id, at.span, std::move(message), std::move(notes)});
}

/// Of a cell in a loop only what comes from elsewhere is known here, not what its neighbours do.
void refuse_rates_of_cells(const Expression& e, const ex& rate, const Scene& scene, const Symbols& symbols) {
    for (const Field& field : scene.fields)
        for (const Variable& state : symbols.all(SymbolKind::state))
            if (state.base == field.states->name && rate.has(symbols.get(SymbolKind::state_rate, state.position)))
                fail(Id::not_allowed_here, e,
                     fmt::format("'{}' needs the rate of '{}', a cell of {}, which a loop computes; give the {} loops = false, or fewer "
                                 "cells",
                                 e.written(), state.name, field.written(), field.kind),
                     {{field.body->span, fmt::format("the {} is defined here", field.kind)}});
}

/// The exact number that an expression is, or begins with as a factor or term.
std::size_t bits_of(const ex& value) {
    const ex number = GiNaC::is_exactly_a<numeric>(value)                                                      ? value
                      : (GiNaC::is_a<GiNaC::mul>(value) || GiNaC::is_a<GiNaC::add>(value)) && value.nops() > 0 ? value.op(value.nops() - 1)
                                                                                                               : ex(0);
    return GiNaC::is_exactly_a<numeric>(number) && ex_to<numeric>(number).is_rational()
               ? bit_length(cln::the<cln::cl_RA>(ex_to<numeric>(number).to_cl_N()))
               : 0;
}

bool has_letters(const ex& e) {
    return std::any_of(e.preorder_begin(), e.preorder_end(), [](const ex& part) { return GiNaC::is_a<GiNaC::symbol>(part); });
}

}  // namespace

ex Translator::operator()(const Expression& e, const Indices& indices, const Letters& letters) const {
    struct Call {
        explicit Call(int& calls) : calls_(calls) { ++calls_; }
        ~Call() { --calls_; }
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;
        int& calls_;
    };
    if (calls_ == 0) terms_ = {};
    const Call call(calls_);
    return visit(e, indices, letters);
}

SpaceVector Translator::operator()(const VectorExpression& vector, const Indices& indices) const {
    return {(*this)(*vector[0], indices), (*this)(*vector[1], indices), (*this)(*vector[2], indices)};
}

/// Throws Failure (number-too-large) for exact numbers that fill memory.
void Translator::keep_small(const Expression& e, const ex& value) const {
    if (bits_of(value) > budget::bits)
        fail(Id::number_too_large, e, fmt::format("'{}' has too many digits to be written exactly", e.written()));
}

/// Of what has no letters: it is a real number, and one that a computer has. Throws Failure (division-by-zero, number-too-large).
void Translator::keep_magnitude(const Expression& e, const ex& value) const {
    ex number = value;
    try {
        number = value.evalf();
    } catch (const std::exception&) {  // CLN has no exponents of that size
        fail(Id::number_too_large, e, fmt::format("the value of '{}' is beyond 1e{}", e.written(), budget::magnitude));
    }
    if (!GiNaC::is_exactly_a<numeric>(number)) return;
    if (!ex_to<numeric>(number).is_real()) fail(Id::division_by_zero, e, fmt::format("'{}' is not a real number", e.written()));
    static const numeric largest = GiNaC::pow(numeric(10), numeric(budget::magnitude));
    if (GiNaC::abs(ex_to<numeric>(number)) > largest)
        fail(Id::number_too_large, e, fmt::format("the value of '{}' is beyond 1e{}", e.written(), budget::magnitude));
}

ex Translator::visit(const Expression& e, const Indices& indices, const Letters& letters) const {
    const auto part = [&](std::size_t i) { return visit(*e.children[i], indices, letters); };
    const auto small = [&](ex value) {
        keep_small(e, value);
        return value;
    };
    switch (e.kind) {
        case Kind::number: return numeric(e.value);
        case Kind::name: return name(e, indices, letters);
        case Kind::call: return call(e, indices, letters);
        case Kind::sum: return sum(e, indices, letters);
        case Kind::negate: return -part(0);
        case Kind::add: return small(part(0) + part(1));
        case Kind::subtract: return small(part(0) - part(1));
        case Kind::multiply: return small(part(0) * part(1));
        case Kind::divide: {
            const ex divisor = part(1);
            if (divisor.is_zero())
                fail(Id::division_by_zero, e, fmt::format("'{}' divides by '{}', which is zero", e.written(), e.children[1]->written()));
            return small(part(0) / divisor);
        }
        case Kind::power: break;
    }
    return power(e, part(0), part(1));
}

ex Translator::power(const Expression& e, const ex& base, const ex& exponent) const {
    if (GiNaC::is_exactly_a<numeric>(exponent)) {
        const numeric& n = ex_to<numeric>(exponent);
        if (GiNaC::abs(n) > budget::exponent)
            fail(Id::number_too_large, e, fmt::format("the exponent of '{}' is beyond {}", e.written(), budget::exponent));
        if (base.is_zero() && !n.is_positive())
            fail(Id::division_by_zero, e, fmt::format("'{}' raises zero to a power that is not positive", e.written()));
        if (static_cast<double>(bits_of(base)) * std::abs(n.to_double()) > static_cast<double>(budget::bits))
            fail(Id::number_too_large, e, fmt::format("'{}' has too many digits to be written exactly", e.written()));
        if (GiNaC::is_exactly_a<numeric>(base) && ex_to<numeric>(base).is_rational()) {
            const cln::cl_RA value = cln::the<cln::cl_RA>(ex_to<numeric>(base).to_cl_N());
            if (is_negative(value) && !n.is_integer()) fail(Id::division_by_zero, e, fmt::format("'{}' is not a real number", e.written()));
        }
    }
    // Of a state that is integrated as its root: that root, which is not negative where the model holds.
    const bool is_root = exponent.is_equal(numeric(1, 2)) && GiNaC::is_exactly_a<GiNaC::power>(base) && base.op(1).is_equal(2) &&
                         GiNaC::is_a<GiNaC::symbol>(base.op(0));
    if (const Variable* root = is_root ? symbols_.find(base.op(0)) : nullptr; root != nullptr && root->is_root) return base.op(0);
    return GiNaC::pow(base, exponent);
}

int Translator::member_index(const Expression& e, const Item& item, const Indices& indices) const {
    if (!item.family) return 0;
    const int index = index_value(*e.children.at(0), scene_, indices);
    const auto [from, to] = bounds(*item.family, scene_);
    if (index < from || index > to)
        fail(Id::index_out_of_range, e,
             fmt::format("'{}' asks for member {} of '{}', which has the members {} to {}", e.written(), index, item.name, from, to),
             {{item.span, fmt::format("'{}' is defined here", item.name)}});
    return index;
}

ex Translator::name(const Expression& e, const Indices& indices, const Letters& letters) const {
    if (const auto letter = letters.find(e.name); letter != letters.end()) return letter->second;
    if (const auto index = indices.find(e.name); index != indices.end()) return index->second;
    if (e.name == "pi") return GiNaC::Pi;
    if (e.name == "stefan_boltzmann") return numeric(stefan_boltzmann());
    if (e.name == "t") return symbols_.time();
    if (e.name == "infinity") fail(Id::not_allowed_here, e, "'infinity' is not a number; only limits and bounds of integrals may use it");
    if (const auto size = scene_.sizes.find(e.name); size != scene_.sizes.end()) return size->second;
    const Named* named = names_.find(e.name);
    if (named == nullptr) {
        if (!quantities_ || find_quantity(e.name) == nullptr)
            fail(Id::not_allowed_here, e, fmt::format("'{}' has no meaning here", e.written()));
        std::vector<ex> arguments;
        if (find_quantity(e.name)->is_of_medium(e.children.size()))
            arguments = {0, visit(*e.children[1], indices, letters), visit(*e.children[2], indices, letters)};
        return quantities_(e, indices, arguments);
    }
    if (cells_ != nullptr && named->kind == Named::Kind::state && e.children.size() == 1 && e.children[0]->kind == Kind::name &&
        e.children[0]->name == cells_->name)
        return cell_;
    const int index = member_index(e, *named->item, indices);
    static constexpr SymbolKind kinds[]{SymbolKind::letter, SymbolKind::parameter, SymbolKind::definition, SymbolKind::coordinate,
                                        SymbolKind::input,  SymbolKind::state,     SymbolKind::letter,     SymbolKind::letter};
    if (named->kind == Named::Kind::mode) return is_in_mode(e);
    if (const Variable* variable = symbols_.find(kinds[static_cast<std::size_t>(named->kind)], e.name, index);
        variable != nullptr && variable->kind == SymbolKind::coordinate && !symbols_.has_value(variable->position))
        fail(Id::not_allowed_here, e,
             fmt::format("'{0}' has no value: turns about different axes do not add up to angles. Use dot({0}), the angular velocity about "
                         "that axis of the body",
                         e.written()),
             {{named->item->span, "the attitude is defined here"}});
    if (const Variable* variable = symbols_.find(kinds[static_cast<std::size_t>(named->kind)], e.name, index))
        return variable->is_root ? GiNaC::pow(variable->symbol, 2) : variable->symbol;
    if (named->kind == Named::Kind::parameter && scene_.fixed.contains(e.name)) {
        const Member<Parameter> member{static_cast<const Parameter*>(named->item), index};
        return visit(*value_of(member, scene_), indices_of(member), {});
    }
    if (named->kind == Named::Kind::definition || named->kind == Named::Kind::output) {
        // Not a letter of its own: it depends on the motion, or only printed equations and values use it. Inserted where it stands.
        const ExpressionPtr& value =
            named->kind == Named::Kind::definition ? named->definition().value : static_cast<const Output*>(named->item)->value;
        Indices inner;
        if (named->item->family) inner[named->item->family->index] = index;
        if (named->kind == Named::Kind::output) return visit(*value, inner, {});
        const auto key = std::pair(&named->definition(), index);
        if (const auto known = inserted_.find(key); known != inserted_.end()) return known->second;
        return inserted_[key] = visit(*value, inner, {});
    }
    fail(Id::needs_absent, e, fmt::format("'{}' is not part of scene '{}'", e.written(), scene_.name),
         {{named->item->span, "it is defined here"}});
}

/// 1 in the mode, else 0.
ex Translator::is_in_mode(const Expression& e) const {
    if (!scene_.mode)
        fail(Id::not_allowed_here, e, fmt::format("'{}' is a mode; only expressions of a moving machine know its mode", e.written()));
    return scene_.modes[*scene_.mode].is_in(e.name) ? 1 : 0;
}

ex Translator::term_of_cells(const Expression& sum, const Indices& indices, const ex& temperature, const ex& index) const {
    cells_ = &sum;
    cell_ = temperature;
    struct End {
        const Expression*& cells;
        ~End() { cells = nullptr; }
    } end{cells_};
    return visit(*sum.children[2], indices, {{sum.name, index}});
}

ex Translator::sum(const Expression& e, const Indices& indices, const Letters& letters) const {
    if (sums_ && cells_ == nullptr)
        if (const auto of_cells = sums_(e, indices)) return *of_cells;
    const int from = index_value(*e.children[0], scene_, indices);
    const int to = index_value(*e.children[1], scene_, indices);
    terms_.add(e, from, to);
    GiNaC::exvector terms;
    Indices inner = indices;
    for (int i = from; i <= to; ++i) {
        inner[e.name] = i;
        terms.push_back(visit(*e.children[2], inner, letters));
    }
    return GiNaC::add(terms);
}

ex Translator::call(const Expression& e, const Indices& indices, const Letters& letters) const {
    const auto part = [&](std::size_t i) { return visit(*e.children[i], indices, letters); };
    if (e.name == "dot" && e.children[0]->kind == Kind::name)
        if (const Variable* q = symbols_.find(SymbolKind::coordinate, e.children[0]->name, 0);
            q != nullptr && !symbols_.has_value(q->position))
            return symbols_.get(SymbolKind::velocity, q->position);
    if (e.name == "ddot" && e.children[0]->kind == Kind::name)
        if (const Variable* q = symbols_.find(SymbolKind::coordinate, e.children[0]->name, 0);
            q != nullptr && !symbols_.has_value(q->position))
            return symbols_.get(SymbolKind::acceleration, q->position);
    if (const auto found = calculus(e, indices, letters)) {
        if (!sums_) refuse_rates_of_cells(e, *found, scene_, symbols_);
        return *found;
    }
    if (const Curve* curve = names_.find_element<Curve>(e.name)) {
        const auto known = curves_.emplace(curve, 0);
        if (known.second) known.first->second = curve->grid ? number_of(map_of(*curve)) : number_of(pieces_of(*curve));
        // Its points count in units without pi.
        const auto place = [&](std::size_t i, const Unit& unit) -> ex { return part(i) * GiNaC::pow(GiNaC::Pi, -unit.pi_power); };
        const ex& number = known.first->second;
        return GiNaC::pow(GiNaC::Pi, curve->unit.pi_power) *
               (curve->grid ? map_value(place(0, curve->of), place(1, curve->grid->of), number) : curve_value(place(0, curve->of), number));
    }
    if (e.name == "quantity") return visit(*to_si(e.children[0], evaluate_unit(*e.children[1])), indices, letters);
    std::vector<ex> arguments;
    for (std::size_t i = 0; i < e.children.size(); ++i) arguments.push_back(part(i));
    const ex value = function(e, arguments);
    if (std::none_of(arguments.begin(), arguments.end(), has_letters)) keep_magnitude(e, value);
    return value;
}

ex Translator::function(const Expression& e, const std::vector<ex>& arguments) const {
    const ex& x = arguments[0];
    try {
        if (const auto heat = heat_function(e.name, arguments)) return *heat;
        if (e.name == "sqrt") return power(e, x, numeric(1, 2));
        if (e.name == "step") return if_else(x, 1, 0);
        if (e.name == "ramp") return maximum(x, 0);
        if (e.name == "pulse") return if_else(x, 1, 0) - if_else(x - arguments[1], 1, 0);
        if (e.name == "mod") return x - arguments[1] * floor_of(x / arguments[1]);
        if (e.name == "if") return if_else(x, arguments[1], arguments[2]);
        if (e.name == "unlocated") return with_unlocated_switches(x);
        if (const ScalarFunction* known = scalar_function_named(e.name)) return applied(*known, arguments);
    } catch (const GiNaC::pole_error&) {
        if (e.name == "mod")
            fail(Id::division_by_zero, e,
                 fmt::format("the period '{}' of '{}' is zero, but must be positive", e.children[1]->written(), e.written()));
        fail(Id::division_by_zero, e, fmt::format("'{}' does not exist", e.written()));
    }
    throw std::logic_error("a function of the vocabulary without a translation: " + e.name);
}

std::size_t Translator::coordinate(const std::string& name, const Expression* index, const Span& span, const Indices& indices) const {
    const int member = index == nullptr ? 0 : index_value(*index, scene_, indices);
    if (const Variable* variable = symbols_.find(SymbolKind::coordinate, name, member)) return variable->position;
    throw Failure(
        Diagnostic{Id::index_out_of_range, span,
                   fmt::format("the scene has no coordinate '{}'", index == nullptr ? name : fmt::format("{}[{}]", name, member))});
}

}  // namespace dalembert

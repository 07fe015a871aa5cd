// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives, integrals and limits in what a user wrote.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/functions.hpp"
#include "symbolic/integrate.hpp"
#include "symbolic/integrate_parts.hpp"
#include "symbolic/limit.hpp"
#include "symbolic/translate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

[[noreturn]] void fail_at(Id id, const Expression& at, std::string message, std::vector<Note> notes = {}) {
    throw Failure(Diagnostic{id, at.span, std::move(message), std::move(notes)});
}

/// 1, -1, or 0 for what is not infinite.
int infinite(const Expression& e) {
    if (e.kind == Expression::Kind::negate) return -infinite(*e.children[0]);
    return e.kind == Expression::Kind::name && e.name == "infinity" ? 1 : 0;
}

}  // namespace

/// The time derivative of what the derivative of is known: not of accelerations, rates of plain states and inputs.
ex Translator::rate(const Expression& e, const ex& value) const {
    for (const auto& [kind, what] : {std::pair(SymbolKind::acceleration, "acceleration"), std::pair(SymbolKind::state_rate, "rate"),
                                     std::pair(SymbolKind::input, "input"), std::pair(SymbolKind::multiplier, "force")})
        for (const Variable& variable : symbols_.all(kind))
            if (value.has(variable.symbol))
                fail_at(Id::not_allowed_here, e,
                        fmt::format("'{}' needs the time derivative of the {} '{}', which is not known", e.written(), what, variable.name));
    const Expression& inside = *e.children[0];
    if (const Variable* letter =
            inside.kind == Expression::Kind::name && find_quantity(inside.name) == nullptr && GiNaC::is_a<GiNaC::symbol>(value)
                ? symbols_.find(value)
                : nullptr;
        letter != nullptr && letter->kind == SymbolKind::parameter)
        fail_at(Id::cannot_integrate, e, fmt::format("'{}' is the rate of '{}', which is a constant here", e.written(), letter->name));
    return symbols_.time_derivative(value);
}

/// What one can differentiate by, let go somewhere, or insert for.
const ex& Translator::variable_of(const Expression& e, const ex& variable) const {
    if (GiNaC::is_a<GiNaC::symbol>(variable)) return variable;
    fail_at(Id::wrong_arguments, *e.children[1],
            fmt::format("'{}' is not a variable, and '{}' needs one", e.children[1]->written(), e.name));
}

ex Translator::slope(const Expression& e, const ex& function, const ex& variable) const {
    if (!GiNaC::is_a<GiNaC::symbol>(variable))
        fail_at(Id::wrong_arguments, *e.children[1],
                fmt::format("'{}' is not a variable, so nothing can be differentiated by it", e.children[1]->written()));
    // Of a place that depends on coordinates the slope by time alone is meant to be zero; that of a coordinate can only be meant to be its
    // rate.
    if (variable.is_equal(symbols_.time()) && GiNaC::is_a<GiNaC::symbol>(function) && !symbols_.time_derivative(function).is_zero())
        fail_at(Id::cannot_integrate, e,
                fmt::format("'{0}' depends on time only through the motion; its derivative is dot({0})", e.children[0]->written()));
    const Variable* known = symbols_.find(variable);
    for (const SymbolKind kind : {SymbolKind::acceleration, SymbolKind::state_rate, SymbolKind::multiplier})
        for (const Variable& rate : symbols_.all(kind))
            if (function.has(rate.symbol) && (known == nullptr || known->kind != kind))
                fail_at(Id::not_allowed_here, e,
                        fmt::format("'{}' differentiates '{}', which depends on everything through the equations; write it out",
                                    e.written(), rate.name));
    const bool by_parameter = known != nullptr && known->kind == SymbolKind::parameter;
    return by_parameter ? symbols_.derivative_by_parameter(function, known->position) : partial(function, variable);
}

/// Where the variable is also a letter outside, what other letters and definitions say of that is said of the variable.
ex Translator::integrand(const Expression& e, const ex& variable, const Indices& indices, const Letters& letters) const {
    const Expression& written = *e.children[1];
    const auto letter = letters.find(written.name);
    const bool is_known = letter != letters.end() || names_.find(written.name) != nullptr || written.name == "t";
    const ex outside = is_known ? visit(written, indices, letters) : variable;
    if (outside.is_equal(variable) || !GiNaC::is_a<GiNaC::symbol>(outside)) {
        Letters inner = letters;
        inner[written.name] = variable;
        return visit(*e.children[0], indices, inner);
    }
    const ex function = symbols_.without_definitions(visit(*e.children[0], indices, letters));
    if (outside.is_equal(symbols_.time()) && !symbols_.time_derivative(function).is_equal(partial(function, outside)))
        fail_at(Id::cannot_integrate, e,
                fmt::format("'{}' depends on time through the motion, so it cannot be integrated", e.children[0]->written()));
    return function.subs(outside == variable, GiNaC::subs_options::no_pattern);
}

ex Translator::integral(const Expression& e, const Indices& indices, const Letters& letters) const {
    const GiNaC::realsymbol variable(e.children[1]->name);
    const ex function = integrand(e, variable, indices, letters);
    const auto primitive = integrate(closed(e, function), variable, Methods::all);
    DefiniteIntegral found{function, variable, 0, 0, infinite(*e.children[2]), infinite(*e.children[3]), 0};
    const auto place_of = [&](const Expression& end, int infinite) {
        return infinite != 0 ? ex(0) : closed(e, visit(end, indices, letters));
    };
    found.from = place_of(*e.children[2], found.infinite_from);
    found.to = place_of(*e.children[3], found.infinite_to);
    if (!primitive) return open_integral(e, found);
    const auto at = [&](int infinite, const ex& place) {
        return infinite != 0 ? limit(e, *primitive, variable, infinite, 0) : ex(primitive->subs(variable == place));
    };
    try {
        found.value = at(found.infinite_to, found.to) - at(found.infinite_from, found.from);
    } catch (const Failure&) {  // a limit that is not found
        if (leaves_integrals_open_) return open_integral(e, found);
        throw;
    }
    if (is_integral_ && !is_integral_(found))
        fail_at(Id::cannot_integrate, e,
                fmt::format("'{}' has a pole between the limits, or its primitive jumps there: the integral has no value or another one",
                            e.children[0]->written()));
    return found.value;
}

ex Translator::limit(const Expression& e, const ex& function, const ex& variable, int infinite, const ex& place, int side) const {
    const ex written_out = symbols_.without_definitions(closed(e, function));
    const auto found = infinite != 0 ? limit_at_infinity(written_out, variable_of(e, variable), infinite)
                                     : limit_at(written_out, variable_of(e, variable), place, side);
    if (found) return *found;
    const bool has_sides =
        infinite == 0 && side == 0 && limit_at(written_out, variable, place, 1) && limit_at(written_out, variable, place, -1);
    fail_at(Id::cannot_integrate, e,
            has_sides ? fmt::format("the limits of '{}' from the two sides differ, or the program cannot prove them equal; give the side, "
                                    "as in 'limit(e, x, 0, 1)' or '\\lim_{{x \\to 0^+}}' for above",
                                    e.children[0]->written())
                      : fmt::format("the program cannot find the limit of '{}'", e.children[0]->written()));
}

/// The integral as a letter, where those are wanted that have no primitive.
ex Translator::open_integral(const Expression& e, DefiniteIntegral& integral) const {
    if (!leaves_integrals_open_)
        fail_at(Id::cannot_integrate, e, fmt::format("the program cannot find the integral of '{}'", e.children[0]->written()));
    const auto is_same = [&](const DefiniteIntegral& known) {
        return known.function.subs(known.variable == integral.variable).is_equal(integral.function) && known.from.is_equal(integral.from) &&
               known.to.is_equal(integral.to) && known.infinite_from == integral.infinite_from && known.infinite_to == integral.infinite_to;
    };
    const auto known = std::find_if(open_.begin(), open_.end(), is_same);
    if (known != open_.end()) return known->value;
    integral.value = GiNaC::realsymbol(fmt::format("integral_{}", open_.size() + 1));
    open_.push_back(integral);
    return integral.value;
}

/// What an integral without a primitive depends on is not seen in its letter.
const ex& Translator::closed(const Expression& e, const ex& value) const {
    for (const DefiniteIntegral& integral : open_)
        if (value.has(integral.value))
            fail_at(Id::cannot_integrate, e, fmt::format("'{}' needs an integral that the program cannot find", e.written()));
    return value;
}

/// Derivatives, integrals, limits and values at a place; nothing for other functions.
std::optional<ex> Translator::calculus(const Expression& e, const Indices& indices, const Letters& letters) const {
    const auto part = [&](std::size_t i) { return closed(e, visit(*e.children[i], indices, letters)); };
    if (e.name == "dot") return rate(e, part(0));
    if (e.name == "ddot") return rate(e, rate(e, part(0)));
    if (e.name == "diff") return slope(e, part(0), part(1));
    if (e.name == "integral") return integral(e, indices, letters);
    if (e.name == "limit") {
        const int sign = infinite(*e.children[2]), side = e.children.size() < 4 ? 0 : known_sign(part(3));
        return limit(e, part(0), part(1), sign, sign != 0 ? ex(0) : part(2), side);
    }
    if (e.name != "at") return std::nullopt;
    if (part(1).is_equal(symbols_.time()) && !symbols_.time_derivative(part(0)).is_equal(partial(part(0), part(1))))
        fail_at(Id::cannot_integrate, e,
                fmt::format("'{}' depends on time through the motion, so its value at one time is not known", e.children[0]->written()));
    return symbols_.without_definitions(part(0)).subs(variable_of(e, part(1)) == part(2), GiNaC::subs_options::no_pattern);
}

}  // namespace dalembert

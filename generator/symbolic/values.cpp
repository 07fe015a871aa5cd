// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/values.hpp"

#include <cln/float.h>
#include <cln/rational_ring.h>
#include <cln/real.h>
#include <fmt/format.h>

#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// Sign of an exact constant; roots and pi make it necessary to look at digits.
int sign(const ex& constant) {
    const ex value = constant.evalf();
    if (!GiNaC::is_exactly_a<numeric>(value) || !ex_to<numeric>(value).is_real()) return 0;
    return ex_to<numeric>(value).is_zero() ? 0 : ex_to<numeric>(value).is_negative() ? -1 : 1;
}

/// For messages only.
std::string shown(const ex& constant) {
    const ex value = constant.evalf();
    return GiNaC::is_exactly_a<numeric>(value) ? fmt::format("{:.6g}", ex_to<numeric>(value).to_double()) : "a value";
}

/// Throws Failure (number-too-large) for what no arithmetic of a controller or a desk holds.
void check_magnitude(const std::string& name, const ex& value, const Span& place) {
    if (GiNaC::is_exactly_a<numeric>(value) && !value.is_zero()) {
        const numeric size = GiNaC::abs(GiNaC::ex_to<numeric>(value));
        const numeric largest = GiNaC::pow(numeric(10), numeric(budget::magnitude));
        if (size > largest || size < largest.inverse())
            throw Failure(
                Diagnostic{Id::number_too_large, place, fmt::format("the value of '{}' is beyond 1e300 or within 1e-300 of zero", name)});
    }
}

/// What would fill memory as an exact number: zero where it is that small, and nothing where it is that large.
std::optional<cln::cl_R> of_bounded_length(const cln::cl_R& x) {
    if (cln::zerop(x)) return x;
    if (cln::instanceof(x, cln::cl_RA_ring)) return bit_length(cln::the<cln::cl_RA>(x)) > budget::bits ? std::nullopt : std::optional(x);
    constexpr auto most = static_cast<long long>(100 * budget::bits);  // of a float only the exponent grows: proofs compare exp(10^6)
    const long long exponent = cln::float_exponent(cln::the<cln::cl_F>(x));
    return exponent > most ? std::nullopt : std::optional<cln::cl_R>(exponent < -most ? cln::cl_R(0) : x);
}

}  // namespace

Values::Values(const Scene& scene, const Translator& translate) : scene_(scene), translate_(translate) {
    const Symbols& symbols = translate.symbols();
    for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
        const auto& member = scene.parameters[i];
        const ExpressionPtr& value = value_of(member, scene);
        assign(symbols.all(SymbolKind::parameter)[i], translate(value, Translator::indices_of(member)), value->span);
    }
    check_fixed();
    const auto start = [&](const ExpressionPtr& value, const Indices& indices) { return value ? translate(value, indices) : ex(0); };
    for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
        const auto& member = scene.coordinates[i];
        const Indices indices = Translator::indices_of(member);
        assign(symbols.all(SymbolKind::coordinate)[i], start(start_of(member, scene), indices), member.item->span);
        assign(symbols.all(SymbolKind::velocity)[i], start(start_rate_of(member, scene), indices), member.item->span);
        if (!member.item->start.empty() && !member.item->is_guess) written_.insert(key(SymbolKind::coordinate, i));
        if (!member.item->start_rate.empty()) written_.insert(key(SymbolKind::velocity, i));
    }
    for (std::size_t i = 0; i < scene.states.size(); ++i) {
        const auto& member = scene.states[i];
        assign(symbols.all(SymbolKind::state)[i], start(start_of(member, scene), Translator::indices_of(member)), member.item->span);
    }
    for (std::size_t i = 0; i < scene.inputs.size(); ++i) values_[key(SymbolKind::input, i)] = 0;
}

/// Of parameters that are numbers.
void Values::check_fixed() const {
    for (const auto& [name, fixed] : scene_.fixed)
        for (const auto& member : members_of(static_cast<const Parameter&>(*translate_.names().find(name)->item), scene_)) {
            const ExpressionPtr& value = value_of(member, scene_);
            const ex number = translate_(value, Translator::indices_of(member));
            check_magnitude(name, number, value->span);
            check_range(*member.item, name, number, value->span);
        }
}

void Values::assign(const Variable& variable, const ex& value, const Span& place) {
    check_magnitude(variable.name, value, place);
    const ex number = GiNaC::is_exactly_a<numeric>(value) ? value : value.subs(substitution(), GiNaC::subs_options::no_pattern);
    if (variable.is_root && sign(number) < 0)
        throw Failure(Diagnostic{Id::value_out_of_range, place,
                                 fmt::format("the value of '{}' is {}, but must not be negative: the program integrates its root",
                                             variable.base, shown(number))});
    values_[key(variable.kind, variable.position)] = variable.is_root ? GiNaC::sqrt(value) : value;
    if (variable.declared != nullptr) check_range(*variable.declared, variable.name, number, place);
}

void Values::check_range(const Quantity& ranged, const std::string& name, const ex& number, const Span& place) const {
    if (const auto outside = outside_range(ranged, name, number, place, 0)) throw Failure(*outside);
}

std::optional<Diagnostic> Values::outside_range(const Quantity& ranged, const std::string& name, const ex& number, const Span& place,
                                                double tolerance) const {
    if (!ranged.range) return std::nullopt;
    const ExpressionPtr &low = ranged.range->low, &high = ranged.range->high;
    const auto limit_of = [&](const ExpressionPtr& bound) { return bound ? translate_(*bound, {}) : ex(0); };
    const ex slack = tolerance > 0 ? numeric(tolerance) * (GiNaC::abs(limit_of(low)) + GiNaC::abs(limit_of(high))) : ex(0);
    const auto check = [&](const ExpressionPtr& bound, int wrong, const char* relation) -> std::optional<Diagnostic> {
        if (!bound || sign(number - limit_of(bound) - wrong * slack) != wrong) return std::nullopt;
        const std::string unit = ranged.unit.si() == "1" ? "" : " " + ranged.unit.si();
        return Diagnostic{
            Id::value_out_of_range,
            place,
            fmt::format("the value of '{}' is {}{}, {} {}{}", name, shown(number), unit, relation, shown(limit_of(bound)), unit),
            {{ranged.range->span, fmt::format("the range of '{}' is declared here", ranged.name)}}};
    };
    const auto below = check(low, -1, "but its range begins at");
    return below ? below : check(high, 1, "but its range ends at");
}

void Values::set(const Expression& variable, const Expression& value, unsigned allowed, const Indices& indices) {
    const Symbols& symbols = translate_.symbols();
    const bool is_rate = variable.kind == Expression::Kind::call && variable.name == "dot" && variable.children.size() == 1;
    const Expression& named = is_rate ? *variable.children[0] : variable;
    if (named.kind != Expression::Kind::name || named.children.size() > 1)
        throw Failure(Diagnostic{Id::unknown_name, variable.span, fmt::format("'{}' cannot be set", variable.written())});
    std::vector<SymbolKind> kinds;
    if ((allowed & on_parameters) != 0 && !is_rate) kinds.push_back(SymbolKind::parameter);
    if ((allowed & on_inputs) != 0 && !is_rate) kinds.push_back(SymbolKind::input);
    if ((allowed & on_states) != 0) {
        kinds.push_back(is_rate ? SymbolKind::velocity : SymbolKind::coordinate);
        if (!is_rate) kinds.push_back(SymbolKind::state);
    }
    const ex number = translate_(value, indices);
    bool found = false;
    for (const SymbolKind kind : kinds)
        for (const Variable& candidate : symbols.all(kind)) {
            if (candidate.base != named.name) continue;
            if (candidate.is_member && !named.children.empty() && index_value(*named.children[0], scene_, indices) != candidate.index)
                continue;
            if (!candidate.is_member && !named.children.empty()) continue;
            // Parameters are numbers: what one is made of has the values that are set by now.
            written_.insert(key(kind, candidate.position));
            assign(candidate, kind == SymbolKind::parameter ? ex(number.subs(substitution(), GiNaC::subs_options::no_pattern)) : number,
                   value.span);
            found = true;
        }
    if (found) return;
    throw Failure(Diagnostic{Id::unknown_name, variable.span,
                             fmt::format("'{}' of scene '{}' does not exist or cannot be set here", variable.written(), scene_.name)});
}

GiNaC::exmap Values::substitution() const {
    const Symbols& symbols = translate_.symbols();
    GiNaC::exmap parameters;
    for (const auto& [which, value] : values_)
        if (which.first == SymbolKind::parameter) parameters[symbols.get(which.first, which.second)] = value;
    GiNaC::exmap map = parameters;
    for (std::size_t i = 0; i < symbols.model_definitions(); ++i) {
        const ex& definition = symbols.get(SymbolKind::definition, i);
        map[definition] = symbols.without_definitions(definition).subs(parameters, GiNaC::subs_options::no_pattern);
    }
    for (const auto& [which, value] : values_)
        if (which.first != SymbolKind::parameter)
            map[symbols.get(which.first, which.second)] = value.subs(map, GiNaC::subs_options::no_pattern);
    map[symbols.time()] = time_;
    return map;
}

FloatPoint::FloatPoint(const GiNaC::exmap& constants, int digits) : floats_({}), digits_(digits) {
    GiNaC::Digits = digits_ + guard_digits;
    try {
        GiNaC::exmap floats;
        for (const auto& [letter, value] : constants) floats[letter] = value.evalf();
        floats_ = WithLetters(std::move(floats));
    } catch (const std::exception&) {
        has_value_ = false;
    }
}

std::optional<cln::cl_R> FloatPoint::value(const ex& e) const {
    if (!has_value_) return std::nullopt;
    GiNaC::Digits = digits_ + guard_digits;
    try {
        const ex value = floats_(e).evalf();
        if (!GiNaC::is_exactly_a<numeric>(value)) return std::nullopt;
        const numeric& number = ex_to<numeric>(value);
        if (!number.is_real()) return std::nullopt;
        return of_bounded_length(cln::realpart(number.to_cl_N()));
    } catch (const std::exception&) {  // a pole, an overflow: the expression has no value there
        return std::nullopt;
    }
}

std::optional<cln::cl_R> value_at(const ex& e, const GiNaC::exmap& constants, int digits) { return FloatPoint(constants, digits).value(e); }

void add_steps(GiNaC::exmap& point, const Symbols& symbols, int digits) {
    if (symbols.count(SymbolKind::definition) == symbols.model_definitions()) return;
    GiNaC::Digits = digits;
    for (std::size_t i = symbols.model_definitions(); i < symbols.count(SymbolKind::definition); ++i) {
        try {
            const ex value = symbols.definition_values()[i].subs(point, GiNaC::subs_options::no_pattern).evalf();
            if (GiNaC::is_exactly_a<numeric>(value)) point[symbols.get(SymbolKind::definition, i)] = value;
        } catch (const std::exception&) {  // a pole
        }
    }
}

std::vector<ex> Values::state() const {
    std::vector<ex> result;
    const GiNaC::exmap map = substitution();
    for (const Variable* variable : translate_.symbols().state_variables())
        result.push_back(values_.at(key(variable->kind, variable->position)).subs(map, GiNaC::subs_options::no_pattern));
    return result;
}

std::vector<ex> Values::inputs() const {
    std::vector<ex> result;
    const GiNaC::exmap map = substitution();
    for (std::size_t i = 0; i < translate_.symbols().count(SymbolKind::input); ++i)
        result.push_back(values_.at(key(SymbolKind::input, i)).subs(map, GiNaC::subs_options::no_pattern));
    return result;
}

}  // namespace dalembert

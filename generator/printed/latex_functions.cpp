// SPDX-License-Identifier: GPL-3.0-or-later
// Functions with a name: \sin^2 x, \ln(...), \operatorname{sign}(v), \min\{a, b\}, \nabla.
#include <fmt/format.h>

#include "language/vocabulary.hpp"
#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

/// Besides those of the vocabulary; "1/tan" is one over it.
const std::map<std::string, std::string, std::less<>> other_names{
    {"sinc", "sinc"},       {"lg", "lg"},            {"cot", "1/tan"},       {"coth", "1/tanh"},
    {"sec", "1/cos"},       {"csc", "1/sin"},        {"sign", "sign"},        {"sgn", "sign"},        {"signum", "sign"},
    {"det", "determinant"}, {"tr", "trace"},         {"trace", "trace"},      {"diag", "diag"},       {"grad", "gradient"},
    {"div", "divergence"},  {"rot", "curl"},         {"curl", "curl"},        {"abs", "abs"},         {"sqrt", "sqrt"},
    {"atan2", "atan2"},     {"arctan2", "atan2"},    {"artanh", "artanh"},    {"arsinh", "arsinh"},   {"arcosh", "arcosh"},
    {"atanh", "artanh"},    {"asinh", "arsinh"},     {"acosh", "arcosh"},     {"argmin", "argmin"},   {"argmax", "argmax"},
    {"arg min", "argmin"},  {"arg max", "argmax"},   {"arg\\,min", "argmin"}, {"arg\\,max", "argmax"}, {"arctanh", "artanh"},
    {"arcsinh", "arsinh"},  {"arccosh", "arcosh"}};

/// What a printed name is in the model language; empty: no function.
std::string function_name(std::string_view printed) {
    if (const auto other = other_names.find(printed); other != other_names.end()) return other->second;
    const FunctionSpec* function = find_function_of_latex(printed);
    return function != nullptr ? function->name : "";
}

/// What \sin^{-1} may mean.
const std::map<std::string, std::string, std::less<>> inverse_names{{"sin", "\\arcsin"},
                                                                    {"cos", "\\arccos"},
                                                                    {"tan", "\\arctan"},
                                                                    {"sinh", "\\operatorname{arsinh}"},
                                                                    {"cosh", "\\operatorname{arcosh}"},
                                                                    {"tanh", "\\operatorname{artanh}"}};

/// Letters that are angles by custom and so end the argument of a function without brackets.
const std::set<std::string, std::less<>> angles{"\\alpha",    "\\beta", "\\gamma",  "\\delta", "\\theta",
                                                "\\vartheta", "\\phi",  "\\varphi", "\\psi",   "\\chi"};

/// The inverse of a hyperbolic function, by logarithms, where it is real.
ExpressionPtr inverse_hyperbolic(const std::string& name, const ExpressionPtr& x, const Span& span) {
    const auto joined = [&](Expression::Kind kind, ExpressionPtr a, ExpressionPtr b) {
        return std::make_shared<Expression>(Expression{kind, span, 0, {}, {std::move(a), std::move(b)}});
    };
    const auto of = [&](const char* function, ExpressionPtr a) {
        return std::make_shared<Expression>(Expression{Expression::Kind::call, span, 0, function, {std::move(a)}});
    };
    const ExpressionPtr one = make_number(1, span), two = make_number(2, span);
    if (name == "artanh")
        return joined(
            Expression::Kind::divide,
            of("log", joined(Expression::Kind::divide, joined(Expression::Kind::add, one, x), joined(Expression::Kind::subtract, one, x))),
            two);
    const ExpressionPtr square = joined(Expression::Kind::power, x, two);
    return of("log", joined(Expression::Kind::add, x,
                            of("sqrt", joined(name == "arsinh" ? Expression::Kind::add : Expression::Kind::subtract, square, one))));
}

std::string bare(const LatexToken& t) { return t.kind == LatexToken::Kind::command ? t.text.substr(1) : t.text; }

}  // namespace

bool LatexParser::is_function(const LatexToken& t) const {
    return (t.kind == LatexToken::Kind::command && t.text.size() > 1 && !function_name(std::string_view(t.text).substr(1)).empty()) ||
           (t.kind == LatexToken::Kind::upright && !function_name(t.text).empty());
}

/// Brackets hold the whole argument; without them note [how a product is read].
ExpressionPtr LatexParser::function_argument(const std::string& name) {
    const Depth depth(*this);
    const LatexToken& t = token();
    const Inside brackets(*this);
    if (t.side != Side::right &&
        (t.is("(") || t.is("[") || t.is("\\{") || (t.side == Side::left && !t.is("|") && !t.is("\\|") && !t.is("."))))
        return bracket();
    if (t.is("{") && !starts_letter(at_)) return group();
    if (t.is("|") || t.is("\\|")) return magnitude();
    if (t.is("-") || (is_function(t) && !t.is("\\sqrt"))) expected(fmt::format("a bracket around the argument of '{}'", name));
    const std::size_t first = at_;
    ExpressionPtr argument;
    bool is_only_number = true;
    while (argument == nullptr || starts_factor()) {
        const LatexToken& part = token();
        const bool is_number = part.kind == LatexToken::Kind::number;
        const bool is_fraction = part.is("\\frac") && !is_derivative();
        const bool is_plain_letter = (part.kind == LatexToken::Kind::letter || is_greek(part.text)) && !at_differential();
        const bool is_marked = !is_plain_letter && (part.kind == LatexToken::Kind::upright || starts_letter(at_) || part.is("\\sqrt"));
        if (argument == nullptr && !is_number && !is_fraction && !is_plain_letter && !is_marked)
            expected(fmt::format("the argument of '{}'", name));
        if (argument != nullptr) {
            if (part.space >= Space::thin) break;
            if (part.is("(") || part.is("[") || part.side == Side::left) {
                if (is_only_number) break;
                wrong(
                    place(part),
                    fmt::format("it is not clear whether this bracket belongs to the argument of '{}'; write brackets around the argument",
                                name));
            }
            if (!is_number && !is_plain_letter && !(is_fraction && is_only_number)) break;
        }
        const bool is_angle = is_plain_letter && angles.contains(part.text);
        const std::size_t begin = at_;
        const auto marked = is_marked && part.kind == LatexToken::Kind::command && !part.is("\\sqrt") ? letter_at(at_) : std::nullopt;
        ExpressionPtr next_part = factor();
        const bool may_go_on = marked && !marked->first.letter.marks.empty() && !marked->first.letter.is_vector() &&
                               !angles.contains(marked->first.letter.base);
        if (may_go_on && token().space < Space::thin && (token().kind == LatexToken::Kind::letter || is_greek(token().text)) &&
            starts_factor() && !at_differential())
            wrong(place(token()),
                  fmt::format("it is not clear whether '{}' belongs to the argument of '{}'; write brackets around the argument",
                              shown(token()), name));  // \cos\bar\omega t
        const bool is_numeric =
            next_part->kind == Kind::number || (next_part->kind == Kind::divide && next_part->children[0]->kind == Kind::number &&
                                                next_part->children[1]->kind == Kind::number);
        is_only_number = is_only_number && (is_numeric || at(begin).is("\\pi"));
        argument = argument ? node(Kind::multiply, first, {std::move(argument), std::move(next_part)}) : std::move(next_part);
        if (is_angle || is_marked || (is_fraction && !is_numeric)) break;
    }
    return argument;
}

/// The smallest or largest of two or more: min(a, min(b, c)).
ExpressionPtr LatexParser::extremum(const std::string& name, std::size_t first) {
    const LatexToken open = token();
    if (!is("(") && !is("\\{") && !is("[")) expected(fmt::format("a bracket with the arguments of '{}'", name));
    next();
    std::vector<ExpressionPtr> all = list_until_bracket(open);
    if (all.size() < 2) wrong(from(first), fmt::format("'{}' needs two arguments; write a blank behind the comma between numbers", name));
    ExpressionPtr result = all.back();
    for (std::size_t i = all.size() - 1; i-- > 0;) result = call(name, first, {all[i], result});
    return result;
}

ExpressionPtr LatexParser::function() {
    const Depth depth(*this);
    const std::size_t first = at_;
    const std::string arg = take("\\arg") ? "arg" : "";
    const std::string printed = arg + bare(next());
    std::string name = function_name(printed);
    if (name.starts_with("arg") || ((name == "min" || name == "max" || name == "inf" || name == "sup") && is("_")))
        return extremum_over(name, first);
    if (name == "min" || name == "max") return extremum(name, first);
    if (name == "atan2") {
        const LatexToken open = token();
        expect("(");
        auto arguments = list_until_bracket(open);
        if (arguments.size() != 2) wrong(from(first), fmt::format("'atan2' has two arguments, not {}", arguments.size()));
        return call("atan2", first, std::move(arguments));
    }
    ExpressionPtr power;
    ExpressionPtr base;
    for (bool more = true; more;) {
        more = false;
        if (is("^") && !power) {
            next();
            const Inside brackets(*this);
            power = braced("the power of the function");
            more = true;
        } else if (is("_") && !base && name == "log") {
            next();
            const Inside brackets(*this);
            base = braced("the base of the logarithm");
            more = true;
        }
    }
    const bool is_inverse =
        power && power->kind == Kind::negate && power->children[0]->kind == Kind::number && power->children[0]->value == 1;
    if (is_inverse) {
        const auto inverse = inverse_names.find(name);
        if (inverse == inverse_names.end())
            wrong(power->span, fmt::format("the inverse of '{}' is not read; write it out, or 1/{}", printed, printed));
        wrong(
            power->span,
            fmt::format("it is not clear whether '\\{}^{{-1}}' is the inverse function or 1/\\{}; write '{}' or '\\frac{{1}}{{\\{} ...}}'",
                        printed, printed, inverse->second, printed));
    }
    const bool is_bracketed = token().kind == LatexToken::Kind::sign;
    ExpressionPtr argument = function_argument(printed);
    if (!is_bracketed && is("/") && token(1).kind == LatexToken::Kind::number)
        wrong(place(token()), fmt::format("it is not clear whether '/{}' belongs to the argument of '{}'; write '\\frac' or brackets",
                                          shown(token(1)), printed));
    if (name == "lg") {
        base = make_number(10, from(first));
        name = "log";
    }
    ExpressionPtr result;
    if (name.starts_with("1/")) {
        const ExpressionPtr inside = call(name.substr(2), first, {std::move(argument)});
        result = node(Kind::divide, first, {make_number(1, from(first)), inside});
    } else if (name == "artanh" || name == "arsinh" || name == "arcosh") {
        result = inverse_hyperbolic(name, argument, from(first));
    } else {
        result = call(name, first, {std::move(argument)});
    }
    if (base) {
        const ExpressionPtr of_base = call("log", first, {base});
        result = node(Kind::divide, first, {std::move(result), of_base});
    }
    return power ? node(Kind::power, first, {std::move(result), std::move(power)}) : result;
}

ExpressionPtr LatexParser::nabla() {
    const std::size_t first = at_;
    next();
    if (is("^")) {  // \nabla^2 e
        const std::size_t power = at_;
        next();
        const bool braced = take("{");
        const bool is_two = token().kind == LatexToken::Kind::number && token().text == "2";
        if (is_two) next();
        if (is_two && (!braced || take("}")) && starts_factor()) {
            ExpressionPtr inside = factor();
            return call("laplacian", first, {std::move(inside)});
        }
        at_ = power;
        return make_name("nabla", from(first));
    }
    const bool is_divergence = is("\\cdot");
    const bool is_curl = is("\\times");
    if (is_divergence || is_curl) next();
    if (!starts_factor()) {
        if (is_divergence || is_curl) expected("what is differentiated");
        return make_name("nabla", from(first));
    }
    ExpressionPtr inside = factor();
    return call(is_divergence ? "divergence" : is_curl ? "curl" : "gradient", first, {std::move(inside)});
}

}  // namespace dalembert

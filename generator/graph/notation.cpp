// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/notation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "graph/angle_sums.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/heat_formulas.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

/// Where a letter stands in a product: parameters, what is given, functions, coordinates, velocities, accelerations.
int rank(const Atom& atom) {
    if (atom.variable == nullptr) return !atom.is_dynamic ? 1 : 5;
    switch (atom.variable->kind) {
        case SymbolKind::parameter:
        case SymbolKind::definition: return 0;
        case SymbolKind::time:
        case SymbolKind::input: return 2;
        case SymbolKind::letter:
        case SymbolKind::state: return 3;
        case SymbolKind::coordinate: return 4;
        case SymbolKind::velocity: return 6;
        default: return 7;
    }
}

/// The order of terms: those with accelerations first, then velocities, then the rest, each by declaration.
std::vector<int> term_key(const Monomial& m, const Atoms& atoms) {
    std::vector<int> key;
    for (const LetterPower& power : m) {
        const int r = rank(atoms[power.letter]);
        if (r >= 6) key.push_back(-r * 100000 + static_cast<int>(power.letter));
    }
    std::sort(key.begin(), key.end());
    if (key.empty()) key.push_back(0);
    for (const LetterPower& power : m) key.push_back(static_cast<int>(power.letter));
    return key;
}

std::string number(const cln::cl_I& n) { return to_string(n); }

}  // namespace

std::string latex_name(const std::string& name) {
    static const std::set<std::string, std::less<>> greek{"alpha",  "beta",    "gamma", "delta", "zeta",  "eta",   "theta", "iota",
                                                          "kappa",  "lambda",  "mu",    "nu",    "xi",    "pi",    "rho",   "sigma",
                                                          "tau",    "upsilon", "chi",   "psi",   "omega", "Gamma", "Delta", "Theta",
                                                          "Lambda", "Xi",      "Pi",    "Sigma", "Phi",   "Psi",   "Omega"};
    const std::size_t index = name.find('_');
    std::string base = name.substr(0, index);
    if (base == "phi") base = "\\varphi";
    else if (base == "epsilon") base = "\\varepsilon";
    else if (greek.contains(base)) base.insert(0, "\\");
    else if (base.size() > 1) base = "\\mathrm{" + base + "}";
    if (index == std::string::npos) return base;
    std::string below = name.substr(index + 1);
    for (std::size_t i = 0; (i = below.find('_', i)) != std::string::npos; ++i) below[i] = ',';
    return base + "_{" + (greek.contains(below) ? "\\" + below : below == "phi" ? "\\varphi" : "\\mathrm{" + below + "}") + "}";
}

std::string Notation::symbol(const Variable& variable) const {
    if (style_ == Style::text) return variable.name;
    std::string name = latex_name(
        variable.kind == SymbolKind::multiplier ? "lambda" + variable.base.substr(std::string("constraint_force").size()) : variable.base);
    const auto dotted = [&](const char* dots) {
        const std::size_t index = name.find('_');
        name = index == std::string::npos ? fmt::format("\\{}{{{}}}", dots, name)
                                          : fmt::format("\\{}{{{}}}{}", dots, name.substr(0, index), name.substr(index));
    };
    if (variable.kind == SymbolKind::velocity || variable.kind == SymbolKind::state_rate) dotted("dot");
    if (variable.kind == SymbolKind::acceleration) dotted("ddot");
    if (!variable.is_member) return name;
    const std::size_t close = name.rfind('}');
    const bool has_index = name.find("_{") != std::string::npos;
    return has_index ? name.substr(0, close) + fmt::format(",{}}}", variable.index) : name + fmt::format("_{{{}}}", variable.index);
}

std::string Notation::power(const std::string& base, bool is_compound, int exponent) const {
    const std::string inside = is_compound ? (style_ == Style::text ? "(" + base + ")" : "\\left(" + base + "\\right)") : base;
    if (exponent == 1) return inside;
    return style_ == Style::text ? fmt::format("{}^{}", inside, exponent) : fmt::format("{}^{{{}}}", inside, exponent);
}

std::string Notation::fraction(const std::string& above, const std::string& below, bool below_is_compound) const {
    if (style_ == Style::latex) return fmt::format("\\frac{{{}}}{{{}}}", above.empty() ? "1" : above, below);
    return fmt::format("{}/{}", above.empty() ? "1" : above, below_is_compound ? "(" + below + ")" : below);
}

/// A sum kept whole that stands alone needs no brackets.
Polynomial Notation::without_brackets(const Polynomial& p, const Atoms& atoms) {
    if (!p.is_monomial()) return p;
    const auto& [m, coefficient] = *p.terms().begin();
    const bool is_sum = m.size() == 1 && m[0].exponent == 1 && cln::abs(coefficient) == 1 && atoms[m[0].letter].op == Op::sum;
    if (!is_sum) return p;
    Polynomial inside = atoms[m[0].letter].arguments[0];
    inside *= coefficient;
    return inside;
}

std::string Notation::atom(const Atom& a, const Atoms& atoms) const {
    if (a.variable != nullptr) return symbol(*a.variable);
    if (a.op == Op::pi) return style_ == Style::text ? "pi" : "\\pi";
    std::vector<std::string> arguments;
    for (const Polynomial& argument : a.arguments) arguments.push_back(polynomial(without_brackets(argument, atoms), atoms, 0));
    if (a.op == Op::sum) return arguments[0];
    if (a.op == Op::power) {
        if (style_ == Style::text) return fmt::format("({})^({})", arguments[0], arguments[1]);
        return fmt::format("\\left({}\\right)^{{{}}}", arguments[0], arguments[1]);
    }
    if (a.op >= Op::curve_integral && a.op <= Op::curve_third) {
        const CurveCall call{&curve_of(leading(a.arguments[1])), static_cast<int>(a.op) - static_cast<int>(Op::curve_value)};
        if (style_ == Style::text) return fmt::format("{}({})", name_of_curve_function(call), arguments[0]);
        const std::string name = latex_name(call.curve->name);
        if (call.order < 0) return fmt::format("\\int_{{0}}^{{{}}}{{{}}}", arguments[0], name);
        return fmt::format("{{{}}}{}\\left({}\\right)", name, std::string(static_cast<std::size_t>(call.order), '\''), arguments[0]);
    }
    if (a.op == Op::map_value) {
        const MapCall call = map_call_of(leading(a.arguments[2]));
        if (style_ == Style::text) return fmt::format("{}({}, {})", name_of_map_function(call), arguments[0], arguments[1]);
        std::string slope;
        for (const std::size_t axis : {0U, 1U})
            for (int i = 0; i < call.orders[axis]; ++i) slope += latex_name(call.map->variables[axis]) + " ";
        const std::string map = latex_name(call.map->name), name = slope.empty() ? map : fmt::format("\\partial_{{{}}}{{{}}}", slope, map);
        // From zero to an argument, whose place the variable takes.
        std::string before, inside[2], behind;
        for (const std::size_t axis : {0U, 1U}) {
            const bool is_integral = call.map->is_integral[axis];
            inside[axis] = is_integral ? latex_name(call.map->variables[axis]) : arguments[axis];
            if (!is_integral) continue;
            before = fmt::format("\\int_{{0}}^{{{}}}", arguments[axis]) + before;
            behind += fmt::format("\\, d{}", inside[axis]);
        }
        return fmt::format("{}{}\\left({}, {}\\right){}", before, name, inside[0], inside[1], behind);
    }
    if (a.op == Op::if_else) {
        if (style_ == Style::text) return fmt::format("if({} >= 0, {}, {})", arguments[0], arguments[1], arguments[2]);
        return fmt::format("\\operatorname{{if}}\\left({} \\ge 0, {}, {}\\right)", arguments[0], arguments[1], arguments[2]);
    }
    if (style_ == Style::text) return fmt::format("{}({})", name_of(a.op), fmt::join(arguments, ", "));
    const ScalarFunction& function = scalar_function(a.op);
    const std::string inside = fmt::format("{}", fmt::join(arguments, ", "));
    if (function.latex != nullptr) return fmt::format(fmt::runtime(function.latex), inside);
    const FunctionSpec* word = find_function(function.name);
    const bool has_command = word != nullptr && word->latex != nullptr;
    return fmt::format("{}\\left({}\\right)", has_command ? word->latex : fmt::format("\\operatorname{{{}}}", function.name), inside);
}

namespace {

/// A number as a product with a power of the constant of radiation, which is known by its digits.
std::pair<Rational, int> without_radiation(Rational coefficient) {
    const Rational constant = stefan_boltzmann();
    const cln::cl_I digits = cln::numerator(constant);
    int power = 0;
    for (; !cln::zerop(coefficient) && cln::zerop(cln::mod(cln::numerator(coefficient), digits)); ++power)
        coefficient = coefficient / constant;
    for (; cln::zerop(cln::mod(cln::denominator(coefficient), digits)); --power) coefficient = coefficient * constant;
    return {coefficient, power};
}

}  // namespace

/// coefficient * (collected) * letters, what has a negative exponent below a fraction bar. The sign is left to the caller.
std::string Notation::monomial(const Monomial& m, const Rational& coefficient, const std::string& collected, const Atoms& atoms) const {
    const char* times = style_ == Style::text ? "*" : " ";
    std::vector<LetterPower> sorted(m.begin(), m.end());
    std::stable_sort(sorted.begin(), sorted.end(), [&](const LetterPower& a, const LetterPower& b) {
        const int ra = rank(atoms[a.letter]);
        const int rb = rank(atoms[b.letter]);
        return ra != rb ? ra < rb : a.letter < b.letter;
    });
    std::string above;
    std::string below;
    int factors_below = 0;
    const auto append = [&](std::string& to, const std::string& factor) { to += (to.empty() ? "" : times) + factor; };
    const auto [plain, radiation] = without_radiation(coefficient);
    const cln::cl_I numerator = cln::abs(cln::numerator(plain));
    const cln::cl_I denominator = cln::denominator(plain);
    if (numerator != 1) append(above, number(numerator));
    if (denominator != 1) {
        append(below, number(denominator));
        ++factors_below;
    }
    if (radiation != 0) {
        append(radiation > 0 ? above : below, power(style_ == Style::text ? "stefan_boltzmann" : "\\sigma", false, std::abs(radiation)));
        factors_below += radiation > 0 ? 0 : 1;
    }
    bool placed = collected.empty();
    for (const LetterPower& p : sorted) {
        const Atom& a = atoms[p.letter];
        if (!placed && rank(a) > 1) {  // behind the parameters
            append(above, collected);
            placed = true;
        }
        const std::string text = power(atom(a, atoms), a.op == Op::sum, std::abs(p.exponent));
        append(p.exponent > 0 ? above : below, text);
        factors_below += p.exponent > 0 ? 0 : 1;
    }
    if (!placed) append(above, collected);
    if (below.empty()) return above.empty() ? "1" : above;
    return fraction(above, below, factors_below > 1);
}

/// What all terms of a sum of parameters have in common: content * letters * rest, rest starting with a positive term.
struct Notation::Factored {
    Rational content = 1;
    Monomial letters;
    Polynomial rest;
};

Notation::Factored Notation::factored(const Polynomial& p, const Atoms& atoms) {
    Factored result;
    // A number is taken out where it is the same everywhere; else fractions would turn up where nobody wrote any.
    const Rational first = cln::abs(p.terms().begin()->second);
    bool same = true;
    Monomial common = p.terms().begin()->first;
    for (const auto& [m, coefficient] : p.terms()) {
        same = same && cln::abs(coefficient) == first;
        Monomial shared;
        for (const LetterPower& power : common) {
            const int other = exponent_of(m, power.letter);
            if (power.exponent > 0 && other > 0) shared.push_back({power.letter, std::min(power.exponent, other)});
            if (power.exponent < 0 && other < 0) shared.push_back({power.letter, std::max(power.exponent, other)});
        }
        common = std::move(shared);
    }
    result.content = same ? first : Rational(1);
    if (atoms.leading_sign(p) < 0) result.content = -result.content;
    result.letters = common;
    for (const auto& [m, coefficient] : p.terms()) result.rest.add(m * raised(common, -1), coefficient / result.content);
    return result;
}

/// Terms are collected twice: by velocities and accelerations, and below that by what depends on coordinates and time.
std::string Notation::polynomial(const Polynomial& p, const Atoms& atoms, int level) const {
    const auto is_key = [&](const Atom& a) { return level == 2 ? rank(a) >= 6 : level == 1 ? a.is_dynamic : true; };
    std::map<Monomial, Polynomial> collected;
    for (const auto& [m, coefficient] : p.terms()) {
        Monomial key;
        Monomial rest;
        for (const LetterPower& power : m) (is_key(atoms[power.letter]) ? key : rest).push_back(power);
        collected[key].add(rest, coefficient);
    }
    std::vector<std::pair<Monomial, Polynomial>> terms(collected.begin(), collected.end());
    std::stable_sort(terms.begin(), terms.end(),
                     [&](const auto& a, const auto& b) { return term_key(a.first, atoms) < term_key(b.first, atoms); });
    std::string text;
    for (const auto& [key, factor] : terms) {
        const bool is_plain_sum = level == 2 && key.empty();
        if (is_plain_sum) {  // what contains no velocity stands without brackets behind the rest
            const std::string rest = polynomial(factor, atoms, 1);
            if (text.empty()) return rest;
            text += rest.starts_with('-') ? " - " + rest.substr(1) : " + " + rest;
            continue;
        }
        const Factored f = factored(factor, atoms);
        std::string inside;
        if (!(f.rest == Polynomial(1))) {
            inside = polynomial(f.rest, atoms, level == 2 ? 1 : 0);
            const bool alone = terms.size() == 1 && key.empty() && f.letters.empty() && f.content == 1;
            if (alone) return inside;
            inside = style_ == Style::text ? "(" + inside + ")" : "\\left(" + inside + "\\right)";
        }
        const std::string term = monomial(key * f.letters, f.content, inside, atoms);
        if (text.empty()) text = (is_negative(f.content) ? "-" : "") + term;
        else text += (is_negative(f.content) ? " - " : " + ") + term;
    }
    return text.empty() ? "0" : text;
}

std::string Notation::operator()(const GiNaC::ex& e) const {
    Atoms atoms(symbols_);
    Polynomial p = lower(e, atoms, FractionalPowers::as_written);
    atoms.canonicalise({&p});
    return polynomial(without_brackets(with_angle_sums(std::move(p), atoms), atoms), atoms, 2);
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/equivalence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "prove/branches.hpp"
#include "prove/normal_form.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/parts.hpp"
#include "symbolic/quotient.hpp"
#include "symbolic/switches.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr int needed_points = 30;
constexpr int most_points = 300;
constexpr int wide_points = 60;

bool is_square_root(const ex& e) {
    return GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::rational) && !e.op(1).info(GiNaC::info_flags::integer);
}

/// Whether a root stands in a root, or over a fraction.
bool has_nested_roots(const ex& e) {
    return any_part(e, [](const ex& part) {
        return is_square_root(part) && any_part(part.op(0), [](const ex& inner) {
                   return is_square_root(inner) || (GiNaC::is_a<GiNaC::power>(inner) && inner.op(1).info(GiNaC::info_flags::negint) &&
                                                    GiNaC::is_a<GiNaC::add>(inner.op(0)));
               });
    });
}

/// Roots and functions with kinks become letters. What is equal whatever the letters are is equal, and the form of what stands in a root,
/// which may be long, is not needed: two balances that a flow stands in have the same letter. Of x and -x only one has letters, and
/// max(a, b) = b + max(a - b, 0), min(a, b) = a - max(a - b, 0), |x| = 2*max(x, 0) - x.
class AsLetters : public GiNaC::map_function {
public:
    ex operator()(const ex& e) override {
        if (GiNaC::is_exactly_a<GiNaC::function>(e)) return of_function(e);
        if (GiNaC::is_exactly_a<GiNaC::power>(e)) {
            if (is_exponential(e.op(0))) return GiNaC::exp((argument(e.op(0).op(0)) * argument(e.op(1))).expand());
            if (!e.op(1).info(GiNaC::info_flags::integer)) return letter(GiNaC::pow(argument(e.op(0)), argument(e.op(1))));
        }
        return e.map(*this);
    }
    bool has_any() const { return !letters_.empty(); }
    /// With all that letters stand for, which may have letters itself.
    ex written_out(ex e) const {
        for (auto last = meaning_.rbegin(); last != meaning_.rend(); ++last)
            e = e.subs(last->first == last->second, GiNaC::subs_options::no_pattern);
        return e;
    }

private:
    ex of_function(const ex& e) {
        if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return (*this)(e.op(0));
        if (is_ex_the_function(e, maximum)) return (*this)(e.op(1)) + above_zero(argument(e.op(0) - e.op(1)));
        if (is_ex_the_function(e, minimum)) return (*this)(e.op(0)) - above_zero(argument(e.op(0) - e.op(1)));
        if (is_ex_the_function(e, magnitude)) return 2 * above_zero(argument(e.op(0))) - (*this)(e.op(0));
        if (is_ex_the_function(e, unit_step)) {
            const ex x = argument(e.op(0));
            return is_first(x) ? letter(unit_step(x)) : 1 - letter(unit_step((-x).expand()));
        }
        if (is_ex_the_function(e, signed_root)) {
            const ex x = argument(e.op(0));
            return is_first(x) ? letter(signed_root(x)) : -letter(signed_root((-x).expand()));
        }
        if (is_ex_the_function(e, sign_of)) {
            const ex x = argument(e.op(0));
            return is_first(x) ? letter(sign_of(x)) : -letter(sign_of((-x).expand()));
        }
        if (switch_of(e) || curve_call(e) || map_call(e)) return letter(e.map(*this));
        return e.map(*this);
    }
    ex argument(const ex& e) { return (*this)(e).expand(GiNaC::expand_options::expand_function_args); }
    static bool is_first(const ex& x) { return x.compare((-x).expand()) <= 0; }
    static bool is_exponential(const ex& e) {
        return GiNaC::is_a<GiNaC::function>(e) && GiNaC::ex_to<GiNaC::function>(e).get_name() == "exp";
    }
    ex above_zero(const ex& x) {
        const ex negative = (-x).expand();
        return is_first(x) ? letter(maximum(x, 0)) : x + letter(maximum(negative, 0));
    }
    ex letter(const ex& e) {
        if (GiNaC::is_a<GiNaC::numeric>(e)) return e;
        const auto [known, is_new] = letters_.emplace(e, 0);
        if (is_new) {
            known->second = GiNaC::realsymbol(fmt::format("letter {}", letters_.size()));
            meaning_.emplace_back(known->second, e);
        }
        return known->second;
    }
    std::map<ex, ex, GiNaC::ex_is_less> letters_;
    std::vector<std::pair<ex, ex>> meaning_;  ///< in the order in which they were met
};

/// Whether something may become a letter. To look costs less than to write it anew, and mostly nothing does.
bool may_have_letters(const ex& e) {
    return any_part(e, [](const ex& part) {
        const bool is_wave = GiNaC::is_the_function<GiNaC::sin_SERIAL>(part) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(part);
        return (GiNaC::is_exactly_a<GiNaC::function>(part) && !is_wave) ||
               (GiNaC::is_exactly_a<GiNaC::power>(part) && !part.op(1).info(GiNaC::info_flags::integer));
    });
}

/// The rules S^2 = 1, root > 0 and I*den = 1 hold only where the argument is not zero. If it is zero, and the form does not see that,
/// nothing is proven.
template <class SeemsZero>
bool is_proven_zero(NormalForm& form, const ex& e, SeemsZero&& seems_zero) {
    try {
        if (!form.is_zero(e)) return false;
        const auto& claimed = form.must_not_vanish();
        return std::none_of(claimed.begin(), claimed.end(), [&](const ex& denied) { return seems_zero(denied); });
    } catch (const NoNormalForm&) {  // too large or outside what the method knows: not proven
        return false;
    }
}

bool is_equal_in_letters(const ex& difference, ZeroAtPoints& seems_zero) {
    if (!may_have_letters(difference)) return false;
    AsLetters as_letters;
    const ex written = as_letters(difference);
    if (!as_letters.has_any()) return false;
    NormalForm form;
    return is_proven_zero(form, written, [&](const ex& e) { return seems_zero(as_letters.written_out(e)); });
}

/// The signs of two sides and of their difference at a point.
struct SidesAt {
    SidesAt(const Prover::Evaluation& evaluate, const ex& a, const ex& b, const Point& point) {
        const auto sign = [&](const ex& e) { return sign_at([&](int digits) { return evaluate(e, point, digits); }); };
        left = sign(a);
        right = sign(b);
        difference = sign(a - b);
    }
    bool has_values() const { return left != Sign::none && right != Sign::none && difference != Sign::none; }
    bool is_one_sided() const { return (left == Sign::none) != (right == Sign::none); }
    bool differ() const { return has_values() && difference == Sign::not_zero; }
    bool is_telling() const { return has_values() && (left == Sign::not_zero || right == Sign::not_zero); }
    Sign left, right, difference;
};

/// A difference is one if it stays with so many digits that nothing of its size is lost in what it is taken from: 300 + exp(-1000) - 300.
bool stays(const Prover::Evaluation& evaluate, const ex& difference, const Point& point) {
    constexpr int few = 180, most = 20'000;
    const auto rough = evaluate(difference, point, few);
    if (!rough || cln::zerop(*rough)) return false;
    const auto binary_exponent = cln::float_exponent(cln::cl_float(cln::abs(*rough), cln::float_format(20)));
    const auto digits = std::min<std::intmax_t>(most, few + std::max<std::intmax_t>(0, -binary_exponent));
    const auto fine = evaluate(difference, point, static_cast<int>(digits));
    return fine && 100 * cln::abs(*fine - *rough) < cln::abs(*rough);
}

/// Whether two sides differ at one of a few points, where a proof would be long: of products of sums. Of polynomials numbers say so for
/// certain.
bool is_long_and_differs(const System& system, const ex& difference) {
    constexpr double long_from = 1000;
    constexpr int tries = 3;
    if (!difference.info(GiNaC::info_flags::rational_polynomial) || terms_when_expanded(difference) < long_from) return false;
    RandomPoints points(system);
    for (int i = 0; i < tries; ++i) {
        const Point point = points.next();
        const auto evaluate = [&](const ex& e, const Point& at, int digits) { return value_at(e, system.symbols, at, digits); };
        if (sign_at([&](int digits) { return evaluate(difference, point, digits); }) == Sign::not_zero &&
            stays(evaluate, difference, point))
            return true;
    }
    return false;
}

/// "x > 0, y > 0"
std::string positive_names(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name + " > 0";
    return text;
}

}  // namespace

Prover::Prover(const System& system) : system_(system), seems_zero_(system), ranged_(system.translate) {}

bool Prover::proven_equal(const ex& a, const ex& b) { return proven_equal(a, b, {}); }

bool Prover::have_same_form(const ex& a, const ex& b) {
    NormalForm form;
    return is_proven_zero(form, a - b, seems_zero_);
}

bool Prover::proven_equal(const ex& a, const ex& b, const std::set<std::string>& positive, bool joins_roots) {
    const ex difference = a - b;
    if (difference.is_zero()) return true;
    if (is_equal_in_letters(difference, seems_zero_)) return true;
    // First with functions of heat as letters. Steps of derivations are many: what is written out stays small at first.
    struct Attempt {
        std::optional<Depth> depth;
        bool as_letters;
    };
    std::vector<Attempt> attempts{{std::nullopt, true}, {std::nullopt, false}};
    if (system_.symbols.count(SymbolKind::definition) > 0)
        attempts.insert(attempts.end(), {{Depth::shallow, false}, {Depth::halfway, false}, {Depth::full, false}});
    ex tried = difference;
    for (const auto& [depth, as_letters] : attempts) {
        if (!depth && !as_letters && !NormalForm::has_heat_functions(difference)) continue;  // the first attempt again
        const ex written = depth ? system_.symbols.without_definitions(difference, *depth) : difference;
        if (depth && written.is_equal(tried)) continue;
        // What differs somewhere is not worth the effort.
        if (depth && seems_zero_.differs(difference)) return false;
        tried = written;
        NormalForm form(positive, as_letters, joins_roots);
        if (is_proven_zero(form, written, seems_zero_)) return true;
    }
    return proven_for_unit_quaternions(difference);
}

/// The matrix of an attitude is orthogonal only because its quaternion has the norm one, which makes long forms: after all else.
bool Prover::proven_for_unit_quaternions(const ex& difference) {
    std::vector<std::array<ex, 4>> quaternions;
    for (const Symbols::AttitudeSymbols& attitude : system_.symbols.attitudes()) {
        std::array<ex, 4> parts;
        for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = system_.symbols.get(SymbolKind::state, attitude.parts[i]);
        quaternions.push_back(parts);
    }
    if (quaternions.empty() || seems_zero_.differs(difference)) return false;
    NormalForm form({}, false, false, quaternions);
    return is_proven_zero(form, system_.symbols.without_definitions(difference, Depth::full), seems_zero_);
}

Comparison Prover::equal(const ex& a, const ex& b) {
    // A balance of a node that stores nothing is zero by its temperature, which random points do not know.
    const auto at_points = [&] {
        return compare_at_points([&](const ex& e, const Point& point, int digits) { return value_at(e, system_.symbols, point, digits); },
                                 a, b);
    };
    if (system_.heat.defined.empty() && is_long_and_differs(system_, a - b)) return at_points();
    if (proven_equal(a, b, {})) return {Verdict::proven};
    // Temperatures that nodes without capacities balance are known by that alone: one of their balances may be what a and b differ by.
    for (const auto& [node, heat] : system_.heat.defined)
        if (proven_equal(a - b, heat, {}) || proven_equal(b - a, heat, {})) return {Verdict::proven};
    if (!ranged_.names.empty() && proven_equal(a, b, ranged_.names)) {
        std::set<std::string> needed;
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
            for (const Variable& variable : system_.symbols.all(kind))
                if (ranged_.names.contains(variable.name) && (a.has(variable.symbol) || b.has(variable.symbol)))
                    needed.insert(variable.name);
        return {Verdict::proven_under_assumption, positive_names(needed)};
    }
    if (has_nested_roots(a - b) && proven_equal(a, b, {}, true)) return {Verdict::proven};
    if (const Comparison result = equal_under_waves(a, b); result.verdict == Verdict::proven_under_assumption) return result;
    return at_points();
}

/// With the signs of sines and cosines of what keeps to a half turn, of as few of them as are needed.
Comparison Prover::equal_under_waves(const ex& a, const ex& b) {
    std::set<std::string> assumed;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system_.symbols.all(kind)) {
            if (!a.has(variable.symbol) && !b.has(variable.symbol)) continue;
            for (const char* wave : {"sin(", "cos("})
                if (const std::string name = wave + variable.name + ")"; ranged_.waves.contains(name)) assumed.insert(name);
        }
    if (assumed.empty()) return {Verdict::not_checkable};
    for (const std::string& name : ranged_.names) assumed.insert(name);
    if (!proven_equal(a, b, assumed)) return {Verdict::not_checkable};
    for (const std::string& name : std::set<std::string>(assumed)) {
        assumed.erase(name);
        if (!proven_equal(a, b, assumed)) assumed.insert(name);
    }
    return {Verdict::proven_under_assumption, positive_names(assumed)};
}

Comparison Prover::compare_at_points(const Evaluation& evaluate, const ex& a, const ex& b) const {
    RandomPoints points(system_);
    Branches branches(a - b, system_.symbols);
    int valid = 0, one_sided = 0;
    for (int i = 0; i < most_points && valid < needed_points; ++i) {
        const Point point = points.next();
        const SidesAt at(evaluate, a, b, point);
        one_sided += at.is_one_sided() ? 1 : 0;
        if (at.differ() && stays(evaluate, a - b, point)) return {Verdict::wrong, {}, point};
        if (at.differ()) continue;
        valid += at.is_telling() ? 1 : 0;
        if (at.is_telling()) branches.enter(evaluate, point);
    }
    // What is the same for letters of one size may not be so for others: |x - 10| = 10 - x.
    for (int i = 0; i < wide_points; ++i) {
        const Point point = points.next_wide();
        const SidesAt at(evaluate, a, b, point);
        if (at.differ() && stays(evaluate, a - b, point)) return {Verdict::wrong, {}, point};
        if (at.differ()) continue;
        if (at.has_values()) branches.enter(evaluate, point);
    }
    if (valid < needed_points && one_sided > 0)
        return {Verdict::not_checkable,
                fmt::format(
                    "at {} of {} random points only one side has a real value; give the letters ranges where the equation is meant to hold",
                    one_sided, most_points)};
    if (valid < needed_points)
        return {Verdict::not_checkable, fmt::format("of {} random points, both sides have a nonzero real value at {} only; {} are needed",
                                                    most_points, valid, needed_points)};
    std::string reason =
        one_sided > 0 ? fmt::format("where both sides are real; at {} more random points only one side is", one_sided) : "";
    if (const std::string missed = branches.missed(); !missed.empty()) reason += (reason.empty() ? "" : "; ") + missed;
    return {Verdict::numerically_equal, reason};
}

}  // namespace dalembert

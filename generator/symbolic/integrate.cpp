// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/integrate.hpp"

#include "symbolic/curve_functions.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/integrate_parts.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;
using GiNaC::symbol;

namespace {

using Found = std::optional<ex>;

struct Search {
    Methods methods;
    int depth = 0;  ///< of integrals in integrals

    Search deeper() const { return {methods, depth + 1}; }
};

bool is(const ex& e, const char* function) { return GiNaC::is_a<GiNaC::function>(e) && ex_to<GiNaC::function>(e).get_name() == function; }

/// The slope of an argument that is linear in x; nothing otherwise.
Found slope(const ex& argument, const symbol& x) {
    const ex derivative = partial(argument, x).expand();
    if (derivative.is_zero() || derivative.has(x)) return std::nullopt;
    return derivative;
}

/// 1/cos(u)^2 and the like.
Found integrate_inverse_square(const ex& f, const symbol& x) {
    const ex u = f.op(0);
    const Found a = slope(u, x);
    if (!a) return std::nullopt;
    if (is(f, "cos")) return GiNaC::tan(u) / *a;
    if (is(f, "sin")) return -GiNaC::cos(u) / (GiNaC::sin(u) * *a);
    if (is(f, "cosh")) return GiNaC::tanh(u) / *a;
    if (is(f, "sinh")) return -GiNaC::cosh(u) / (GiNaC::sinh(u) * *a);
    return std::nullopt;
}

Found integrate_power(const ex& base, const ex& exponent, const symbol& x) {
    if (exponent.has(x)) {
        if (base.has(x)) return std::nullopt;
        const Found a = slope(exponent, x);
        return a ? Found(GiNaC::pow(base, exponent) / (*a * GiNaC::log(base))) : std::nullopt;
    }
    if (exponent.is_equal(-2) && GiNaC::is_a<GiNaC::function>(base)) return integrate_inverse_square(base, x);
    const Found a = slope(base, x);
    if (!a) return std::nullopt;
    if (exponent.is_equal(-1)) return GiNaC::log(magnitude(base)) / *a;
    return GiNaC::pow(base, exponent + 1) / ((exponent + 1) * *a);
}

/// The larger or the smaller of two arguments that are linear in x, as half of their sum and of their distance.
Found integrate_extreme(const ex& f, const symbol& x) {
    const ex difference = (f.op(0) - f.op(1)).expand(), sum = (f.op(0) + f.op(1)).expand();
    const Found a = slope(difference, x);
    if (!a || !sum.is_polynomial(x) || sum.degree(x) > 1) return std::nullopt;
    const ex of_sum = sum.coeff(x, 0) * x + sum.coeff(x, 1) * GiNaC::pow(x, 2) / 2;
    const ex of_distance = difference * magnitude(difference) / (2 * *a);
    return (of_sum + (is(f, "maximum") ? of_distance : -of_distance)) / 2;
}

/// A measured characteristic of two variables, one of which is linear in x.
Found integrate_map(const ex& f, const symbol& x) {
    for (const std::size_t axis : {0U, 1U}) {
        if (f.op(1 - axis).has(x)) continue;
        const Found a = slope(f.op(axis), x);
        const auto number = number_of_integral(real_of(f.op(2)), axis);
        if (a && number) return map_value(f.op(0), f.op(1), numeric(*number)) / *a;
    }
    return std::nullopt;
}

/// A function of one argument that is linear in x.
Found integrate_function(const ex& f, const symbol& x) {
    if (is(f, "maximum") || is(f, "minimum")) return integrate_extreme(f, x);
    if (map_call(f)) return integrate_map(f, x);
    const ex u = f.op(0);
    const Found a = slope(u, x);
    if (!a) return std::nullopt;
    if (is(f, "sin")) return -GiNaC::cos(u) / *a;
    if (is(f, "cos")) return GiNaC::sin(u) / *a;
    if (is(f, "exp")) return GiNaC::exp(u) / *a;
    if (is(f, "sinh")) return GiNaC::cosh(u) / *a;
    if (is(f, "cosh")) return GiNaC::sinh(u) / *a;
    if (is(f, "tanh")) return GiNaC::log(GiNaC::cosh(u)) / *a;
    if (is(f, "tan")) return -GiNaC::log(magnitude(GiNaC::cos(u))) / *a;
    if (is(f, "log")) return u * (GiNaC::log(u) - 1) / *a;
    if (is(f, "atan")) return (u * GiNaC::atan(u) - GiNaC::log(1 + GiNaC::pow(u, 2)) / 2) / *a;
    if (is(f, "magnitude")) return u * magnitude(u) / (2 * *a);
    if (is(f, "sign_of")) return magnitude(u) / *a;
    if (const auto curve = curve_call(f); curve && curve->order >= 0) return curve_function(curve->order - 1, u, f.op(1)) / *a;
    return std::nullopt;
}

Found integrate_term(const ex& term, const symbol& x, Search search);

/// Powers and products of exponentials as one exponential each.
struct OneExponential : GiNaC::map_function {
    ex operator()(const ex& e) override {
        if (GiNaC::is_a<GiNaC::power>(e) && is(e.op(0), "exp")) return GiNaC::exp((e.op(0).op(0) * e.op(1)).expand());
        if (!GiNaC::is_a<GiNaC::mul>(e)) return e.map(*this);
        ex exponent = 0;
        ex rest = 1;
        for (const ex& factor : e) {
            const ex one = (*this)(factor);
            if (is(one, "exp")) exponent += one.op(0);
            else rest *= one;
        }
        return exponent.is_zero() ? rest : rest * GiNaC::exp(exponent.expand());
    }
};

/// exp(u)*sin(w) and exp(u)*cos(w).
Found integrate_damped_wave(const ex& f, const symbol& x) {
    if (!GiNaC::is_a<GiNaC::mul>(f) || f.nops() != 2) return std::nullopt;
    const std::size_t first = is(f.op(0), "exp") ? 0 : 1;
    const ex e = f.op(first), wave = f.op(1 - first);
    if (!is(e, "exp") || !(is(wave, "sin") || is(wave, "cos"))) return std::nullopt;
    const Found a = slope(e.op(0), x), b = slope(wave.op(0), x);
    if (!a || !b) return std::nullopt;
    const ex turned = is(wave, "sin") ? ex(-GiNaC::cos(wave.op(0))) : ex(GiNaC::sin(wave.op(0)));
    return e * (*a * wave + *b * turned) / (GiNaC::pow(*a, 2) + GiNaC::pow(*b, 2));
}

/// Integration by parts of p(x)*f(x), p a polynomial: the degree of p falls each time.
Found by_parts(const ex& polynomial, const ex& f, const symbol& x, Search search) {
    if (search.depth > 20) return std::nullopt;
    const bool repeats = is(f, "sin") || is(f, "cos") || is(f, "exp") ||
                         is(f, "sinh") || is(f, "cosh");
    const Found primitive = repeats ? integrate_function(f, x) : integrate_damped_wave(f, x);
    if (!primitive) return std::nullopt;
    const ex derivative = partial(polynomial, x);
    if (derivative.is_zero()) return polynomial * *primitive;
    const Found rest = integrate_term((derivative * *primitive).expand(), x, search.deeper());
    return rest ? Found(polynomial * *primitive - *rest) : std::nullopt;
}

/// sin(u)^a*cos(u)^b, with u of slope k: an odd power leaves a polynomial in the other function, even ones fall by two each time.
ex integrate_powers_of_sine_and_cosine(const ex& u, const ex& k, int a, int b) {
    const ex s = GiNaC::sin(u), c = GiNaC::cos(u);
    if (a == 0 && b == 0) return u / k;
    if (a == 1) return -GiNaC::pow(c, b + 1) / ((b + 1) * k);
    if (b == 1) return GiNaC::pow(s, a + 1) / ((a + 1) * k);
    if (a >= 2)
        return (-GiNaC::pow(s, a - 1) * GiNaC::pow(c, b + 1) / k + (a - 1) * integrate_powers_of_sine_and_cosine(u, k, a - 2, b)) / (a + b);
    return (s * GiNaC::pow(c, b - 1) / k + (b - 1) * integrate_powers_of_sine_and_cosine(u, k, 0, b - 2)) / b;
}

/// The same of a product of such powers, all of one argument that is linear in x.
Found integrate_sines_and_cosines(const ex& product, const symbol& x) {
    constexpr int largest = 40;
    ex u = 0;
    int a = 0, b = 0;
    bool fits = true;
    const auto take = [&](const ex& factor) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(factor);
        const ex base = is_power ? factor.op(0) : factor;
        const ex exponent = is_power ? factor.op(1) : ex(1);
        const bool is_sine = is(base, "sin");
        fits = fits && (is_sine || is(base, "cos")) && exponent.info(GiNaC::info_flags::posint) &&
               exponent.info(GiNaC::info_flags::integer) && ex_to<numeric>(exponent) <= largest;
        if (!fits) return;
        fits = u.is_zero() || u.is_equal(base.op(0));
        u = base.op(0);
        (is_sine ? a : b) += ex_to<numeric>(exponent).to_int();
    };
    if (GiNaC::is_a<GiNaC::mul>(product))
        for (const ex& factor : product) take(factor);
    else
        take(product);
    const Found k = fits && a + b <= largest ? slope(u, x) : std::nullopt;
    return k ? Found(integrate_powers_of_sine_and_cosine(u, *k, a, b)) : std::nullopt;
}

/// x^n*|x| and x^n*sign(x): on either side of zero a power.
Found integrate_with_magnitude(const ex& rest, const ex& f, const symbol& x) {
    if (!f.op(0).is_equal(x)) return std::nullopt;
    const ex exponent = rest.degree(x);
    const ex coefficient = rest.coeff(x, rest.degree(x));
    if (!(rest - coefficient * GiNaC::pow(x, exponent)).expand().is_zero()) return std::nullopt;
    if (is(f, "magnitude")) return coefficient * GiNaC::pow(x, exponent + 1) * magnitude(x) / (exponent + 2);
    if (is(f, "sign_of")) return coefficient * GiNaC::pow(x, exponent) * magnitude(x) / (exponent + 1);
    return std::nullopt;
}

/// With a part of the function as the variable: f(g)*g'.
Found integrate_by_substitution(const ex& f, const symbol& x, Search search) {
    constexpr int deepest = 2;
    if (search.depth >= deepest) return std::nullopt;
    std::vector<ex> parts;
    for (auto part = f.preorder_begin(); part != f.preorder_end(); ++part) {
        const bool is_sum_or_function = GiNaC::is_a<GiNaC::add>(*part) || GiNaC::is_a<GiNaC::function>(*part) ||
                                        GiNaC::is_a<GiNaC::power>(*part) || GiNaC::is_a<GiNaC::mul>(*part);
        if (is_sum_or_function && part->has(x) && !part->is_equal(f)) parts.push_back(*part);
    }
    for (const ex& part : parts) {
        const ex derivative = partial(part, x);
        if (derivative.is_zero()) continue;
        const symbol y;
        const ex inside = (f / derivative).normal().subs(part == y, GiNaC::subs_options::no_pattern);
        if (inside.has(x)) continue;
        if (const Found found = integrate_term(inside.expand(), y, search.deeper()))
            return found->subs(y == part, GiNaC::subs_options::no_pattern);
    }
    return std::nullopt;
}

/// The methods beyond the table, for a product without constant factors.
Found integrate_otherwise(const ex& f, const symbol& x, Search search) {
    if (const Found found = integrate_rational(f, x)) return found;
    if (const Found found = integrate_root_of_quadratic(f, x)) return found;
    if (const Found found = integrate_over_wave(f, x)) return found;
    return integrate_by_substitution(f, x, search);
}

/// A function of the table, or a polynomial times one.
Found integrate_by_table(const ex& f, const symbol& x, Search search) {
    if (f.is_equal(x)) return GiNaC::pow(x, 2) / 2;
    if (const Found found = integrate_sines_and_cosines(f, x)) return found;
    if (GiNaC::is_a<GiNaC::power>(f)) return integrate_power(f.op(0), f.op(1), x);
    if (GiNaC::is_a<GiNaC::function>(f)) return integrate_function(f, x);
    if (!GiNaC::is_a<GiNaC::mul>(f)) return std::nullopt;
    ex polynomial = 1, function = 1;
    for (const ex& factor : f) (factor.is_polynomial(x) ? polynomial : function) *= factor;
    if (is(function, "magnitude") || is(function, "sign_of")) return integrate_with_magnitude(polynomial.expand(), function, x);
    return by_parts(polynomial, function, x, search);
}

Found integrate_term(const ex& term, const symbol& x, Search search) {
    if (!term.has(x)) return term * x;
    if (GiNaC::is_a<GiNaC::add>(term)) {
        ex result = 0;
        for (const ex& part : term) {
            const Found one = integrate_term(part, x, search);
            if (!one) return std::nullopt;
            result += *one;
        }
        return result;
    }
    ex constant = 1;
    ex variable = 1;
    const auto take = [&](const ex& factor) { (factor.has(x) ? variable : constant) *= factor; };
    if (GiNaC::is_a<GiNaC::mul>(term))
        for (const ex& factor : term) take(factor);
    else
        take(term);
    Found found = integrate_by_table(variable, x, search);
    if (!found && search.methods == Methods::all) found = integrate_otherwise(variable, x, search);
    return found ? Found(constant * *found) : std::nullopt;
}

}  // namespace

std::optional<ex> integrate(const ex& function, const symbol& variable, Methods methods) {
    OneExponential one;
    const ex terms = one(function.expand()).expand();
    if (const Found found = integrate_term(terms, variable, {methods})) return found;
    if (methods == Methods::table) return std::nullopt;
    // Of sums whose terms have no primitives one by one, and of what has edges.
    if (const Found found = integrate_otherwise(function, variable, {methods})) return found;
    return integrate_pieces(function, variable);
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/integrate.hpp"

#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;
using GiNaC::symbol;

namespace {

using Found = std::optional<ex>;

bool is(const ex& e, const char* function) { return GiNaC::is_a<GiNaC::function>(e) && ex_to<GiNaC::function>(e).get_name() == function; }

/// The slope of an argument that is linear in x; nothing otherwise.
Found slope(const ex& argument, const symbol& x) {
    const ex derivative = partial(argument, x).expand();
    if (derivative.is_zero() || derivative.has(x)) return std::nullopt;
    return derivative;
}

Found integrate_power(const ex& base, const ex& exponent, const symbol& x) {
    if (exponent.has(x)) {
        if (base.has(x)) return std::nullopt;
        const Found a = slope(exponent, x);
        return a ? Found(GiNaC::pow(base, exponent) / (*a * GiNaC::log(base))) : std::nullopt;
    }
    const Found a = slope(base, x);
    if (!a) return std::nullopt;
    if (exponent.is_equal(-1)) return GiNaC::log(magnitude(base)) / *a;
    return GiNaC::pow(base, exponent + 1) / ((exponent + 1) * *a);
}

/// A function of one argument that is linear in x.
Found integrate_function(const ex& f, const symbol& x) {
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
    return std::nullopt;
}

Found integrate_term(const ex& term, const symbol& x, int depth);

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

/// Integration by parts of p(x)*f(x), p a polynomial: the degree of p falls each time.
Found by_parts(const ex& polynomial, const ex& f, const symbol& x, int depth) {
    if (depth > 20) return std::nullopt;
    const bool repeats = is(f, "sin") || is(f, "cos") || is(f, "exp") ||
                         is(f, "sinh") || is(f, "cosh");
    if (!repeats) return std::nullopt;
    const Found primitive = integrate_function(f, x);
    if (!primitive) return std::nullopt;
    const ex derivative = partial(polynomial, x);
    if (derivative.is_zero()) return polynomial * *primitive;
    const Found rest = integrate_term((derivative * *primitive).expand(), x, depth + 1);
    return rest ? Found(polynomial * *primitive - *rest) : std::nullopt;
}

/// sin(u)^a*cos(u)^b, with u of slope k: an odd power leaves a polynomial in the other function, even ones fall by two each time.
ex integrate_powers_of_sine_and_cosine(const ex& u, const ex& k, int a, int b) {
    const ex s = GiNaC::sin(u), c = GiNaC::cos(u);
    if (a == 0 && b == 0) return u / k;
    if (a == 1) return -GiNaC::pow(c, b + 1) / ((b + 1) * k);
    if (b == 1) return GiNaC::pow(s, a + 1) / ((a + 1) * k);
    if (a >= 2) return (-GiNaC::pow(s, a - 1) * GiNaC::pow(c, b + 1) / k + (a - 1) * integrate_powers_of_sine_and_cosine(u, k, a - 2, b)) / (a + b);
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
        fits = fits && (is_sine || is(base, "cos")) && exponent.info(GiNaC::info_flags::posint) && exponent.info(GiNaC::info_flags::integer) && ex_to<numeric>(exponent) <= largest;
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

Found integrate_term(const ex& term, const symbol& x, int depth) {
    if (!term.has(x)) return term * x;
    if (GiNaC::is_a<GiNaC::add>(term)) {
        ex result = 0;
        for (const ex& part : term) {
            const Found one = integrate_term(part, x, depth);
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

    const auto scaled = [&](const Found& primitive) { return primitive ? Found(constant * *primitive) : std::nullopt; };
    if (variable.is_equal(x)) return constant * GiNaC::pow(x, 2) / 2;
    if (const Found found = integrate_sines_and_cosines(variable, x)) return constant * *found;
    if (GiNaC::is_a<GiNaC::power>(variable)) return scaled(integrate_power(variable.op(0), variable.op(1), x));
    if (GiNaC::is_a<GiNaC::function>(variable)) return scaled(integrate_function(variable, x));
    if (!GiNaC::is_a<GiNaC::mul>(variable)) return std::nullopt;

    // polynomial * function
    ex polynomial = 1;
    Found function;
    for (const ex& factor : variable) {
        if (factor.is_polynomial(x)) polynomial *= factor;
        else if (!function) function = factor;
        else return std::nullopt;
    }
    if (!function) return std::nullopt;
    if (is(*function, "magnitude") || is(*function, "sign_of"))
        return scaled(integrate_with_magnitude(polynomial.expand(), *function, x));
    return scaled(by_parts(polynomial, *function, x, depth));
}

}  // namespace

std::optional<ex> integrate(const ex& function, const symbol& variable) {
    OneExponential one;
    return integrate_term(one(function.expand()).expand(), variable, 0);
}

}  // namespace dalembert

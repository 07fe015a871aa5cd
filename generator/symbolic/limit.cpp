// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/limit.hpp"

#include <set>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

constexpr int most_series_terms = 16;

/// Inserted, where that has a value.
std::optional<ex> inserted(const ex& e, const ex& variable, const ex& place) {
    try {
        return e.subs(variable == place, GiNaC::subs_options::no_pattern);
    } catch (const std::exception&) {  // a pole
        return std::nullopt;
    }
}

/// The constant term of the series about h = 0; nothing where there is a pole, or where no series is known.
std::optional<ex> constant_term(const ex& e, const GiNaC::possymbol& h) {
    for (int terms = 2; terms <= most_series_terms; terms *= 2) {
        try {
            const ex series = e.series(h == 0, terms);
            if (!GiNaC::is_a<GiNaC::pseries>(series)) return std::nullopt;
            const GiNaC::pseries& found = ex_to<GiNaC::pseries>(series);
            const bool is_cut = found.nops() > 0 && GiNaC::is_order_function(found.coeffop(found.nops() - 1));
            if (is_cut && ex_to<GiNaC::numeric>(found.exponop(found.nops() - 1)) <= 0) continue;  // too few terms to see it
            if (found.nops() > 0 && !(is_cut && found.nops() == 1) && found.ldegree(h) < 0) return std::nullopt;
            const ex term = found.coeff(h, 0);
            return term.has(h) ? std::nullopt : std::optional(term);
        } catch (const std::exception&) {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

/// 1, -1, or 0 where the sign is not known.
int sign_of_constant(const ex& e) {
    if (e.info(GiNaC::info_flags::positive)) return 1;
    return (-e).info(GiNaC::info_flags::positive) ? -1 : 0;
}

/// Functions of what grows beyond all bounds as h > 0 goes to zero, by what they go to.
class AtInfinity : public GiNaC::map_function {
public:
    explicit AtInfinity(const GiNaC::possymbol& h) : h_(h) {}

    ex operator()(const ex& e) override {
        const ex inside = e.map(*this);
        if (!GiNaC::is_a<GiNaC::function>(inside) || inside.nops() != 1) return inside;
        const std::string name = ex_to<GiNaC::function>(inside).get_name();
        const ex argument = inside.op(0).expand();
        const auto slope = constant_term(argument * h_, h_);
        const int direction = slope ? sign_of_constant(*slope) : 0;
        if (direction == 0) return inside;
        if (name == "exp" && direction < 0) return 0;  // faster than any power of h
        if (name == "tanh") return direction;
        if (name == "atan") return direction * GiNaC::Pi / 2;
        return inside;
    }

private:
    const GiNaC::possymbol& h_;
};

/// Whether a sign, a magnitude or a root turns at the place: then the limits from both sides may differ. What is positive has one side at
/// zero.
bool turns(const ex& e, const ex& variable, const ex& place) {
    if (variable.info(GiNaC::info_flags::positive) && place.is_zero()) return false;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::numeric) &&
                             !part->op(1).info(GiNaC::info_flags::integer);
        if (!is_root && !is_ex_the_function(*part, magnitude) && !is_ex_the_function(*part, sign_of)) continue;
        const auto inside = inserted(part->op(0), variable, place);
        if (part->op(0).has(variable) && (!inside || inside->expand().is_zero())) return true;
    }
    return false;
}

/// Whether it is continuous although something turns: roots and magnitudes are, signs are not.
bool jumps(const ex& e, const ex& variable, const ex& place) {
    // At zero itself a sign has the value that it has on no side.
    if (variable.info(GiNaC::info_flags::positive)) {
        for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
            if (is_ex_the_function(*part, sign_of) && part->op(0).has(variable)) {
                const auto inside = inserted(part->op(0), variable, place);
                if (!inside || inside->expand().is_zero()) return true;
            }
        return false;
    }
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (is_ex_the_function(*part, sign_of) && part->op(0).has(variable) && turns(*part, variable, place)) return true;
    return false;
}

/// Signs and magnitudes of what goes to zero with h > 0: as the first term of their series has it.
struct SignsOnOneSide : GiNaC::map_function {
    const GiNaC::possymbol& h;
    explicit SignsOnOneSide(const GiNaC::possymbol& letter) : h(letter) {}

    ex operator()(const ex& e) override {
        const ex inside = e.map(*this);
        const bool is_size = is_ex_the_function(inside, magnitude);
        if (!is_size && !is_ex_the_function(inside, sign_of)) return inside;
        const ex u = inside.op(0).expand();
        if (!u.is_polynomial(h) || u.is_zero()) return inside;
        const int sign = sign_of_constant(u.coeff(h, u.ldegree(h)).evalf());
        return sign == 0 ? inside : is_size ? ex(sign * u) : ex(sign);
    }
};

/// Powers of what has h in base and exponent as exponentials.
struct PowersAsExponentials : GiNaC::map_function {
    const GiNaC::possymbol& h;
    explicit PowersAsExponentials(const GiNaC::possymbol& letter) : h(letter) {}

    ex operator()(const ex& e) override {
        const ex inside = e.map(*this);
        return GiNaC::is_a<GiNaC::power>(inside) && inside.op(0).has(h) && inside.op(1).has(h)
                   ? GiNaC::exp(inside.op(1) * GiNaC::log(inside.op(0)))
                   : inside;
    }
};

bool is_continuous(const std::string& name) {
    static const std::set<std::string, std::less<>> names{"sin", "cos", "exp", "sinh", "cosh", "tanh", "atan", "magnitude"};
    return names.contains(name);
}

/// The limit as h > 0 goes to zero: of sums, products and continuous functions that of what they are made of, if each has one.
std::optional<ex> limit_at_zero(const ex& e, const GiNaC::possymbol& h) {
    if (!e.has(h)) return e;
    if (!jumps(e, h, 0)) {
        if (const auto value = inserted(e, h, 0)) return value;
        if (const auto value = constant_term(e, h)) return value;
    }
    if (GiNaC::is_a<GiNaC::function>(e) && e.nops() == 1 && is_continuous(ex_to<GiNaC::function>(e).get_name())) {
        const auto inside = limit_at_zero(e.op(0), h);
        return inside ? std::optional(ex(e.subs(e.op(0) == *inside, GiNaC::subs_options::no_pattern))) : std::nullopt;
    }
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    if (!is_sum && !GiNaC::is_a<GiNaC::mul>(e)) return std::nullopt;
    ex result = is_sum ? 0 : 1;
    for (const ex& part : e) {
        const auto one = limit_at_zero(part, h);
        if (!one) return std::nullopt;
        result = is_sum ? result + *one : result * *one;
    }
    return result;
}

}  // namespace

std::optional<ex> limit_at(const ex& e, const ex& variable, const ex& place, int side) {
    if (side != 0) {
        const GiNaC::possymbol h("h");
        const auto shifted = inserted(e, variable, place + side * h);
        if (!shifted) return std::nullopt;
        SignsOnOneSide signs(h);
        PowersAsExponentials exponentials(h);
        return limit_at_zero(exponentials(signs(*shifted)), h);
    }
    if (jumps(e, variable, place)) return std::nullopt;
    if (const auto value = inserted(e, variable, place)) return value;
    if (turns(e, variable, place)) return std::nullopt;
    const GiNaC::possymbol h("h");
    const auto shifted = inserted(e, variable, place + h);
    return shifted ? constant_term(*shifted, h) : std::nullopt;
}

std::optional<ex> limit_at_infinity(const ex& e, const ex& variable, int sign) {
    const GiNaC::possymbol h("h");
    const auto turned = inserted(e, variable, sign / h);
    if (!turned) return std::nullopt;
    AtInfinity settle(h);
    const ex settled = settle(turned->expand());
    if (const auto found = limit_at(settled, h, 0)) return found;
    PowersAsExponentials exponentials(h);
    return limit_at_zero(exponentials(settled), h);
}

}  // namespace dalembert

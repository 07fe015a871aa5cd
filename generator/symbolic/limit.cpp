// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/limit.hpp"

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

/// Whether a sign, a magnitude or a root turns at the place: then the limits from both sides may differ. What is positive has one side at zero.
bool turns(const ex& e, const ex& variable, const ex& place) {
    if (variable.info(GiNaC::info_flags::positive)) return false;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::numeric) && !part->op(1).info(GiNaC::info_flags::integer);
        if (!is_root && !is_ex_the_function(*part, magnitude) && !is_ex_the_function(*part, sign_of)) continue;
        const auto inside = inserted(part->op(0), variable, place);
        if (part->op(0).has(variable) && (!inside || inside->expand().is_zero())) return true;
    }
    return false;
}

/// Whether it is continuous although something turns: roots and magnitudes are, signs are not.
bool jumps(const ex& e, const ex& variable, const ex& place) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (is_ex_the_function(*part, sign_of) && part->op(0).has(variable) && turns(*part, variable, place)) return true;
    return false;
}

}  // namespace

std::optional<ex> limit_at(const ex& e, const ex& variable, const ex& place) {
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
    return limit_at(settle(turned->expand()), h, 0);
}

}  // namespace dalembert

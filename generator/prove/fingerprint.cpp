// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/fingerprint.hpp"

#include <sstream>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

using Print = std::uint64_t;
constexpr Print prime = Fingerprints::prime;

constexpr long most_turns = 1000000;  ///< of a part of an angle; larger factors belong to the part

__extension__ using Wide = unsigned __int128;
Print times(Print a, Print b) { return static_cast<Print>(static_cast<Wide>(a) * b % prime); }
Print plus(Print a, Print b) { return (a + b) % prime; }
Print minus(Print a) { return a == 0 ? 0 : prime - a; }
Print power(Print base, Print exponent) {
    Print result = 1;
    for (; exponent > 0; exponent >>= 1, base = times(base, base))
        if (exponent & 1) result = times(result, base);
    return result;
}
Print reciprocal(Print a) { return power(a, prime - 2); }

Print mixed(Print a, Print b) {
    Print z = a ^ (b + 0x9E3779B97F4A7C15ULL + (a << 6) + (a >> 2));
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return (z ^ (z >> 31)) % prime;
}

Print of_name(const std::string& name) {
    Print result = 0;
    for (const char c : name) result = mixed(result, static_cast<unsigned char>(c));
    return result;
}

Print of_integer(const GiNaC::numeric& n) {
    return static_cast<Print>(GiNaC::mod(n, GiNaC::numeric(static_cast<unsigned long>(prime))).to_long());
}

Print of_number(const GiNaC::numeric& n) {
    if (n.is_rational()) return times(of_integer(n.numer()), reciprocal(of_integer(n.denom())));
    std::ostringstream text;
    text << n;
    return of_name(text.str());
}

struct CirclePoint {
    Print cosine = 1, sine = 0;
    CirclePoint turned_by(const CirclePoint& other) const {
        return {plus(times(cosine, other.cosine), minus(times(sine, other.sine))),
                plus(times(sine, other.cosine), times(cosine, other.sine))};
    }
};

CirclePoint point_on_circle(Print parameter) {
    const Print square = times(parameter, parameter), scale = reciprocal(plus(1, square));
    return {times(plus(1, minus(square)), scale), times(times(2, parameter), scale)};
}

}  // namespace

Fingerprints::Fingerprints(const Symbols& symbols) {
    for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes()) {
        const auto part = [&](std::size_t i) { return symbols.get(SymbolKind::state, attitude.parts[i]); };
        std::array<Print, 4> parameters{};
        Print squares = 0;
        for (std::size_t i = 1; i < 4; ++i) {
            parameters[i] = mixed(5, (*this)(part(i)));
            squares = plus(squares, times(parameters[i], parameters[i]));
        }
        const Print scale = reciprocal(plus(1, squares));
        set(part(0), times(plus(1, minus(squares)), scale));
        for (std::size_t i = 1; i < 4; ++i) set(part(i), times(times(2, parameters[i]), scale));
    }
}

std::uint64_t Fingerprints::operator()(const ex& e) {
    if (const auto known = known_.find(e); known != known_.end()) return known->second;
    const Print print = made(e);
    known_.emplace(e, print);
    return print;
}

std::uint64_t Fingerprints::made(const ex& e) {
    if (GiNaC::is_a<GiNaC::numeric>(e)) return of_number(ex_to<GiNaC::numeric>(e));
    if (GiNaC::is_a<GiNaC::symbol>(e)) return mixed(1, of_name(ex_to<GiNaC::symbol>(e).get_name()));
    if (GiNaC::is_a<GiNaC::add>(e)) {
        Print sum = 0;
        for (std::size_t i = 0; i < e.nops(); ++i) sum = plus(sum, (*this)(e.op(i)));
        return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        Print product = 1;
        for (std::size_t i = 0; i < e.nops(); ++i) product = times(product, (*this)(e.op(i)));
        return product;
    }
    if (GiNaC::is_a<GiNaC::power>(e)) {
        const Print base = (*this)(e.op(0));
        if (!e.op(1).info(GiNaC::info_flags::integer)) return mixed(mixed(2, base), (*this)(e.op(1)));
        const long exponent = ex_to<GiNaC::numeric>(e.op(1)).to_long();
        return power(exponent < 0 ? reciprocal(base) : base, static_cast<Print>(std::labs(exponent)));
    }
    if (is_ex_the_function(e, whole)) return (*this)(e.op(0));
    if (GiNaC::is_the_function<GiNaC::sin_SERIAL>(e)) return wave(e.op(0), true);
    if (GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) return wave(e.op(0), false);
    Print print = GiNaC::is_a<GiNaC::function>(e) ? of_name(ex_to<GiNaC::function>(e).get_name()) : 3;
    if (e.nops() == 0) {
        std::ostringstream text;
        text << e;
        return mixed(print, of_name(text.str()));
    }
    for (std::size_t i = 0; i < e.nops(); ++i) print = mixed(print, (*this)(e.op(i)));
    return print;
}

std::uint64_t Fingerprints::wave(const ex& angle, bool is_sine) {
    const ex sum = angle.expand();
    CirclePoint result;
    for (std::size_t i = 0; i < (GiNaC::is_a<GiNaC::add>(sum) ? sum.nops() : 1); ++i) {
        const ex term = GiNaC::is_a<GiNaC::add>(sum) ? sum.op(i) : sum;
        if (term.is_zero()) continue;
        GiNaC::numeric factor = 1;
        if (GiNaC::is_a<GiNaC::mul>(term) && GiNaC::is_a<GiNaC::numeric>(term.op(term.nops() - 1)))
            factor = ex_to<GiNaC::numeric>(term.op(term.nops() - 1));
        if (!factor.is_rational() || GiNaC::abs(factor.numer()) > most_turns) factor = 1;
        const Print part = (*this)(term / factor * GiNaC::numeric(1) / factor.denom());
        CirclePoint step = point_on_circle(mixed(4, part));
        if (factor.is_negative()) step.sine = minus(step.sine);
        for (Print times_left = static_cast<Print>(GiNaC::abs(factor.numer()).to_long()); times_left > 0; times_left >>= 1) {
            if (times_left & 1) result = result.turned_by(step);
            step = step.turned_by(step);
        }
    }
    return is_sine ? result.sine : result.cosine;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/integrate.hpp"
#include "symbolic/integrate_parts.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::symbol;

namespace {

constexpr std::size_t most_edges = 6;

/// Magnitudes, minima and maxima of what has x by signs.
struct BySigns : GiNaC::map_function {
    const symbol& x;
    explicit BySigns(const symbol& variable) : x(variable) {}

    ex operator()(const ex& e) override {
        const ex inside = e.map(*this);
        if (!inside.has(x)) return inside;
        const auto size = [](const ex& u) { return u * sign_of(u); };
        if (is_ex_the_function(inside, magnitude)) return size(inside.op(0).expand());
        if (is_ex_the_function(inside, sign_of)) return sign_of(inside.op(0).expand());
        if (is_ex_the_function(inside, unlocated)) return inside.op(0);
        if (is_ex_the_function(inside, if_else))
            return (inside.op(1) + inside.op(2) + (inside.op(1) - inside.op(2)) * sign_of(inside.op(0).expand())) / 2;
        if (is_ex_the_function(inside, minimum)) return (inside.op(0) + inside.op(1) - size((inside.op(0) - inside.op(1)).expand())) / 2;
        if (is_ex_the_function(inside, maximum)) return (inside.op(0) + inside.op(1) + size((inside.op(0) - inside.op(1)).expand())) / 2;
        return inside;
    }
};

/// Where a sign turns.
struct Edge {
    ex place;
    ex sign;        ///< -1 before it and 1 behind it; of a single edge it may be the other way round
    symbol letter;  ///< for the sign
};

/// The edges of a function in which their signs become letters, from left to right. Nothing where an order or a direction is not known.
std::optional<std::vector<Edge>> edges_of(ex& function, const symbol& x) {
    std::vector<ex> arguments;
    for (auto part = function.preorder_begin(); part != function.preorder_end(); ++part)
        if (is_ex_the_function(*part, sign_of) && part->has(x) &&
            std::none_of(arguments.begin(), arguments.end(), [&](const ex& known) { return known.is_equal(part->op(0)); }))
            arguments.push_back(part->op(0));
    if (arguments.empty() || arguments.size() > most_edges) return std::nullopt;
    std::vector<Edge> edges;
    GiNaC::exmap letters;
    for (const ex& u : arguments) {
        const ex slope = partial(u, x).expand();
        const int direction = known_sign(slope);
        if (slope.is_zero() || slope.has(x) || (direction == 0 && arguments.size() > 1)) return std::nullopt;
        const ex place = (-u.subs(x == 0) / slope).normal();
        auto edge = std::find_if(edges.begin(), edges.end(), [&](const Edge& known) { return (known.place - place).normal().is_zero(); });
        if (edge == edges.end())
            edge = edges.insert(edges.end(), Edge{place, direction == 0 ? ex(sign_of(u)) : ex(sign_of(x - place)), symbol()});
        letters[sign_of(u)] = (direction == 0 ? 1 : direction) * edge->letter;
    }
    for (std::size_t i = 0; i < edges.size(); ++i)  // by hand: an order that is not known must not go into a sort
        for (std::size_t k = i + 1; k < edges.size(); ++k) {
            const int order = known_sign(edges[k].place - edges[i].place);
            if (order == 0) return std::nullopt;
            if (order < 0) std::swap(edges[i], edges[k]);
        }
    function = function.subs(letters, GiNaC::subs_options::no_pattern).expand();
    return edges;
}

/// S*S = 1, and of two edges first*second = 1 + second - first, until each term has one letter at most.
std::optional<ex> in_single_signs(ex f, const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
        if (!f.is_polynomial(edge.letter)) return std::nullopt;
        ex odd = 0, even = 0;
        for (int n = 0; n <= f.degree(edge.letter); ++n) (n % 2 == 0 ? even : odd) += f.coeff(edge.letter, n);
        f = (even + odd * edge.letter).expand();
    }
    for (std::size_t k = edges.size(); k-- > 1;)
        for (std::size_t i = 0; i < k; ++i) {
            const ex product = f.coeff(edges[k].letter, 1).coeff(edges[i].letter, 1);
            f = (f + product * (1 + edges[k].letter - edges[i].letter - edges[k].letter * edges[i].letter)).expand();
            for (const std::size_t place : {i, k}) {  // what the other factors make of it
                const symbol& letter = edges[place].letter;
                if (f.degree(letter) > 1)
                    f = (f.coeff(letter, 0) + f.coeff(letter, 2) + (f.coeff(letter, 1) + f.coeff(letter, 3)) * letter).expand();
            }
        }
    return f;
}

}  // namespace

std::optional<ex> integrate_pieces(const ex& function, const symbol& x) {
    BySigns by_signs(x);
    ex f = by_signs(function).expand();
    const auto edges = edges_of(f, x);
    if (!edges) return std::nullopt;
    const auto single = in_single_signs(f, *edges);
    if (!single) return std::nullopt;
    ex rest = *single, result = 0;
    for (const Edge& edge : *edges) {
        const ex part = single->coeff(edge.letter, 1);
        rest -= part * edge.letter;
        for (const Edge& other : *edges)
            if (part.has(other.letter)) return std::nullopt;
        const auto primitive = integrate(part, x, Methods::all);
        if (!primitive) return std::nullopt;
        try {
            result += edge.sign * (*primitive - primitive->subs(x == edge.place));
        } catch (const std::exception&) {  // a pole at the edge
            return std::nullopt;
        }
    }
    rest = rest.expand();
    for (const Edge& edge : *edges)
        if (rest.has(edge.letter)) return std::nullopt;
    const auto primitive = integrate(rest, x, Methods::all);
    return primitive ? std::optional<ex>(*primitive + result) : std::nullopt;
}

std::optional<ex> integrate_over_wave(const ex& function, const symbol& x) {
    if (!GiNaC::is_a<GiNaC::power>(function) || !function.op(1).is_equal(-1)) return std::nullopt;
    const ex below = function.op(0);
    ex wave = 0;
    for (auto part = below.preorder_begin(); part != below.preorder_end() && wave.is_zero(); ++part)
        if ((is_ex_the_function(*part, GiNaC::sin) || is_ex_the_function(*part, GiNaC::cos)) && part->has(x)) wave = *part;
    if (wave.is_zero()) return std::nullopt;
    const symbol w;
    const ex of_wave = below.subs(wave == w, GiNaC::subs_options::no_pattern).expand();
    const ex slope = partial(wave.op(0), x).expand();
    if (of_wave.has(x) || !of_wave.is_polynomial(w) || of_wave.degree(w) != 1 || slope.is_zero() || slope.has(x)) return std::nullopt;
    const int sign = known_sign(of_wave.coeff(w, 0));
    const ex a = sign * of_wave.coeff(w, 0), b = sign * of_wave.coeff(w, 1), u = wave.op(0), square = (a * a - b * b).expand();
    if (sign == 0 || known_sign(square) <= 0) return std::nullopt;
    const ex root = GiNaC::sqrt(square);
    const ex turned = is_ex_the_function(wave, GiNaC::cos) ? ex(-GiNaC::sin(u)) : ex(GiNaC::cos(u));
    return sign * (u + 2 * GiNaC::atan(b * turned / (a + root + b * wave))) / (root * slope);
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/series.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dalembert {

namespace {

class SeriesMaker {
public:
    SeriesMaker(const Atoms& atoms, const FunctionCode& given) : atoms_(atoms), given_(given), program_(result_.function.program), new_(given.program.size()) {}

    SeriesCode run(const std::vector<std::size_t>& places) {
        FunctionCode& f = result_.function;
        f.by_loops = given_.by_loops;
        const auto take = [&](const std::vector<NodeId>& from) {
            std::vector<NodeId> to;
            for (const NodeId id : given_.program.in_order(from)) rewrite(id);
            for (const NodeId id : from) to.push_back(new_[id]);
            return to;
        };
        f.mass = take(given_.mass);
        f.factors = take(given_.factors);
        f.force = take(given_.force);
        f.accelerations = take(given_.accelerations);
        f.results = take(given_.results);
        note_motion();
        const bool is_implicit = f.by_loops || std::any_of(f.mass.begin(), f.mass.end(), [&](NodeId id) { return moves(id); });
        for (const std::size_t place : places)
            if (is_implicit) result_.unknowns.push_back(f.accelerations[place]);
        schedule(is_implicit, places);
        note_motion();
        return std::move(result_);
    }

private:
    bool moves(NodeId id) {
        note_motion();
        return result_.moves[id];
    }

    /// Of nodes that came since the last call.
    void note_motion() {
        for (auto id = static_cast<NodeId>(result_.moves.size()); id < program_.size(); ++id) {
            const Node& node = program_[id];
            bool moving = node.kind == Node::Kind::symbol && atoms_[node.index].is_dynamic;
            // What these depend on by a jump alone does not move between two jumps.
            const std::size_t by_jumps = node.kind == Node::Kind::function && scalar_function(node.op).jumps ? 1 : 0;
            for (std::size_t i = by_jumps; i < node.arguments.size(); ++i) moving = moving || result_.moves[node.arguments[i]];
            result_.moves.push_back(moving);
        }
    }

    void rewrite(NodeId id) {
        const Node& node = given_.program[id];
        std::vector<NodeId> arguments;
        for (const NodeId argument : node.arguments) arguments.push_back(new_[argument]);
        switch (node.kind) {
            case Node::Kind::constant: new_[id] = program_.constant(node.value); break;
            case Node::Kind::symbol: new_[id] = program_.symbol(node.index); break;
            case Node::Kind::cached: new_[id] = program_.cached(node.index); break;
            case Node::Kind::sum: {
                std::vector<std::pair<bool, NodeId>> terms;
                for (std::size_t i = 0; i < arguments.size(); ++i) terms.emplace_back(node.negative[i], arguments[i]);
                new_[id] = program_.sum(std::move(terms));
                break;
            }
            case Node::Kind::product: new_[id] = product(arguments); break;
            case Node::Kind::reciprocal: new_[id] = program_.reciprocal(arguments[0]); break;
            case Node::Kind::function: new_[id] = function(node.op, arguments); break;
        }
    }

    /// Two factors at a time: what does not move, then what does, and then what divides.
    NodeId product(const std::vector<NodeId>& factors) {
        std::vector<NodeId> fixed, above, below;
        for (const NodeId factor : factors) (!moves(factor) ? fixed : program_[factor].kind == Node::Kind::reciprocal ? below : above).push_back(factor);
        above.insert(above.end(), below.begin(), below.end());
        if (above.empty()) return program_.product(fixed);
        NodeId result = above[0];
        for (std::size_t i = 1; i < above.size(); ++i) result = program_.product({result, above[i]});
        return program_.product({program_.product(fixed), result});
    }

    NodeId function(Op op, std::vector<NodeId> arguments) {
        // An exponent that moves: exp(exponent*log(base)).
        if (op == Op::power && moves(arguments[1])) return function(Op::exp, {product({arguments[1], function(Op::log, {arguments[0]})})});
        const NodeId z = program_.function(op, arguments);
        if (moves(z) && !result_.rules.contains(z)) {
            result_.rules[z];  // a function of itself, as tan' = 1 + tan^2, ends here
            if (auto rule = rule_of(op, z, arguments)) result_.rules[z] = std::move(*rule);
            else result_.rules.erase(z);
        }
        return z;
    }

    NodeId number(const Rational& value) { return program_.constant(value); }
    NodeId square(NodeId a) { return program_.product({a, a}); }
    NodeId one_plus(NodeId a) { return program_.sum({{false, number(1)}, {false, a}}); }
    NodeId one_minus(NodeId a) { return program_.sum({{false, number(1)}, {true, a}}); }

    SeriesRule rule(std::vector<SeriesRule::Term> terms) { return {std::move(terms), {}, {}}; }
    SeriesRule divided(std::vector<SeriesRule::Term> terms, NodeId w) { return {std::move(terms), w, program_.reciprocal(w)}; }
    /// Zero where w is.
    SeriesRule divided_or_zero(std::vector<SeriesRule::Term> terms, NodeId w) { return {std::move(terms), w, program_.function(Op::independent_inverse, {w, number(0)})}; }

    std::optional<SeriesRule> rule_of(Op op, NodeId z, const std::vector<NodeId>& of) {
        const NodeId a = of[0];
        const NodeId one = number(1), minus = number(-1), half = number(Rational(1) / 2), minus_half = number(Rational(-1) / 2);
        switch (op) {
            case Op::sin: return rule({{one, function(Op::cos, of), a}});
            case Op::cos: return rule({{minus, function(Op::sin, of), a}});
            case Op::tan: return rule({{one, one_plus(square(z)), a}});
            case Op::asin: return divided({{one, {}, a}}, function(Op::sqrt, {one_minus(square(a))}));
            case Op::acos: return divided({{minus, {}, a}}, function(Op::sqrt, {one_minus(square(a))}));
            case Op::atan: return divided({{one, {}, a}}, one_plus(square(a)));
            case Op::atan2: return divided({{one, of[1], a}, {minus, a, of[1]}}, program_.sum({{false, square(a)}, {false, square(of[1])}}));
            case Op::sinh: return rule({{one, function(Op::cosh, of), a}});
            case Op::cosh: return rule({{one, function(Op::sinh, of), a}});
            case Op::tanh: return rule({{one, one_minus(square(z)), a}});
            case Op::exp: return rule({{one, z, a}});
            case Op::expm1: return rule({{one, {}, function(Op::exp, of)}});
            case Op::log: return divided({{one, {}, a}}, a);
            case Op::log1p: return divided({{one, {}, a}}, one_plus(a));
            case Op::sqrt: return divided({{half, {}, a}}, z);
            case Op::signed_root: return divided({{product({half, program_.function(Op::sign, of)}), {}, a}}, z);
            case Op::forward_root: return divided_or_zero({{half, {}, a}}, z);
            case Op::inverse_root: return divided({{minus_half, z, a}}, a);
            case Op::inverse_norm: return divided_or_zero({{minus_half, z, a}}, a);
            case Op::power: return divided({{of[1], z, a}}, a);
            case Op::abs: return rule({{program_.function(Op::sign, of), {}, a}});
            case Op::min: return smaller(a, of[1], a, of[1]);
            case Op::max: return smaller(a, of[1], of[1], a);
            case Op::if_else: {
                const NodeId is_first = program_.function(Op::if_else, {a, one, number(0)});
                return rule({{is_first, {}, of[1]}, {one_minus(is_first), {}, of[2]}});
            }
            case Op::compression: return rule({{one, product({a, function(Op::exp, {program_.negated(a)})}), a}});
            case Op::decay_mean: return divided({{one, program_.difference(function(Op::exp, {program_.negated(a)}), z), a}}, a);
            case Op::decay_mean_slope: return divided({{minus, program_.sum({{false, function(Op::exp, {program_.negated(a)})}, {false, product({number(2), z})}}), a}}, a);
            case Op::log_ratio: return rule({{one, {}, function(Op::log, {a})}, {minus, {}, function(Op::log, {of[1]})}});
            case Op::log_mean: {
                const NodeId logarithm = function(Op::log_ratio, of);
                return divided({{one, {}, program_.difference(a, of[1])}, {minus, z, logarithm}}, logarithm);
            }
            case Op::root_excess: return divided({{half, {}, of[1]}, {minus, z, a}}, program_.sum({{false, z}, {false, a}}));
            case Op::one_minus_cos: return rule({{one, function(Op::sin, of), a}});
            case Op::sinc: return divided({{one, program_.difference(function(Op::cos, of), z), a}}, a);
            case Op::sinc_slope: return divided({{minus, program_.sum({{false, product({a, function(Op::sinc, of)})}, {false, product({number(2), z})}}), a}}, a);
            case Op::cosc: return divided({{one, program_.difference(function(Op::sinc, of), product({number(2), z})), a}}, a);
            case Op::cosc_slope: return divided({{one, program_.difference(function(Op::sinc_slope, of), product({number(3), z})), a}}, a);
            case Op::growth_mean: return divided({{one, program_.difference(function(Op::exp, of), z), a}}, a);
            case Op::logc: return divided({{one, program_.difference(program_.reciprocal(one_plus(a)), z), a}}, a);
            case Op::logc_slope: return divided({{minus, program_.sum({{false, square(program_.reciprocal(one_plus(a)))}, {false, product({number(2), z})}}), a}}, a);
            case Op::sum_of_three: return rule({{one, {}, a}, {one, {}, of[1]}, {one, {}, of[2]}});
            case Op::radiant_temperature: return radiant_temperature(z, a, of[1]);
            case Op::outflow_factor: return outflow_factor(z, a, of[1]);
            default: return std::nullopt;
        }
    }

    /// Of a and b the one that is smaller, as series of `then` or `otherwise`.
    SeriesRule smaller(NodeId a, NodeId b, NodeId then, NodeId otherwise) {
        const NodeId is_larger = program_.function(Op::step, {program_.difference(a, b)});
        return rule({{one_minus(is_larger), {}, then}, {is_larger, {}, otherwise}});
    }

    /// a*T^4 + T = b.
    SeriesRule radiant_temperature(NodeId T, NodeId a, NodeId b) {
        const NodeId third = product({square(T), T}), fourth = square(square(T));
        return divided({{number(1), {}, b}, {number(-1), fourth, a}}, one_plus(product({number(4), a, third})));
    }

    /// Psi(1-d)/sqrt(d) with phi^2 = -exp(2 L/k) expm1(b L)/(b d), b = (k-1)/k, L = log(1-d), above the critical ratio, from which on L stays.
    std::optional<SeriesRule> outflow_factor(NodeId phi, NodeId d, NodeId k) {
        if (moves(k)) return std::nullopt;
        const NodeId by_k = program_.reciprocal(k), b = one_minus(by_k);
        // (2/(k+1))^(k/(k-1)) is the critical ratio, below which what flows is choked.
        const NodeId critical = program_.function(Op::power, {program_.product({number(2), program_.reciprocal(one_plus(k))}), program_.reciprocal(b)});
        const NodeId is_open = program_.function(Op::step, {program_.difference(one_minus(d), critical)});
        const NodeId largest = program_.function(Op::min, {d, one_minus(critical)});
        const NodeId L = program_.function(Op::log1p, {program_.negated(largest)});
        result_.rules[L] = divided({{product({number(-1), is_open}), {}, d}}, one_minus(d));
        const NodeId e = function(Op::exp, {product({b, L})}), growth = function(Op::expm1, {product({b, L})});
        const NodeId slope = program_.sum({{false, by_k}, {false, product({program_.product({number(Rational(1) / 2), b}), e, program_.reciprocal(growth)})}});
        return rule({{number(1), product({phi, slope}), L}, {number(Rational(-1) / 2), product({phi, program_.reciprocal(d)}), d}});
    }

    /// The order in which coefficients follow from each other. What a function needs of its v and w are lower orders.
    void schedule(bool is_implicit, const std::vector<std::size_t>& places) {
        const FunctionCode& f = result_.function;
        seen_.assign(program_.size(), false);
        if (is_implicit) {
            for (std::size_t i = 0; i < f.mass.size(); ++i) visit(f.mass[i], {true, places[row_of_entry(i)], Op::symbol}, result_.before);
            for (std::size_t i = 0; i < f.force.size(); ++i) visit(f.force[i], {true, places[i], Op::symbol}, result_.before);
            for (const NodeId id : result_.unknowns) seen_[id] = true;
        }
        for (std::size_t i = 0; i < f.accelerations.size(); ++i) visit(f.accelerations[i], {true, i, Op::symbol}, result_.after);
        for (std::size_t i = 0; i < f.results.size(); ++i) visit(f.results[i], {false, i, Op::symbol}, result_.after);
    }

    static std::size_t row_of_entry(std::size_t entry) {
        std::size_t row = 0;
        while (lower_index(row, row) < entry) ++row;
        return row;
    }

    void visit(NodeId root, NoSeries where, std::vector<NodeId>& order) {
        std::vector<NodeId> companions{root};
        while (!companions.empty()) {
            const NodeId id = companions.back();
            companions.pop_back();
            visit_parts(id, where, order, companions);
        }
    }

    void visit_parts(NodeId id, NoSeries where, std::vector<NodeId>& order, std::vector<NodeId>& companions) {
        if (!moves(id) || seen_[id]) return;
        seen_[id] = true;
        const Node node = program_[id];
        if (node.kind == Node::Kind::function) {
            const auto found = result_.rules.find(id);
            if (found == result_.rules.end()) {
                where.op = node.op == Op::element ? program_[node.arguments[0]].op : node.op;
                if (!result_.missing) result_.missing = where;
                return;
            }
            for (const SeriesRule::Term& term : found->second.terms) {
                visit_parts(term.a, where, order, companions);
                if (term.v && moves(term.a)) companions.push_back(*term.v);
            }
            if (found->second.w) companions.push_back(*found->second.w);
        } else if (node.kind == Node::Kind::product && result_.is_quotient(node)) {
            visit_parts(node.arguments[0], where, order, companions);
            visit_parts(program_[node.arguments[1]].arguments[0], where, order, companions);
        } else {
            for (const NodeId argument : node.arguments) visit_parts(argument, where, order, companions);
        }
        order.push_back(id);
    }

    const Atoms& atoms_;
    const FunctionCode& given_;
    SeriesCode result_;
    Program& program_;
    std::vector<NodeId> new_;  ///< of nodes that were given
    std::vector<bool> seen_;
};

}  // namespace

bool SeriesCode::is_quotient(const Node& product) const {
    return moves[product.arguments[0]] && moves[product.arguments[1]] && function.program[product.arguments[1]].kind == Node::Kind::reciprocal;
}

std::optional<Diagnostic> missing_series(const Code& code) {
    const System& system = code.system;
    const auto missing = make_series(code.atoms, *code.series_of, system.unknown_places()).missing;
    if (!missing) return std::nullopt;
    const Variable* of = nullptr;
    const auto& coordinates = system.symbols.all(SymbolKind::coordinate);
    if (missing->in_motion && missing->index < coordinates.size()) of = &coordinates[missing->index];
    if (!missing->in_motion && missing->index < system.symbols.states()) of = &system.symbols.all(SymbolKind::state)[missing->index];
    const std::string what = of == nullptr ? (missing->in_motion ? "a force of constraints" : "the power") : "the " + std::string(missing->in_motion ? "acceleration" : "rate") + " of '" + of->recorded_name() + "'";
    return Diagnostic{Id::no_series, of != nullptr && of->declared != nullptr ? of->declared->span : system.scene.model->name_span,
                      fmt::format("{} contains '{}', of which no Taylor series is known; leave out --taylor, or take another method", what, name_of(missing->op))};
}

SeriesCode make_series(const Atoms& atoms, const FunctionCode& given, const std::vector<std::size_t>& places) {
    return SeriesMaker(atoms, given).run(places);
}

}  // namespace dalembert

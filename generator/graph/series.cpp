// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/series.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"

namespace dalembert {

namespace {

class SeriesMaker : private SeriesAlgebra {
public:
    SeriesMaker(const Atoms& atoms, const FunctionCode& given)
        : atoms_(atoms), given_(given), program_(result_.function.program), new_(given.program.size()) {}

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
    bool moves(NodeId id) override {
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
    NodeId product(const std::vector<NodeId>& factors) override {
        std::vector<NodeId> fixed, above, below;
        for (const NodeId factor : factors)
            (!moves(factor) ? fixed : program_[factor].kind == Node::Kind::reciprocal ? below : above).push_back(factor);
        above.insert(above.end(), below.begin(), below.end());
        if (above.empty()) return program_.product(fixed);
        NodeId result = above[0];
        for (std::size_t i = 1; i < above.size(); ++i) result = program_.product({result, above[i]});
        return program_.product({program_.product(fixed), result});
    }

    NodeId function(Op op, const std::vector<NodeId>& arguments) override {
        // An exponent that moves: exp(exponent*log(base)).
        if (op == Op::power && moves(arguments[1])) return function(Op::exp, {product({arguments[1], function(Op::log, {arguments[0]})})});
        const NodeId z = program_.function(op, arguments);
        if (moves(z) && !result_.rules.contains(z)) {
            result_.rules[z];  // a function of itself, as tan' = 1 + tan^2, ends here
            const RuleOfSeries rule_of = scalar_function(op).series;
            if (auto rule = rule_of == nullptr ? std::nullopt : rule_of(*this, z, arguments)) result_.rules[z] = std::move(*rule);
            else result_.rules.erase(z);
        }
        return z;
    }

    NodeId number(const Rational& value) override { return program_.constant(value); }
    Rational value(NodeId number) override { return program_[number].value; }
    NodeId sum(std::vector<std::pair<bool, NodeId>> terms) override { return program_.sum(std::move(terms)); }
    NodeId fixed_product(const std::vector<NodeId>& factors) override { return program_.product(factors); }
    NodeId reciprocal(NodeId x) override { return program_.reciprocal(x); }
    NodeId fixed_function(Op op, const std::vector<NodeId>& of) override { return program_.function(op, of); }
    void set_rule(NodeId function, SeriesRule rule) override { result_.rules[function] = std::move(rule); }

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
    return moves[product.arguments[0]] && moves[product.arguments[1]] &&
           function.program[product.arguments[1]].kind == Node::Kind::reciprocal;
}

std::optional<Diagnostic> missing_series(const Code& code) {
    const System& system = code.system;
    const auto missing = make_series(code.atoms, *code.series_of, system.unknown_places()).missing;
    if (!missing) return std::nullopt;
    const Variable* of = nullptr;
    const auto& coordinates = system.symbols.all(SymbolKind::coordinate);
    if (missing->in_motion && missing->index < coordinates.size()) of = &coordinates[missing->index];
    if (!missing->in_motion && missing->index < system.symbols.states()) of = &system.symbols.all(SymbolKind::state)[missing->index];
    const std::string what = of == nullptr
                                 ? (missing->in_motion ? "a force of constraints" : "the power")
                                 : "the " + std::string(missing->in_motion ? "acceleration" : "rate") + " of '" + of->recorded_name() + "'";
    return Diagnostic{Id::no_series, of != nullptr && of->declared != nullptr ? of->declared->span : system.scene.model->name_span,
                      fmt::format("{} contains '{}', of which no Taylor series is known; leave out --taylor, or take another method", what,
                                  name_of(missing->op))};
}

SeriesCode make_series(const Atoms& atoms, const FunctionCode& given, const std::vector<std::size_t>& places) {
    return SeriesMaker(atoms, given).run(places);
}

}  // namespace dalembert

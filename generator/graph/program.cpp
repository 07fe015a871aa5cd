// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/program.hpp"

#include <algorithm>
#include <tuple>

namespace dalembert {

std::size_t order_of_network(const Node& node) {
    if (node.op == Op::junction_root) return node.arguments.size() / 2 - 1;
    const auto fits = [&](std::size_t n) { return node.arguments.size() == (node.op == Op::network_inverse ? n * n : 2 * n * n + n); };
    std::size_t n = 1;
    while (!fits(n)) ++n;
    return n;
}

OperationCount& OperationCount::operator+=(const OperationCount& o) {
    additions += o.additions;
    multiplications += o.multiplications;
    divisions += o.divisions;
    trigonometric += o.trigonometric;
    other += o.other;
    return *this;
}

bool Program::KeyLess::operator()(const Key& a, const Key& b) const {
    if (std::get<0>(a) != std::get<0>(b)) return std::get<0>(a) < std::get<0>(b);
    if (const auto order = cln::compare(std::get<1>(a), std::get<1>(b)); order != 0) return order < 0;
    return std::tie(std::get<2>(a), std::get<3>(a), std::get<4>(a), std::get<5>(a)) <
           std::tie(std::get<2>(b), std::get<3>(b), std::get<4>(b), std::get<5>(b));
}

NodeId Program::intern(Node node) {
    Key key{static_cast<int>(node.kind), node.value, node.index, static_cast<int>(node.op), node.arguments, node.negative};
    const auto [known, is_new] = known_.emplace(std::move(key), static_cast<NodeId>(nodes_.size()));
    if (is_new) nodes_.push_back(std::move(node));
    return known->second;
}

NodeId Program::constant(const Rational& value) { return intern({Node::Kind::constant, value}); }
NodeId Program::symbol(Letter letter) { return intern({Node::Kind::symbol, 0, letter}); }
NodeId Program::cached(std::uint32_t index) { return intern({Node::Kind::cached, 0, index}); }

std::optional<NodeId> Program::find(Op op, const Rational& argument) const {
    const auto number = known_.find({static_cast<int>(Node::Kind::constant), argument, 0, static_cast<int>(Op::symbol), {}, {}});
    if (number == known_.end()) return std::nullopt;
    const auto found = known_.find({static_cast<int>(Node::Kind::function), 0, 0, static_cast<int>(op), {number->second}, {}});
    return found == known_.end() ? std::nullopt : std::optional(found->second);
}

bool Program::is_constant(NodeId id, int value) const { return nodes_[id].kind == Node::Kind::constant && nodes_[id].value == value; }

NodeId Program::sum(std::vector<std::pair<bool, NodeId>> terms) {
    std::erase_if(terms, [&](const auto& term) { return is_constant(term.second, 0); });
    if (terms.empty()) return constant(0);
    if (terms.size() == 1 && !terms[0].first) return terms[0].second;
    const auto positive = std::find_if(terms.begin(), terms.end(), [](const auto& term) { return !term.first; });
    if (positive != terms.end()) std::rotate(terms.begin(), positive, positive + 1);
    Node node{Node::Kind::sum};
    for (const auto& [negative, argument] : terms) {
        node.arguments.push_back(argument);
        node.negative.push_back(negative);
    }
    return intern(std::move(node));
}

NodeId Program::product(std::vector<NodeId> factors) {
    for (const NodeId factor : factors)
        if (is_constant(factor, 0)) return constant(0);
    std::erase_if(factors, [&](NodeId factor) { return is_constant(factor, 1); });
    if (factors.empty()) return constant(1);
    if (factors.size() == 1) return factors[0];
    Node node{Node::Kind::product};
    node.arguments = std::move(factors);
    return intern(std::move(node));
}

NodeId Program::reciprocal(NodeId x) {
    if (nodes_[x].kind == Node::Kind::constant) return constant(Rational(1) / nodes_[x].value);
    Node node{Node::Kind::reciprocal};
    node.arguments = {x};
    return intern(std::move(node));
}

NodeId Program::function(Op op, std::vector<NodeId> arguments) {
    Node node{Node::Kind::function};
    node.op = op;
    node.arguments = std::move(arguments);
    return intern(std::move(node));
}

std::vector<NodeId> Program::in_order(const std::vector<NodeId>& roots) const {
    std::vector<NodeId> order;
    std::vector<bool> seen(nodes_.size(), false);
    // Depth first without recursion: a chain of operations may be longer than the stack allows.
    std::vector<std::pair<NodeId, std::size_t>> path;
    for (const NodeId root : roots) {
        if (seen[root]) continue;
        path.emplace_back(root, 0);
        seen[root] = true;
        while (!path.empty()) {
            auto& [id, next] = path.back();
            if (next == nodes_[id].arguments.size()) {
                order.push_back(id);
                path.pop_back();
                continue;
            }
            const NodeId argument = nodes_[id].arguments[next++];
            if (seen[argument]) continue;
            seen[argument] = true;
            path.emplace_back(argument, 0);
        }
    }
    return order;
}

OperationCount Program::count(const std::vector<NodeId>& roots, const std::vector<bool>& done) const {
    OperationCount result;
    for (const NodeId id : in_order(roots)) {
        if (id < done.size() && done[id]) continue;
        const Node& node = nodes_[id];
        const int arguments = static_cast<int>(node.arguments.size());
        switch (node.kind) {
            case Node::Kind::constant:
            case Node::Kind::symbol:
            case Node::Kind::cached: break;
            case Node::Kind::sum: result.additions += std::max(arguments - 1, 1); break;
            case Node::Kind::product: result.multiplications += arguments - 1; break;
            case Node::Kind::reciprocal: result.divisions += 1; break;
            case Node::Kind::function: {
                using Cost = ScalarFunction::Cost;
                const Cost cost = scalar_function(node.op).cost;
                if (cost == Cost::division) result.divisions += 1;
                if (cost == Cost::trigonometric) result.trigonometric += 1;
                if (cost == Cost::other) result.other += 1;
                break;
            }
        }
    }
    return result;
}

OperationCount Program::count_divided(const std::vector<NodeId>& roots) const {
    OperationCount result = count(roots);
    const auto is_reciprocal = [&](NodeId id) { return nodes_[id].kind == Node::Kind::reciprocal; };
    for (const NodeId id : in_order(roots)) {
        const Node& node = nodes_[id];
        const int divided = static_cast<int>(std::count_if(node.arguments.begin(), node.arguments.end(), is_reciprocal));
        result.divisions += divided - (is_reciprocal(id) ? 1 : 0);
        if (node.kind == Node::Kind::product) result.multiplications -= std::min(divided, static_cast<int>(node.arguments.size()) - 1);
    }
    result.divisions += static_cast<int>(std::count_if(roots.begin(), roots.end(), is_reciprocal));
    return result;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Straight-line code as a graph of operations in which nothing is computed twice.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "graph/atoms.hpp"

namespace dalembert {

using NodeId = std::uint32_t;

struct Node {
    enum class Kind {
        constant,    ///< value
        symbol,      ///< letter of a symbol, or of pi
        cached,      ///< index: a value that depends on parameters alone, computed when they are set
        sum,         ///< arguments, of which those with `negative` are subtracted
        product,     ///< arguments
        reciprocal,  ///< 1/argument
        function,    ///< op of the arguments
    };
    Kind kind;
    Rational value = 0;
    std::uint32_t index = 0;  ///< letter, or number of the cached value
    Op op = Op::symbol;
    std::vector<NodeId> arguments = {};
    std::vector<bool> negative = {};
};

/// The number of nodes of a network that is solved at once, from that of its data.
std::size_t order_of_network(const Node& node);

/// How many operations of which kind.
struct OperationCount {
    int additions = 0;  ///< and subtractions
    int multiplications = 0;
    int divisions = 0;
    int trigonometric = 0;  ///< sin, cos and the like; sin and cos of one argument count twice
    int other = 0;          ///< sqrt, exp, pow, ...
    int total() const { return additions + multiplications + divisions + trigonometric + other; }
    OperationCount& operator+=(const OperationCount& o);
};

class Program {
public:
    const Node& operator[](NodeId id) const { return nodes_[id]; }
    std::size_t size() const { return nodes_.size(); }

    NodeId constant(const Rational& value);
    NodeId symbol(Letter letter);
    NodeId cached(std::uint32_t index);
    /// Sum of signed terms; none makes 0. Starts with a positive term where there is one.
    NodeId sum(std::vector<std::pair<bool, NodeId>> terms);
    NodeId product(std::vector<NodeId> factors);
    NodeId negated(NodeId x) { return sum({{true, x}}); }
    NodeId difference(NodeId a, NodeId b) { return sum({{false, a}, {true, b}}); }
    NodeId reciprocal(NodeId x);
    NodeId function(Op op, std::vector<NodeId> arguments);

    bool is_constant(NodeId id, int value) const;
    /// A function of a number that is there.
    std::optional<NodeId> find(Op op, const Rational& argument) const;
    /// Everything that the roots need, arguments before what uses them.
    std::vector<NodeId> in_order(const std::vector<NodeId>& roots) const;
    /// Operations needed for the roots when what is in `done` is there already.
    OperationCount count(const std::vector<NodeId>& roots, const std::vector<bool>& done = {}) const;
    /// The same where a reciprocal is no value of its own, but each use of it a division.
    OperationCount count_divided(const std::vector<NodeId>& roots) const;

private:
    using Key = std::tuple<int, Rational, std::uint32_t, int, std::vector<NodeId>, std::vector<bool>>;
    struct KeyLess {
        bool operator()(const Key& a, const Key& b) const;
    };
    NodeId intern(Node node);

    std::vector<Node> nodes_;
    std::map<Key, NodeId, KeyLess> known_;
};

}  // namespace dalembert

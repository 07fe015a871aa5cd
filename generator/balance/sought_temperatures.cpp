// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/sought_temperatures.hpp"

#include <fmt/format.h>

#include "symbolic/functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

constexpr auto no_pattern = GiNaC::subs_options::no_pattern;

class Elimination {
public:
    explicit Elimination(HeatNetwork& network) : network_(network) {
        for (NodeState& node : network.nodes)
            if (node.kind == NodeState::Kind::sought) rows_.push_back({&node, network.heat_into(node), false});
    }

    void run() {
        if (rows_.empty()) return;
        check_linear();
        while (Row* row = next()) eliminate(*row);
        put_in();
    }

private:
    struct Row {
        NodeState* node;
        ex balance;  ///< W into the node, zero
        bool done;
    };

    static const ex& T(const Row& row) { return row.node->warmth.temperature; }
    static const ex& fourth(const Row& row) { return row.node->warmth.fourth; }

    [[noreturn]] static void fail(const NodeState& node, const std::string& why) {
        throw Failure(Diagnostic{Id::undetermined, node.place, fmt::format("node '{}' stores nothing, so that its temperature follows from its balance; {}", node.name, why)});
    }

    bool has_letters(const ex& e) const {
        for (const Row& row : rows_)
            if (e.has(T(row)) || e.has(fourth(row))) return true;
        return false;
    }

    void check_linear() const {
        for (const Row& row : rows_)
            for (const Row& other : rows_)
                for (const ex& letter : {T(other), fourth(other)})
                    if (has_letters(partial(row.balance, letter)))
                        fail(*row.node, &row == &other ? std::string("but this is neither linear in it nor in its fourth power. Give it a capacity")
                                             : fmt::format("but this is neither linear in the temperature of '{}' nor in its fourth power. Give one of the two a capacity", other.node->name));
    }

    /// First nodes that only conduct or only radiate, then those that do both. Links are symmetric, so a node does to others what
    /// they do to it.
    Row* next() {
        Row* mixed = nullptr;
        for (Row& row : rows_) {
            if (row.done) continue;
            const bool conducts = row.balance.has(T(row));
            const bool radiates = row.balance.has(fourth(row));
            if (!conducts && !radiates) fail(*row.node, "but nothing links it to a temperature that is known");
            if (conducts != radiates) return &row;
            if (mixed == nullptr) mixed = &row;
        }
        return mixed;
    }

    void eliminate(Row& row) {
        const ex g = -partial(row.balance, T(row));
        const ex r = -partial(row.balance, fourth(row));
        const ex rest = row.balance.subs(GiNaC::exmap{{T(row), 0}, {fourth(row), 0}}, no_pattern);
        if (g.is_zero()) {
            settle(row, pow(rest / r, GiNaC::numeric(1, 4)), rest / r);
        } else if (r.is_zero()) {
            settle(row, rest / g, pow(rest / g, 4));
        } else {
            if (has_letters(rest))
                fail(*row.node, "but it radiates and conducts to others of which the same is true. Give all but one of them a capacity");
            const ex temperature = radiant_temperature(r / g, rest / g);
            settle(row, temperature, pow(temperature, 4));
        }
    }

    /// Takes a temperature for known, in the other balances and in what was found before.
    void settle(Row& row, const ex& temperature, const ex& fourth_power) {
        const GiNaC::exmap known{{T(row), temperature}, {fourth(row), fourth_power}};
        for (auto& [letter, value] : network_.solved) value = value.subs(known, no_pattern);
        network_.solved.insert(known.begin(), known.end());
        row.done = true;
        for (Row& other : rows_)
            if (!other.done) other.balance = other.balance.subs(known, no_pattern);
    }

    void put_in() {
        const auto in = [&](ex& e) { e = e.subs(network_.solved, no_pattern); };
        for (NodeState& node : network_.nodes) {
            in(node.warmth.temperature);
            in(node.warmth.fourth);
            node.warmth.is_sought = false;
            in(node.source);
        }
        for (LinkState& link : network_.links) in(link.heat);
    }

    HeatNetwork& network_;
    std::vector<Row> rows_;
};

}  // namespace

void find_sought_temperatures(HeatNetwork& network) { Elimination(network).run(); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Recurrences of Taylor series: statements of the first coefficients, and those of order k, which stand in a loop. The sums over all orders
// between are those of rows, pairs of series that are multiplied; see detail::series_sums.
#pragma once

#include <functional>
#include <memory>

#include "program/statement_maker.hpp"
#include "graph/series.hpp"

namespace dalembert {

class SeriesStatements {
public:
    /// `arguments` are names that are in scope already. `bind` tells arrays and names; `assign` makes the last statements of an order.
    struct Use {
        std::function<void(StatementMaker&)> bind = [](StatementMaker&) {};
        std::function<Statements(SeriesStatements&)> assign;
    };
    SeriesStatements(const Code& code, SeriesCode series, const CachedValues& cached, std::set<std::string> arguments, Use use);

    /// Statements of the first coefficients; `solve` makes those that find accelerations by loops, once M and the right side are there.
    Statements start(const std::function<Statements(StatementMaker&)>& solve);
    /// Statements of order k, up to those that store rows. After start.
    Statements step();

    /// A coefficient: the first one, and that of order k, which is Value() where it is zero.
    Value first(NodeId id);
    Value now(NodeId id);

    const SeriesCode& series() const { return series_; }
    std::size_t rows() const { return rows_.size(); }
    bool uses_number() const { return uses_number_; }  ///< k as a real number
    StatementMaker& code_at_start() { return *maker_; }

private:
    /// Two series that are multiplied; of the left one j times its coefficients where that is wanted.
    struct Row {
        NodeId left;
        bool weighted;
        NodeId right;
        friend bool operator==(const Row&, const Row&) = default;
    };
    struct Sum {
        std::vector<Value> terms = {};
        std::vector<bool> negative = {};
        void add(bool is_negative, Value term);
        bool is_empty() const { return terms.empty(); }
        Value whole() const;
    };

    bool moves(NodeId id) const { return series_.moves[id]; }
    NodeId made(NodeId id);
    Value sums_of(NodeId left, bool weighted, NodeId right);
    void compute(NodeId id, Statements& statements);
    Value sum(const Node& node);
    Value product(NodeId id, const Node& node);
    Value ruled(NodeId id, const SeriesRule& rule);
    Value symbol(const Node& node);
    void solve(Statements& statements);
    Sum right_side(std::size_t i);
    void solve_by_loops(Statements& statements);
    void solve_one_by_one(Statements& statements);
    void store_rows(Statements& statements);
    Value declared(const std::string& wanted, Value value, Statements& statements);
    std::string name_of_order(NodeId id, const std::string& otherwise) const;

    const Code& code_;
    SeriesCode series_;
    const CachedValues& cached_;
    std::set<std::string> arguments_;
    Use use_;
    FunctionCode at_start_;
    std::unique_ptr<StatementMaker> maker_;
    std::vector<NodeId> kept_;              ///< whose first coefficients are used later
    std::map<NodeId, Value> first_;
    std::map<NodeId, Value> now_;
    std::map<NodeId, int> uses_;
    std::vector<Row> rows_;
    bool uses_number_ = false;
};

}  // namespace dalembert

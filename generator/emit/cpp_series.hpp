// SPDX-License-Identifier: GPL-3.0-or-later
// Recurrences of Taylor series as C++: statements of the first coefficients, and those of order k, which stand in a loop. The sums over all
// orders between are those of rows, pairs of series that are multiplied; see detail::series_sums.
#pragma once

#include <functional>
#include <memory>

#include "emit/cpp_function.hpp"
#include "graph/series.hpp"

namespace dalembert {

class CppSeries {
public:
    /// `arguments` are names that are in scope already. `bind` tells arrays and names; `assign` makes the last statements of an order.
    struct Use {
        std::function<void(CppFunction&)> bind = [](CppFunction&) {};
        std::function<std::string(CppSeries&)> assign;
    };
    CppSeries(const Code& code, SeriesCode series, const CachedValues& cached, std::set<std::string> arguments, Use use);

    /// Statements of the first coefficients; `solve` makes those that find accelerations by loops, once M and the right side are there.
    std::string start(const std::function<std::string(CppFunction&)>& solve);
    /// Statements of order k, from that of the rows to that which stores them. After start.
    std::string step();

    /// A coefficient as a factor or term: the first one, and that of order k, which is "" where it is zero.
    std::string first(NodeId id);
    std::string now(NodeId id, int least_precedence = 1);

    const SeriesCode& series() const { return series_; }
    std::size_t rows() const { return rows_.size(); }
    bool uses_number() const { return uses_number_; }  ///< k as a Scalar, or 1/k
    CppFunction& code_at_start() { return *cpp_; }

private:
    /// Two series that are multiplied; of the left one j times its coefficients where that is wanted.
    struct Row {
        NodeId left;
        bool weighted;
        NodeId right;
        friend bool operator==(const Row&, const Row&) = default;
    };
    struct Text {
        std::string text;
        int precedence;  ///< 1 sum, 2 product, 3 what binds tighter
    };
    struct Sum {
        std::string text = {};
        int count = 0;
        void add(bool negative, const std::string& term);
        Text whole() const { return {text, count == 1 && text.front() != '-' ? 2 : 1}; }
    };

    bool moves(NodeId id) const { return series_.moves[id]; }
    NodeId made(NodeId id);
    std::string sums_of(NodeId left, bool weighted, NodeId right);
    void compute(NodeId id, std::string& statements);
    Text sum(const Node& node);
    Text product(NodeId id, const Node& node);
    Text ruled(NodeId id, const SeriesRule& rule);
    Text symbol(const Node& node);
    std::string solve();
    std::string stored_rows();
    void declare(NodeId id, const Text& text, std::string& statements);
    std::string symbol_name(NodeId id) const;
    std::string new_name(const std::string& wanted);

    const Code& code_;
    SeriesCode series_;
    const CachedValues& cached_;
    std::set<std::string> arguments_;
    Use use_;
    FunctionCode at_start_;
    std::unique_ptr<CppFunction> cpp_;
    std::vector<NodeId> kept_;              ///< whose first coefficients are used later
    std::map<NodeId, std::string> first_;
    std::map<NodeId, Text> now_;
    std::map<NodeId, int> uses_;
    std::vector<Row> rows_;
    bool uses_number_ = false;
};

}  // namespace dalembert

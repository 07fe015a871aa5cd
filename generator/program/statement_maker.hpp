// SPDX-License-Identifier: GPL-3.0-or-later
// Straight-line code as statements. What occurs once stands where it is used; what occurs twice gets a name.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "program/constants.hpp"
#include "program/identifiers.hpp"
#include "graph/code.hpp"
#include "program/statement.hpp"

namespace dalembert {

/// How cached values are read: a member, or of a family of cells an element of one.
using CachedValues = std::map<std::uint32_t, Value>;

struct CurvePieces;

class StatementMaker {
public:
    /// `arguments` are names that are in scope already.
    StatementMaker(const Code& code, const FunctionCode& function, const CachedValues& cached, std::set<std::string> arguments);

    /// How symbols of a kind are read: "x", first index in it; members of the parameter struct have none.
    void bind_state(Value array) { state_ = std::move(array); }
    void bind_input(Value array) { input_ = std::move(array); }
    /// Accelerations are read from an array, from this index on.
    void bind_accelerations(Value array, std::size_t first) { accelerations_ = std::move(array); first_acceleration_ = first; }
    /// In update(): definitions that are variables of it, not members.
    void bind_locals(const std::set<std::size_t>& definitions) { local_definitions_ = definitions; }
    /// In a loop over columns of a Jacobian: which of them the number of a round means.
    void bind_columns(const std::vector<std::size_t>& columns) { columns_ = columns; }
    /// In update(): cached values are written, not read.
    void name_node(NodeId id, const std::string& name) { wanted_names_[id] = name; }

    /// What is used again outside of these statements has a name.
    void keep(NodeId id) { uses_[id] += 2; }
    /// A name that nothing else has in this function.
    std::string new_name(const std::string& wanted) { return names_.unique(wanted); }

    /// Statements that compute what the roots need and that is not there yet.
    Statements compute(const std::vector<NodeId>& roots);
    /// The value of a node whose parts were computed. May need further statements, which are appended.
    Value value(NodeId id, Statements& statements);

    /// Functions of the runtime that the code calls.
    const std::set<std::string>& helpers() const { return helpers_; }
    bool uses_state() const { return uses_state_; }
    bool uses_input() const { return uses_input_; }
    bool uses_time() const { return uses_time_; }

private:
    bool wants_name(NodeId id) const;
    Value part(NodeId id, Statements& statements);
    Value build(NodeId id, Statements& statements);
    Value symbol(NodeId id, Statements& statements);
    Value sum(const Node& node, Statements& statements);
    Value product(const Node& node, Statements& statements);
    Value call(const Node& node, Statements& statements);
    const CurvePieces* curve_of_call(const Node& node) const;
    Value map_value_of(const Node& node, std::vector<Value> arguments) const;
    std::string suggested_name(NodeId id);
    int family_start(const Variable& variable) const;
    void declare(NodeId id, Value value, Statements& statements);
    std::optional<NodeId> other_of_angle(NodeId id) const;
    std::optional<NodeId> exponential_of_minus(NodeId x) const;
    void declare_both(NodeId id, NodeId other, Statements& statements);

    const Code& code_;
    const FunctionCode& function_;
    const CachedValues& cached_;
    std::set<std::string> arguments_;
    NameScope names_;
    std::vector<int> uses_;
    std::map<NodeId, std::vector<NodeId>> angles_;  ///< sines and cosines by their angle
    std::map<NodeId, NodeId> exponentials_;         ///< by what they are of
    std::map<NodeId, Value> known_;
    std::map<NodeId, std::string> wanted_names_;
    std::set<std::string> helpers_;
    Value state_ = Value::name("x");
    Value input_ = Value::name("u");
    Value accelerations_;
    std::size_t first_acceleration_ = 0;
    std::set<std::size_t> local_definitions_;
    std::vector<std::size_t> columns_;
    bool uses_state_ = false;
    bool uses_input_ = false;
    bool uses_time_ = false;
    int temporaries_ = 0;
};

/// Adds statements to others.
void append(Statements& statements, Statements more);

}  // namespace dalembert

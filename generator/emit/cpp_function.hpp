// SPDX-License-Identifier: GPL-3.0-or-later
// Straight-line code as C++ statements. What occurs once stands where it is used; what occurs twice gets a name.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "emit/cpp_constant.hpp"
#include "emit/cpp_names.hpp"
#include "graph/code.hpp"

namespace dalembert {

/// How cached values are read: "c_.k3".
using CachedTexts = std::map<std::uint32_t, std::string>;

class CppFunction {
public:
    /// `arguments` are names that are in scope already.
    CppFunction(const Code& code, const FunctionCode& function, const CachedTexts& cached, std::set<std::string> arguments);

    /// How symbols of a kind are read: "x", first index in it; members of the parameter struct have none.
    void bind_state(const std::string& array) { state_ = array; }
    void bind_input(const std::string& array) { input_ = array; }
    /// Accelerations are read from an array, from this index on.
    void bind_accelerations(const std::string& array, std::size_t first) { accelerations_ = array; first_acceleration_ = first; }
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
    std::string compute(const std::vector<NodeId>& roots);
    /// The value of a node whose parts were computed. May need further statements, which are appended.
    std::string value(NodeId id, std::string& statements);

    /// Functions of <cmath> and of the header's own that the code calls.
    const std::set<std::string>& called() const { return called_; }
    bool uses_state() const { return uses_state_; }
    bool uses_input() const { return uses_input_; }
    bool uses_time() const { return uses_time_; }

private:
    struct Text {
        std::string text;
        int precedence;  ///< 1 sum, 2 product, 3 what binds tighter
    };

    bool wants_name(NodeId id) const;
    Text text_of(NodeId id, std::string& statements);
    std::string operand(NodeId id, int least_precedence, std::string& statements);
    Text build(NodeId id, std::string& statements);
    Text symbol(NodeId id, std::string& statements);
    Text sum(const Node& node, std::string& statements);
    Text product(const Node& node, std::string& statements);
    Text call(const Node& node, std::string& statements);
    std::string suggested_name(NodeId id);
    int family_start(const Variable& variable) const;
    void declare(NodeId id, const std::string& text, std::string& statements);
    std::optional<NodeId> other_of_angle(NodeId id) const;
    std::optional<NodeId> exponential_of_minus(NodeId x) const;
    void declare_both(NodeId id, NodeId other, std::string& statements);

    const Code& code_;
    const FunctionCode& function_;
    const CachedTexts& cached_;
    std::set<std::string> arguments_;
    NameScope names_;
    std::vector<int> uses_;
    std::map<NodeId, std::vector<NodeId>> angles_;  ///< sines and cosines by their angle
    std::map<NodeId, NodeId> exponentials_;         ///< by what they are of
    std::map<NodeId, Text> known_;
    std::map<NodeId, std::string> wanted_names_;
    std::set<std::string> called_;
    std::string state_ = "x";
    std::string input_ = "u";
    std::string accelerations_;
    std::size_t first_acceleration_ = 0;
    std::set<std::size_t> local_definitions_;
    std::vector<std::size_t> columns_;
    bool uses_state_ = false;
    bool uses_input_ = false;
    bool uses_time_ = false;
    int temporaries_ = 0;
};

/// Breaks a long statement at its operators.
std::string wrapped(const std::string& statement, std::size_t column);

}  // namespace dalembert

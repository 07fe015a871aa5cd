// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a unit of C as JavaScript: declarations and statements in from_c.cpp, expressions in from_c_expressions.cpp.
#pragma once

#include "js/from_c.hpp"

namespace dalembert {

class CToJavascript {
public:
    CToJavascript(const CUnit& unit, const FromC& options) : unit_(unit), options_(options) {}

    std::string run();

private:
    using Kind = CNode::Kind;

    static std::string spaces(int indent) { return std::string(static_cast<std::size_t>(indent), ' '); }

    /// What makes an object of a structure, and what copies one with all that is inside of it.
    std::string structure_functions(const std::string& name, const CStructure& structure);
    std::string fresh_value(const CType& type, bool is_member);
    std::string function(const CFunction& f);
    std::string block(const CNode& block, int indent);
    std::string body(const CTree& tree, int indent);
    std::string statement(const CNode& s, int indent);
    std::string for_loop(const CNode& s, int indent);
    std::string declaration(const CNode& d, int indent);
    /// {1, 2}: an array, or the members of a structure in their order.
    std::string list(const CNode& list, const CType& type);
    CType type_of_name(const std::string& name) const;
    CType type_of(const CTree& e) const;
    /// A structure as a value of its own.
    std::string copied(const CTree& e);
    /// How tight an expression binds: operators as in C, then what has one operand, then places and calls.
    static int tightness_of(const CTree& e);
    std::string operand(const CTree& e, int least = 12);
    bool is_boxed(const CTree& e) const;
    /// An array of one that stands for a number elsewhere.
    std::string address(const CTree& e);
    std::string binary(const CNode& e);
    std::string call(const CNode& e);
    std::string name_of(const std::string& name);
    std::string cast(const CNode& e);
    std::string assignment(const CNode& e);
    std::string expression(const CTree& e);

    const CUnit& unit_;
    const FromC& options_;
    std::vector<std::map<std::string, CType>> scopes_;
    std::set<std::string> addressed_;
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The C of runtime/ as a tree, as far as these files use the language: no macros with arguments but NAME_R, no goto, no unions.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// Whole numbers and truths are one kind each; a structure is known by its name.
struct CType {
    enum class Base { unknown, real, whole, text, nothing, function, structure };
    Base base = Base::unknown;
    std::string structure = {};
    int pointers = 0;
    std::vector<std::shared_ptr<struct CNode>> sizes = {};  ///< of an array; null: not written

    bool is_array() const { return !sizes.empty(); }
    bool is_structure() const { return base == Base::structure && pointers == 0 && !is_array(); }
    bool is_whole() const { return base == Base::whole && pointers == 0 && !is_array(); }
    bool is_number() const { return (base == Base::whole || base == Base::real) && pointers == 0 && !is_array(); }
    /// Points to numbers, or is an array of them.
    bool is_place() const { return (pointers > 0 || is_array()) && base != Base::function; }
    CType element() const;
};

using CNodes = std::vector<std::shared_ptr<struct CNode>>;

struct CVariable {
    std::string name;
    CType type;
    std::shared_ptr<CNode> value = {};
};

struct CNode {
    enum class Kind {
        number,
        string,
        name,
        call,
        member,
        index,
        unary,
        postfix,
        binary,
        assignment,
        conditional,
        cast,
        size_of,
        comma,
        list,
        block,
        declaration,
        if_,
        for_,
        while_,
        return_,
        break_,
        continue_,
        switch_,
        case_,
        expression,
        empty,
        placeholder,
    };
    Kind kind;
    std::string text = {};  ///< a name, number or operator
    CNodes parts = {};      ///< may hold nulls: of a loop without a condition
    std::vector<CVariable> variables = {};
    CType type = {};        ///< of a cast; of size_of the type that is measured
    bool is_table = false;  ///< a declaration of constants
};
using CTree = std::shared_ptr<CNode>;

struct CStructure {
    std::vector<CVariable> members;
};

struct CFunction {
    std::string name, comment;
    CType result;
    std::vector<CVariable> arguments;
    CTree body;
};

/// What a text declares at its top, in its order.
struct CItem {
    CFunction function;  ///< unless its body is null
    CTree table;
};

struct CUnit {
    std::vector<CItem> items;
    std::map<std::string, CStructure> structures;
    std::map<std::string, CType> results;  ///< of functions
    std::map<std::string, CType> tables;
    std::vector<std::pair<std::string, CTree>> numbers;  ///< of enumerations, and of macros without arguments
};

/// How tight an operator between two operands binds; 0: it is none.
int c_tightness(const std::string& sign);

/// Adds what a text declares. Throws std::logic_error where it is beyond what is known.
void parse_c(std::string_view text, CUnit& unit);

}  // namespace dalembert

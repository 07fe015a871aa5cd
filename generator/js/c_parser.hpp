// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what c_syntax.hpp holds, by descent: declarations in c_parser.cpp, statements and expressions in files of their own.
#pragma once

#include <algorithm>

#include "js/c_syntax.hpp"
#include "js/c_tokens.hpp"

namespace dalembert {

CTree c_node(CNode::Kind kind, std::string text = {}, CNodes parts = {});

class CParser {
public:
    CParser(std::string_view text, CUnit& unit) : tokens_(c_tokens(text)), unit_(unit) {}

    void run();

private:
    using Kind = CNode::Kind;

    const CToken& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
    bool is(const std::string& text, std::size_t ahead = 0) const {
        return peek(ahead).text == text && peek(ahead).kind != CToken::Kind::string;
    }
    bool accept(const std::string& text);
    [[noreturn]] void fail(const std::string& wanted) const;
    void expect(const std::string& text);
    std::string name();
    bool is_type(std::size_t ahead = 0) const;
    /// "const double", "struct x", "enum x".
    CType base_type();
    CVariable declarator(CType type);
    void skip_parentheses();
    void enumeration();
    void structure();
    void members(const std::string& own);
    void top();
    std::vector<CVariable> arguments();
    CTree declaration();
    CTree initialiser();
    CTree block();
    CTree local_enumeration();
    CTree statement();
    CTree condition();
    CTree for_loop();
    CTree expression();
    CTree assignment();
    CTree conditional();
    CTree binary(int least);
    CTree unary();
    CTree postfix();
    CTree primary();

    std::vector<CToken> tokens_;
    std::size_t at_ = 0;
    CUnit& unit_;
};

}  // namespace dalembert

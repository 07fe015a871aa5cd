// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/c_parser.hpp"

namespace dalembert {

int c_tightness(const std::string& sign) {
    static const std::map<std::string, int> all{{"||", 1}, {"&&", 2}, {"|", 3}, {"^", 4},  {"&", 5},  {"==", 6},
                                                {"!=", 6}, {"<", 7},  {">", 7}, {"<=", 7}, {">=", 7}, {"<<", 8},
                                                {">>", 8}, {"+", 9},  {"-", 9}, {"*", 10}, {"/", 10}, {"%", 10}};
    const auto found = all.find(sign);
    return found == all.end() ? 0 : found->second;
}

CTree CParser::expression() {
    CTree result = assignment();
    while (accept(",")) result = c_node(Kind::comma, ",", {result, assignment()});
    return result;
}

CTree CParser::assignment() {
    CTree left = conditional();
    for (const char* sign : {"=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>="})
        if (accept(sign)) return c_node(Kind::assignment, sign, {left, assignment()});
    return left;
}

CTree CParser::conditional() {
    CTree test = binary(1);
    if (!accept("?")) return test;
    CTree yes = expression();
    expect(":");
    return c_node(Kind::conditional, "", {test, yes, conditional()});
}

CTree CParser::binary(int least) {
    CTree left = unary();
    while (peek().kind == CToken::Kind::sign && c_tightness(peek().text) >= least) {
        const std::string sign = tokens_[at_++].text;
        left = c_node(Kind::binary, sign, {left, binary(c_tightness(sign) + 1)});
    }
    return left;
}

CTree CParser::unary() {
    for (const char* sign : {"++", "--", "&", "*", "-", "+", "!", "~"})
        if (accept(sign)) return c_node(Kind::unary, sign, {unary()});
    if (accept("sizeof")) {
        CTree result = c_node(Kind::size_of);
        if (is("(") && is_type(1)) {
            expect("(");
            const CType base = base_type();
            result->type = declarator(base).type;
            expect(")");
        } else
            result->parts.push_back(unary());
        return result;
    }
    if (is("(") && is_type(1)) {
        expect("(");
        const CType base = base_type();
        CTree result = c_node(Kind::cast);
        result->type = declarator(base).type;
        expect(")");
        result->parts.push_back(unary());
        return result;
    }
    return postfix();
}

CTree CParser::postfix() {
    CTree result = primary();
    while (true) {
        if (accept("[")) {
            result = c_node(Kind::index, "", {result, expression()});
            expect("]");
        } else if (accept(".") || accept("->")) {
            result = c_node(Kind::member, name(), {result});
        } else if (is("++") || is("--")) {
            result = c_node(Kind::postfix, tokens_[at_++].text, {result});
        } else if (accept("(")) {
            result = c_node(Kind::call, "", {result});
            while (!accept(")")) {
                result->parts.push_back(assignment());
                (void)accept(",");
            }
        } else
            return result;
    }
}

CTree CParser::primary() {
    if (accept("(")) {
        CTree result = expression();
        expect(")");
        return result;
    }
    const CToken& token = tokens_[at_++];
    switch (token.kind) {
        case CToken::Kind::number:
            return c_node(Kind::number, token.text);
        case CToken::Kind::string:
            return c_node(Kind::string, token.text);
        case CToken::Kind::name:
            return c_node(Kind::name, token.text);
        case CToken::Kind::placeholder:
            return c_node(Kind::number, token.text);
        case CToken::Kind::sign:
        case CToken::Kind::end:
            break;
    }
    --at_;
    fail("a value");
}

}  // namespace dalembert

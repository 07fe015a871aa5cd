// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/c_parser.hpp"

#include <set>
#include <stdexcept>

namespace dalembert {

CType CType::element() const {
    CType result = *this;
    if (result.is_array())
        result.sizes.erase(result.sizes.begin());
    else if (result.pointers > 0)
        --result.pointers;
    return result;
}

CTree c_node(CNode::Kind kind, std::string text, CNodes parts) {
    return std::make_shared<CNode>(CNode{kind, std::move(text), std::move(parts)});
}

void CParser::run() {
    while (peek().kind != CToken::Kind::end) top();
}

bool CParser::accept(const std::string& text) {
    if (!is(text)) return false;
    ++at_;
    return true;
}

[[noreturn]] void CParser::fail(const std::string& wanted) const {
    std::string near;
    for (std::size_t i = at_ < 8 ? 0 : at_ - 8; i < std::min(at_ + 6, tokens_.size()); ++i) near += tokens_[i].text + " ";
    throw std::logic_error("C beyond what is translated: " + wanted + " expected near: " + near);
}

void CParser::expect(const std::string& text) {
    if (!accept(text)) fail(text);
}

std::string CParser::name() {
    if (peek().kind != CToken::Kind::name) fail("a name");
    return tokens_[at_++].text;
}

bool CParser::is_type(std::size_t ahead) const {
    static const std::set<std::string> words{"const", "static", "inline", "void", "char",   "int",  "long",    "unsigned", "signed",
                                             "float", "double", "size_t", "bool", "struct", "enum", "typedef", "NAME_real"};
    return peek(ahead).kind == CToken::Kind::name && (words.contains(peek(ahead).text) || unit_.structures.contains(peek(ahead).text));
}

CType CParser::base_type() {
    CType type;
    while (is_type()) {
        const std::string word = tokens_[at_++].text;
        if (word == "const" || word == "static" || word == "inline") continue;
        if (word == "struct") {
            type.base = CType::Base::structure;
            type.structure = name();
            unit_.structures[type.structure];
        } else if (word == "enum") {
            type.base = CType::Base::whole;
            (void)name();
        } else if (word == "double" || word == "float" || word == "NAME_real")
            type.base = CType::Base::real;
        else if (word == "void")
            type.base = CType::Base::nothing;
        else if (word == "char" && type.base == CType::Base::unknown)
            type.base = CType::Base::text;
        else if (unit_.structures.contains(word))
            type.base = CType::Base::structure, type.structure = word;
        else
            type.base = CType::Base::whole;
    }
    return type;
}

CVariable CParser::declarator(CType type) {
    while (is("*") || is("const")) type.pointers += tokens_[at_++].text == "*";
    if (accept("(")) {  // a pointer to a function
        expect("*");
        (void)accept("const");
        CVariable variable{name(), {}};
        variable.type.base = CType::Base::function;
        expect(")");
        skip_parentheses();
        return variable;
    }
    CVariable variable{peek().kind == CToken::Kind::name ? name() : "", std::move(type)};
    while (accept("[")) {
        variable.type.sizes.push_back(is("]") ? nullptr : expression());
        expect("]");
    }
    return variable;
}

void CParser::skip_parentheses() {
    expect("(");
    for (int depth = 1; depth > 0; ++at_) depth += is("(") ? 1 : is(")") ? -1 : 0;
}

void CParser::enumeration() {
    expect("enum");
    if (!is("{")) (void)name();
    expect("{");
    CTree before;
    while (!accept("}")) {
        const std::string one = name();
        before = accept("=") ? conditional()
                 : before    ? c_node(Kind::binary, "+", {before, c_node(Kind::number, "1")})
                             : c_node(Kind::number, "0");
        unit_.numbers.emplace_back(one, before);
        (void)accept(",");
    }
    expect(";");
}

void CParser::structure() {
    (void)accept("typedef");
    expect("struct");
    const std::string own = name();
    unit_.structures[own];
    if (is("{")) members(own);
    if (peek().kind == CToken::Kind::name) {
        const std::string alias = name();
        if (alias != own) unit_.structures[alias] = unit_.structures[own];
    }
    expect(";");
}

void CParser::members(const std::string& own) {
    std::vector<CVariable> result;
    expect("{");
    while (!accept("}")) {
        const CType base = base_type();
        do result.push_back(declarator(base));
        while (accept(","));
        expect(";");
    }
    unit_.structures[own].members = std::move(result);
}

void CParser::top() {
    if (accept(";")) return;
    if (accept("#define")) {
        const std::string macro = name();
        CTree value = expression();
        unit_.numbers.emplace_back(macro, std::move(value));
        return expect(";");
    }
    if (is("enum") && (is("{", 1) || is("{", 2))) return enumeration();
    if (is("typedef") || (is("struct") && (is("{", 2) || is(";", 2)))) {
        if (is("typedef") && !is("struct", 1)) fail("a structure");
        return structure();
    }
    CFunction function;
    function.comment = peek().comment;
    const std::size_t begin = at_;
    const CType base = base_type();
    CVariable variable = declarator(base);
    if (is("(")) {
        function.name = variable.name;
        function.result = variable.type;
        unit_.results[variable.name] = variable.type;
        function.arguments = arguments();
        if (accept(";")) return;
        function.body = block();
        unit_.items.push_back({std::move(function), nullptr});
        return;
    }
    at_ = begin;
    CTree table = declaration();
    for (const CVariable& one : table->variables) unit_.tables[one.name] = one.type;
    unit_.items.push_back({{}, std::move(table)});
}

std::vector<CVariable> CParser::arguments() {
    std::vector<CVariable> result;
    expect("(");
    if (is("void") && is(")", 1)) ++at_;
    while (!accept(")")) {
        const CType base = base_type();
        result.push_back(declarator(base));
        (void)accept(",");
    }
    return result;
}

void parse_c(std::string_view text, CUnit& unit) { CParser(text, unit).run(); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/c_parser.hpp"

namespace dalembert {

CTree CParser::block() {
    CTree result = c_node(Kind::block);
    expect("{");
    while (!accept("}")) result->parts.push_back(statement());
    return result;
}

CTree CParser::local_enumeration() {
    const std::size_t before = unit_.numbers.size();
    enumeration();
    CTree result = c_node(Kind::declaration);
    for (std::size_t i = before; i < unit_.numbers.size(); ++i)
        result->variables.push_back({unit_.numbers[i].first, {CType::Base::whole}, unit_.numbers[i].second});
    unit_.numbers.resize(before);
    return result;
}

CTree CParser::statement() {
    if (is("{")) return block();
    if (accept(";")) return c_node(Kind::empty);
    if (is("enum") && is("{", 1)) return local_enumeration();
    if (peek().kind == CToken::Kind::placeholder && peek().text != "@NAME@") return c_node(Kind::placeholder, tokens_[at_++].text);
    if (accept("if")) {
        CTree result = c_node(Kind::if_, "", {condition(), statement()});
        if (accept("else")) result->parts.push_back(statement());
        return result;
    }
    if (accept("for")) return for_loop();
    if (accept("while")) {
        CTree head = condition();
        return c_node(Kind::while_, "", {head, statement()});
    }
    if (accept("switch")) {
        CTree head = condition();
        return c_node(Kind::switch_, "", {head, block()});
    }
    if (accept("case")) {
        CTree label = conditional();
        expect(":");
        return c_node(Kind::case_, "", {label});
    }
    if (accept("return")) {
        CTree result = c_node(Kind::return_);
        if (!is(";")) result->parts.push_back(expression());
        expect(";");
        return result;
    }
    for (const auto& [word, kind] : {std::pair{"break", Kind::break_}, std::pair{"continue", Kind::continue_}})
        if (accept(word)) {
            expect(";");
            return c_node(kind);
        }
    if (is_type()) return declaration();
    CTree result = c_node(Kind::expression, "", {expression()});
    expect(";");
    return result;
}

CTree CParser::condition() {
    expect("(");
    CTree result = expression();
    expect(")");
    return result;
}

CTree CParser::for_loop() {
    expect("(");
    CTree begin = is(";") ? nullptr : is_type() ? declaration() : c_node(Kind::expression, "", {expression()});
    if (begin == nullptr || begin->kind == Kind::expression) expect(";");
    CTree goes_on = is(";") ? nullptr : expression();
    expect(";");
    CTree step = is(")") ? nullptr : expression();
    expect(")");
    return c_node(Kind::for_, "", {begin, goes_on, step, statement()});
}

CTree CParser::declaration() {
    CTree result = c_node(Kind::declaration);
    for (std::size_t i = 0; is_type(i); ++i) result->is_table = result->is_table || is("static", i);
    const CType base = base_type();
    do {
        CVariable variable = declarator(base);
        if (accept("=")) variable.value = initialiser();
        result->variables.push_back(std::move(variable));
    } while (accept(","));
    expect(";");
    return result;
}

CTree CParser::initialiser() {
    if (!accept("{")) return assignment();
    CTree list = c_node(Kind::list);
    while (!accept("}")) {
        list->parts.push_back(initialiser());
        (void)accept(",");
    }
    return list;
}

}  // namespace dalembert

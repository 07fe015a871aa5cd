// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <stdexcept>

#include "js/c_syntax.hpp"
#include "js/c_tokens.hpp"

namespace dalembert {

CType CType::element() const {
    CType result = *this;
    if (result.is_array()) result.sizes.erase(result.sizes.begin());
    else if (result.pointers > 0) --result.pointers;
    return result;
}

namespace {

using Kind = CNode::Kind;

CTree node(Kind kind, std::string text = {}, CNodes parts = {}) {
    return std::make_shared<CNode>(CNode{kind, std::move(text), std::move(parts)});
}

}  // namespace

int c_tightness(const std::string& sign) {
    static const std::map<std::string, int> all{{"||", 1}, {"&&", 2}, {"|", 3}, {"^", 4}, {"&", 5}, {"==", 6}, {"!=", 6},
                                                {"<", 7}, {">", 7}, {"<=", 7}, {">=", 7}, {"<<", 8}, {">>", 8}, {"+", 9},
                                                {"-", 9}, {"*", 10}, {"/", 10}, {"%", 10}};
    const auto found = all.find(sign);
    return found == all.end() ? 0 : found->second;
}

namespace {

class CParser {
public:
    CParser(std::string_view text, CUnit& unit) : tokens_(c_tokens(text)), unit_(unit) {}

    void run() {
        while (peek().kind != CToken::Kind::end) top();
    }

private:
    const CToken& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
    bool is(const std::string& text, std::size_t ahead = 0) const { return peek(ahead).text == text && peek(ahead).kind != CToken::Kind::string; }
    bool accept(const std::string& text) {
        if (!is(text)) return false;
        ++at_;
        return true;
    }
    [[noreturn]] void fail(const std::string& wanted) const {
        std::string near;
        for (std::size_t i = at_ < 8 ? 0 : at_ - 8; i < std::min(at_ + 6, tokens_.size()); ++i) near += tokens_[i].text + " ";
        throw std::logic_error("C beyond what is translated: " + wanted + " expected near: " + near);
    }
    void expect(const std::string& text) {
        if (!accept(text)) fail(text);
    }
    std::string name() {
        if (peek().kind != CToken::Kind::name) fail("a name");
        return tokens_[at_++].text;
    }

    bool is_type(std::size_t ahead = 0) const {
        static const std::set<std::string> words{"const", "static", "inline", "void", "char", "int", "long", "unsigned", "signed", "float",
                                                 "double", "size_t", "bool", "struct", "enum", "typedef", "NAME_real"};
        return peek(ahead).kind == CToken::Kind::name && (words.contains(peek(ahead).text) || unit_.structures.contains(peek(ahead).text));
    }

    /// "const double", "struct x", "enum x".
    CType base_type() {
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
            } else if (word == "double" || word == "float" || word == "NAME_real") type.base = CType::Base::real;
            else if (word == "void") type.base = CType::Base::nothing;
            else if (word == "char" && type.base == CType::Base::unknown) type.base = CType::Base::text;
            else if (unit_.structures.contains(word)) type.base = CType::Base::structure, type.structure = word;
            else type.base = CType::Base::whole;
        }
        return type;
    }

    CVariable declarator(CType type) {
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

    void skip_parentheses() {
        expect("(");
        for (int depth = 1; depth > 0; ++at_) depth += is("(") ? 1 : is(")") ? -1 : 0;
    }

    void enumeration() {
        expect("enum");
        if (!is("{")) (void)name();
        expect("{");
        CTree before;
        while (!accept("}")) {
            const std::string one = name();
            before = accept("=") ? conditional()
                     : before    ? node(Kind::binary, "+", {before, node(Kind::number, "1")})
                                 : node(Kind::number, "0");
            unit_.numbers.emplace_back(one, before);
            (void)accept(",");
        }
        expect(";");
    }

    void structure() {
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

    void members(const std::string& own) {
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

    void top() {
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

    std::vector<CVariable> arguments() {
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

    CTree declaration() {
        CTree result = node(Kind::declaration);
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

    CTree initialiser() {
        if (!accept("{")) return assignment();
        CTree list = node(Kind::list);
        while (!accept("}")) {
            list->parts.push_back(initialiser());
            (void)accept(",");
        }
        return list;
    }

    CTree block() {
        CTree result = node(Kind::block);
        expect("{");
        while (!accept("}")) result->parts.push_back(statement());
        return result;
    }

    CTree local_enumeration() {
        const std::size_t before = unit_.numbers.size();
        enumeration();
        CTree result = node(Kind::declaration);
        for (std::size_t i = before; i < unit_.numbers.size(); ++i)
            result->variables.push_back({unit_.numbers[i].first, {CType::Base::whole}, unit_.numbers[i].second});
        unit_.numbers.resize(before);
        return result;
    }

    CTree statement() {
        if (is("{")) return block();
        if (accept(";")) return node(Kind::empty);
        if (is("enum") && is("{", 1)) return local_enumeration();
        if (peek().kind == CToken::Kind::placeholder && peek().text != "@NAME@") return node(Kind::placeholder, tokens_[at_++].text);
        if (accept("if")) {
            CTree result = node(Kind::if_, "", {condition(), statement()});
            if (accept("else")) result->parts.push_back(statement());
            return result;
        }
        if (accept("for")) return for_loop();
        if (accept("while")) {
            CTree head = condition();
            return node(Kind::while_, "", {head, statement()});
        }
        if (accept("switch")) {
            CTree head = condition();
            return node(Kind::switch_, "", {head, block()});
        }
        if (accept("case")) {
            CTree label = conditional();
            expect(":");
            return node(Kind::case_, "", {label});
        }
        if (accept("return")) {
            CTree result = node(Kind::return_);
            if (!is(";")) result->parts.push_back(expression());
            expect(";");
            return result;
        }
        for (const auto& [word, kind] : {std::pair{"break", Kind::break_}, std::pair{"continue", Kind::continue_}})
            if (accept(word)) {
                expect(";");
                return node(kind);
            }
        if (is_type()) return declaration();
        CTree result = node(Kind::expression, "", {expression()});
        expect(";");
        return result;
    }

    CTree condition() {
        expect("(");
        CTree result = expression();
        expect(")");
        return result;
    }

    CTree for_loop() {
        expect("(");
        CTree begin = is(";") ? nullptr : is_type() ? declaration() : node(Kind::expression, "", {expression()});
        if (begin == nullptr || begin->kind == Kind::expression) expect(";");
        CTree goes_on = is(";") ? nullptr : expression();
        expect(";");
        CTree step = is(")") ? nullptr : expression();
        expect(")");
        return node(Kind::for_, "", {begin, goes_on, step, statement()});
    }

    CTree expression() {
        CTree result = assignment();
        while (accept(",")) result = node(Kind::comma, ",", {result, assignment()});
        return result;
    }

    CTree assignment() {
        CTree left = conditional();
        for (const char* sign : {"=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>="})
            if (accept(sign)) return node(Kind::assignment, sign, {left, assignment()});
        return left;
    }

    CTree conditional() {
        CTree test = binary(1);
        if (!accept("?")) return test;
        CTree yes = expression();
        expect(":");
        return node(Kind::conditional, "", {test, yes, conditional()});
    }

    CTree binary(int least) {
        CTree left = unary();
        while (peek().kind == CToken::Kind::sign && c_tightness(peek().text) >= least) {
            const std::string sign = tokens_[at_++].text;
            left = node(Kind::binary, sign, {left, binary(c_tightness(sign) + 1)});
        }
        return left;
    }

    CTree unary() {
        for (const char* sign : {"++", "--", "&", "*", "-", "+", "!", "~"})
            if (accept(sign)) return node(Kind::unary, sign, {unary()});
        if (accept("sizeof")) {
            CTree result = node(Kind::size_of);
            if (is("(") && is_type(1)) {
                expect("(");
                const CType base = base_type();
                result->type = declarator(base).type;
                expect(")");
            } else result->parts.push_back(unary());
            return result;
        }
        if (is("(") && is_type(1)) {
            expect("(");
            const CType base = base_type();
            CTree result = node(Kind::cast);
            result->type = declarator(base).type;
            expect(")");
            result->parts.push_back(unary());
            return result;
        }
        return postfix();
    }

    CTree postfix() {
        CTree result = primary();
        while (true) {
            if (accept("[")) {
                result = node(Kind::index, "", {result, expression()});
                expect("]");
            } else if (accept(".") || accept("->")) {
                result = node(Kind::member, name(), {result});
            } else if (is("++") || is("--")) {
                result = node(Kind::postfix, tokens_[at_++].text, {result});
            } else if (accept("(")) {
                result = node(Kind::call, "", {result});
                while (!accept(")")) {
                    result->parts.push_back(assignment());
                    (void)accept(",");
                }
            } else return result;
        }
    }

    CTree primary() {
        if (accept("(")) {
            CTree result = expression();
            expect(")");
            return result;
        }
        const CToken& token = tokens_[at_++];
        switch (token.kind) {
            case CToken::Kind::number: return node(Kind::number, token.text);
            case CToken::Kind::string: return node(Kind::string, token.text);
            case CToken::Kind::name: return node(Kind::name, token.text);
            case CToken::Kind::placeholder: return node(Kind::number, token.text);
            case CToken::Kind::sign:
            case CToken::Kind::end: break;
        }
        --at_;
        fail("a value");
    }

    std::vector<CToken> tokens_;
    std::size_t at_ = 0;
    CUnit& unit_;
};

}  // namespace

void parse_c(std::string_view text, CUnit& unit) { CParser(text, unit).run(); }

}  // namespace dalembert

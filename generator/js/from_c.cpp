// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/from_c.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace dalembert {

std::string javascript_name(const std::string& name) {
    static const std::set<std::string> words{
        "arguments", "async",   "await",      "debugger", "eval",    "export", "extends", "finally", "from",  "function",  "get",
        "implements", "import", "in",         "Infinity", "instanceof", "interface", "let", "NaN",   "null",  "of",        "package",
        "set",       "super",   "typeof",     "undefined", "var",    "void",   "with",    "yield",   "Math",  "Object",    "Array"};
    return words.contains(name) ? name + "$" : name;
}

namespace {

using Kind = CNode::Kind;

/// The names whose address is taken somewhere below.
void add_addressed(const CTree& tree, std::set<std::string>& names) {
    if (!tree) return;
    const auto add_target = [&](const CTree& target, const auto& self) -> void {
        if (target->kind == Kind::name) names.insert(target->text);
        if (target->kind == Kind::conditional) self(target->parts[1], self), self(target->parts[2], self);
    };
    if (tree->kind == Kind::unary && tree->text == "&") add_target(tree->parts[0], add_target);
    for (const CTree& part : tree->parts) add_addressed(part, names);
    for (const CVariable& variable : tree->variables) add_addressed(variable.value, names);
}

class Translator {
public:
    Translator(const CUnit& unit, const FromC& options) : unit_(unit), options_(options) {}

    std::string run() {
        std::string text;
        scopes_.emplace_back();
        for (const auto& [name, value] : unit_.numbers) {
            scopes_[0][name] = {CType::Base::whole};
            text += fmt::format("const {} = {};\n", options_.name(name), expression(value));
        }
        for (const auto& [name, structure] : unit_.structures)
            if (!structure.members.empty()) text += structure_functions(name, structure);
        for (const CItem& item : unit_.items) {
            if (item.table) text += declaration(*item.table, 0);
            else if (!options_.left_out.contains(item.function.name)) text += function(item.function);
        }
        return text;
    }

private:
    static std::string spaces(int indent) { return std::string(static_cast<std::size_t>(indent), ' '); }

    /// What makes an object of a structure, and what copies one with all that is inside of it.
    std::string structure_functions(const std::string& name, const CStructure& structure) {
        std::string fresh, copied;
        for (const CVariable& m : structure.members) {
            fresh += fmt::format(" {}: {},", m.name, fresh_value(m.type, true));
            const std::string from = "from." + m.name;
            copied += fmt::format(" {}: {},", m.name,
                                  m.type.is_structure() ? fmt::format("copy_{}({})", m.type.structure, from)
                                  : m.type.is_array()   ? from + ".slice()"
                                                        : from);
        }
        return fmt::format("function new_{0}() {{ return {{{1} }}; }}\nfunction copy_{0}(from) {{ return {{{2} }}; }}\n", name, fresh, copied);
    }

    std::string fresh_value(const CType& type, bool is_member) {
        if (type.is_array()) {
            const std::string size = type.sizes[0] ? expression(type.sizes[0]) : "0";
            const CType element = type.element();
            if (element.is_number()) return fmt::format("new Float64Array({})", size);
            return fmt::format("Array.from({{ length: {} }}, () => {})", size, fresh_value(element, is_member));
        }
        if (type.pointers > 0 || type.base == CType::Base::function) return "null";
        if (type.base == CType::Base::structure) return fmt::format("new_{}()", type.structure);
        return "0";
    }

    std::string function(const CFunction& f) {
        addressed_.clear();
        add_addressed(f.body, addressed_);
        scopes_.emplace_back();
        std::string names, boxes;
        for (const CVariable& a : f.arguments) {
            if (a.name == options_.left_out_argument) continue;
            scopes_.back()[a.name] = a.type;
            const std::string own = javascript_name(a.name);
            const bool is_boxed = addressed_.contains(a.name) && a.type.is_number();
            names += (names.empty() ? "" : ", ") + own + (is_boxed ? "_$" : "");
            if (is_boxed) boxes += fmt::format("    const {0} = [{0}_$];\n", own);
        }
        std::string text = options_.has_comments ? f.comment : "";
        text += fmt::format("function {}({}) {{\n{}", options_.name(f.name), names, boxes);
        for (const CTree& one : f.body->parts) text += statement(*one, 4);
        scopes_.pop_back();
        return text + "}\n";
    }

    std::string block(const CNode& block, int indent) {
        scopes_.emplace_back();
        std::string text = "{\n";
        for (const CTree& one : block.parts) text += statement(*one, indent + 4);
        scopes_.pop_back();
        return text + spaces(indent) + "}\n";
    }

    std::string body(const CTree& tree, int indent) {
        return tree->kind == Kind::block ? " " + block(*tree, indent) : "\n" + statement(*tree, indent + 4);
    }

    std::string statement(const CNode& s, int indent) {
        const std::string begin = spaces(indent);
        switch (s.kind) {
            case Kind::block: return begin + block(s, indent);
            case Kind::declaration: return declaration(s, indent);
            case Kind::empty: return {};
            case Kind::placeholder: return s.text;
            case Kind::if_: {
                std::string text = fmt::format("{}if ({}){}", begin, expression(s.parts[0]), body(s.parts[1], indent));
                if (s.parts.size() > 2) text += begin + "else" + body(s.parts[2], indent);
                return text;
            }
            case Kind::for_: return for_loop(s, indent);
            case Kind::while_: return fmt::format("{}while ({}){}", begin, expression(s.parts[0]), body(s.parts[1], indent));
            case Kind::switch_: return fmt::format("{}switch ({}) {}", begin, expression(s.parts[0]), block(*s.parts[1], indent));
            case Kind::case_: return fmt::format("{}case {}:\n", begin, expression(s.parts[0]));
            case Kind::return_: return begin + (s.parts.empty() ? "return;\n" : fmt::format("return {};\n", expression(s.parts[0])));
            case Kind::break_: return begin + "break;\n";
            case Kind::continue_: return begin + "continue;\n";
            case Kind::expression: {
                const bool is_nothing = s.parts[0]->kind == Kind::cast && s.parts[0]->type.base == CType::Base::nothing;
                if (is_nothing && s.parts[0]->parts[0]->kind == Kind::name) return {};  // an argument that is not used
                return begin + expression(s.parts[0]) + ";\n";
            }
            default: throw std::logic_error("a statement of C that is not translated");
        }
    }

    std::string for_loop(const CNode& s, int indent) {
        scopes_.emplace_back();
        std::string head = s.parts[0] ? statement(*s.parts[0], 0) : ";\n";
        head.back() = ' ';
        std::string text = fmt::format("{}for ({}{}; {}){}", spaces(indent), head, s.parts[1] ? expression(s.parts[1]) : "",
                                       s.parts[2] ? expression(s.parts[2]) : "", body(s.parts[3], indent));
        scopes_.pop_back();
        return text;
    }

    std::string declaration(const CNode& d, int indent) {
        std::vector<std::string> all;
        bool is_constant = true;
        for (const CVariable& v : d.variables) {
            scopes_.back()[v.name] = v.type;
            const std::string own = scopes_.size() == 1 ? options_.name(v.name) : javascript_name(v.name);
            const bool is_boxed = scopes_.size() > 1 && addressed_.contains(v.name) && v.type.is_number();
            std::string value;
            if (v.value && v.value->kind == Kind::list) value = list(*v.value, v.type);
            else if (v.value) value = v.type.is_structure() ? copied(v.value) : expression(v.value);
            else if (v.type.is_array() || v.type.is_structure()) value = fresh_value(v.type, false);
            is_constant = is_constant && (is_boxed || v.type.is_array() || v.type.is_structure());
            if (is_boxed) value = fmt::format("[{}]", value.empty() ? "0" : value);
            all.push_back(own + (value.empty() ? "" : " = " + value));
        }
        return fmt::format("{}{} {};\n", spaces(indent), is_constant ? "const" : "let", fmt::join(all, ", "));
    }

    /// {1, 2}: an array, or the members of a structure in their order.
    std::string list(const CNode& list, const CType& type) {
        if (type.is_structure()) {
            const std::vector<CVariable>& members = unit_.structures.at(type.structure).members;
            std::string text;
            for (std::size_t i = 0; i < members.size(); ++i) {
                const std::string value = i >= list.parts.size()                    ? fresh_value(members[i].type, true)
                                          : list.parts[i]->kind == Kind::list       ? this->list(*list.parts[i], members[i].type)
                                                                                    : expression(list.parts[i]);
                text += fmt::format("{}{}: {}", i == 0 ? " " : ", ", members[i].name, value);
            }
            return "{" + text + " }";
        }
        const CType element = type.element();
        const bool is_zero = list.parts.size() == 1 && (list.parts[0]->kind == Kind::list || list.parts[0]->text == "0" ||
                                                        list.parts[0]->kind == Kind::call) && type.sizes[0];
        if (is_zero) return fresh_value(type, false);
        std::vector<std::string> values;
        for (const CTree& one : list.parts) values.push_back(one->kind == Kind::list ? this->list(*one, element) : expression(one));
        return fmt::format("{}{}{}", element.is_number() ? "Float64Array.of(" : "[", fmt::join(values, ", "), element.is_number() ? ")" : "]");
    }

    CType type_of_name(const std::string& name) const {
        for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
            if (const auto found = scope->find(name); found != scope->end()) return found->second;
        if (const auto table = unit_.tables.find(name); table != unit_.tables.end()) return table->second;
        return {};
    }

    CType type_of(const CTree& e) const {
        switch (e->kind) {
            case Kind::number: return {e->text.find_first_of(".e") == std::string::npos || e->text.starts_with("0x") ? CType::Base::whole : CType::Base::real};
            case Kind::name:
                if (e->text == "NAME_DIGITS") return {CType::Base::whole};
                return type_of_name(e->text);
            case Kind::call: {
                if (e->parts[0]->kind != Kind::name) return {};
                if (e->parts[0]->text == "NAME_R") return {CType::Base::real};
                const auto found = unit_.results.find(e->parts[0]->text);
                return found == unit_.results.end() ? CType{CType::Base::real} : found->second;
            }
            case Kind::member: {
                const CType object = type_of(e->parts[0]);
                const auto structure = unit_.structures.find(object.structure);
                if (structure == unit_.structures.end()) return {};
                for (const CVariable& m : structure->second.members)
                    if (m.name == e->text) return m.type;
                return {};
            }
            case Kind::index: return type_of(e->parts[0]).element();
            case Kind::unary:
                if (e->text == "*") return type_of(e->parts[0]).element();
                if (e->text == "&") {
                    CType type = type_of(e->parts[0]);
                    ++type.pointers;
                    return type;
                }
                return e->text == "!" ? CType{CType::Base::whole} : type_of(e->parts[0]);
            case Kind::postfix: return type_of(e->parts[0]);
            case Kind::binary: {
                const CType left = type_of(e->parts[0]), right = type_of(e->parts[1]);
                if (left.is_place() || e->text == "*" || e->text == "/" || e->text == "+" || e->text == "-" || e->text == "%")
                    return left.is_place() ? left : left.is_whole() && right.is_whole() ? left : CType{CType::Base::real};
                return {CType::Base::whole};
            }
            case Kind::assignment: return type_of(e->parts[0]);
            case Kind::conditional: {
                const CType yes = type_of(e->parts[1]);
                return yes.is_whole() && !type_of(e->parts[2]).is_whole() ? type_of(e->parts[2]) : yes;
            }
            case Kind::cast: return e->type;
            case Kind::size_of: return {CType::Base::whole};
            case Kind::comma: return type_of(e->parts[1]);
            default: return {};
        }
    }

    /// A structure as a value of its own.
    std::string copied(const CTree& e) {
        if (e->kind == Kind::call) return expression(e);
        return fmt::format("copy_{}({})", type_of(e).structure, expression(e));
    }

    /// How tight an expression binds: operators as in C, then what has one operand, then places and calls.
    static int tightness_of(const CTree& e) {
        switch (e->kind) {
            case Kind::comma:
            case Kind::assignment:
            case Kind::conditional: return 0;
            case Kind::binary: return c_tightness(e->text);
            case Kind::unary: return 11;
            case Kind::cast: return tightness_of(e->parts[0]);
            case Kind::call:
                return e->parts[0]->kind == Kind::name && e->parts[0]->text == "NAME_R" ? tightness_of(e->parts[1]) : 12;
            default: return 12;
        }
    }

    std::string operand(const CTree& e, int least = 12) {
        const std::string text = expression(e);
        return tightness_of(e) < least ? "(" + text + ")" : text;
    }

    bool is_boxed(const CTree& e) const {
        return e->kind == Kind::name && addressed_.contains(e->text) && type_of_name(e->text).is_number();
    }

    /// An array of one that stands for a number elsewhere.
    std::string address(const CTree& e) {
        const CType type = type_of(e);
        if (is_boxed(e)) return javascript_name(e->text);
        if (type.is_structure() || type.is_array()) return operand(e);
        if (e->kind == Kind::unary && e->text == "*") return operand(e->parts[0]);
        if (e->kind == Kind::index) return fmt::format("{}.subarray({})", operand(e->parts[0]), expression(e->parts[1]));
        const std::string place = expression(e);
        return fmt::format("{{ get 0() {{ return {0}; }}, set 0(value_) {{ {0} = value_; }} }}", place);
    }

    std::string binary(const CNode& e) {
        const CType left = type_of(e.parts[0]), right = type_of(e.parts[1]);
        if (left.is_place() && (e.text == "+" || e.text == "-") && !right.is_place()) {
            if (e.text == "-") throw std::logic_error("an array that begins before itself");
            return fmt::format("{}.subarray({})", operand(e.parts[0]), expression(e.parts[1]));
        }
        const int own = c_tightness(e.text);
        std::string text = fmt::format("{} {} {}", operand(e.parts[0], own), e.text, operand(e.parts[1], own + 1));
        return e.text == "/" && left.is_whole() && right.is_whole() ? "Math.trunc(" + text + ")" : text;
    }

    std::string call(const CNode& e) {
        const CTree& function = e.parts[0];
        std::vector<std::string> arguments;
        for (std::size_t i = 1; i < e.parts.size(); ++i)
            if (e.parts[i]->kind != Kind::name || e.parts[i]->text != options_.left_out_argument) arguments.push_back(expression(e.parts[i]));
        if (function->kind == Kind::name && function->text == "NAME_R") return arguments.at(0);
        const std::string called = function->kind != Kind::name                                     ? operand(function)
                                   : type_of_name(function->text).base == CType::Base::function ? javascript_name(function->text)
                                                                                                : options_.name(function->text);
        return fmt::format("{}({})", called, fmt::join(arguments, ", "));
    }

    std::string name_of(const std::string& name) {
        if (name == "NULL") return "null";
        if (name == "INFINITY" || name == "HUGE_VAL") return "Infinity";
        if (name == "true" || name == "false") return name;
        for (auto scope = scopes_.rbegin(); scope + 1 != scopes_.rend(); ++scope)
            if (scope->contains(name)) return javascript_name(name) + (addressed_.contains(name) && scope->at(name).is_number() ? "[0]" : "");
        return options_.name(name);
    }

    std::string cast(const CNode& e) {
        if (e.type.is_whole() && e.parts[0]->kind == Kind::unary && e.parts[0]->text == "-") return "Number.MAX_SAFE_INTEGER";  // (size_t)-1
        const bool cuts = e.type.is_whole() && type_of(e.parts[0]).base == CType::Base::real;
        return cuts ? fmt::format("Math.trunc({})", expression(e.parts[0])) : expression(e.parts[0]);
    }

    std::string assignment(const CNode& e) {
        const CType type = type_of(e.parts[0]);
        if (type.is_structure()) return fmt::format("Object.assign({}, {})", expression(e.parts[0]), copied(e.parts[1]));
        if (e.text == "/=" && type.is_whole()) return fmt::format("{0} = Math.trunc({0} / {1})", expression(e.parts[0]), operand(e.parts[1]));
        return fmt::format("{} {} {}", expression(e.parts[0]), e.text, expression(e.parts[1]));
    }

    std::string expression(const CTree& e) {
        switch (e->kind) {
            case Kind::number:
            case Kind::string: return e->text;
            case Kind::name: return name_of(e->text);
            case Kind::call: return call(*e);
            case Kind::member: return fmt::format("{}.{}", operand(e->parts[0]), e->text);
            case Kind::index: return fmt::format("{}[{}]", operand(e->parts[0]), expression(e->parts[1]));
            case Kind::unary:
                if (e->text == "&") return address(e->parts[0]);
                if (e->text == "*")
                    return type_of(e).is_structure() ? operand(e->parts[0]) : fmt::format("{}[0]", operand(e->parts[0]));
                return e->text + operand(e->parts[0]);
            case Kind::postfix: return operand(e->parts[0]) + e->text;
            case Kind::binary: return binary(*e);
            case Kind::assignment: return assignment(*e);
            case Kind::conditional:
                return fmt::format("{} ? {} : {}", operand(e->parts[0], 1), operand(e->parts[1], 1), operand(e->parts[2], e->parts[2]->kind == Kind::conditional ? 0 : 1));
            case Kind::cast: return cast(*e);
            case Kind::size_of: return e->parts.empty() ? "1" : fmt::format("{}.length", operand(e->parts[0]));
            case Kind::comma: return fmt::format("{}, {}", expression(e->parts[0]), expression(e->parts[1]));
            default: throw std::logic_error("an expression of C that is not translated");
        }
    }

    const CUnit& unit_;
    const FromC& options_;
    std::vector<std::map<std::string, CType>> scopes_;
    std::set<std::string> addressed_;
};

}  // namespace

std::string javascript_from(const CUnit& unit, const FromC& options) { return Translator(unit, options).run(); }

}  // namespace dalembert

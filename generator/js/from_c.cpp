// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "js/c_to_javascript.hpp"

namespace dalembert {

std::string javascript_name(const std::string& name) {
    static const std::set<std::string> words{
        "arguments",  "async",  "await",  "debugger",  "eval",       "export",    "extends", "finally", "from", "function", "get",
        "implements", "import", "in",     "Infinity",  "instanceof", "interface", "let",     "NaN",     "null", "of",       "package",
        "set",        "super",  "typeof", "undefined", "var",        "void",      "with",    "yield",   "Math", "Object",   "Array"};
    return words.contains(name) ? name + "$" : name;
}

namespace {

/// The names whose address is taken somewhere below.
void add_addressed(const CTree& tree, std::set<std::string>& names) {
    if (!tree) return;
    const auto add_target = [&](const CTree& target, const auto& self) -> void {
        if (target->kind == CNode::Kind::name) names.insert(target->text);
        if (target->kind == CNode::Kind::conditional) self(target->parts[1], self), self(target->parts[2], self);
    };
    if (tree->kind == CNode::Kind::unary && tree->text == "&") add_target(tree->parts[0], add_target);
    for (const CTree& part : tree->parts) add_addressed(part, names);
    for (const CVariable& variable : tree->variables) add_addressed(variable.value, names);
}

}  // namespace

std::string CToJavascript::run() {
    std::string text;
    scopes_.emplace_back();
    for (const auto& [name, value] : unit_.numbers) {
        scopes_[0][name] = {CType::Base::whole};
        text += fmt::format("const {} = {};\n", options_.name(name), expression(value));
    }
    for (const auto& [name, structure] : unit_.structures)
        if (!structure.members.empty()) text += structure_functions(name, structure);
    for (const CItem& item : unit_.items) {
        if (item.table)
            text += declaration(*item.table, 0);
        else if (!options_.left_out.contains(item.function.name))
            text += function(item.function);
    }
    return text;
}

std::string CToJavascript::structure_functions(const std::string& name, const CStructure& structure) {
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

std::string CToJavascript::fresh_value(const CType& type, bool is_member) {
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

std::string CToJavascript::function(const CFunction& f) {
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

std::string CToJavascript::block(const CNode& block, int indent) {
    scopes_.emplace_back();
    std::string text = "{\n";
    for (const CTree& one : block.parts) text += statement(*one, indent + 4);
    scopes_.pop_back();
    return text + spaces(indent) + "}\n";
}

std::string CToJavascript::body(const CTree& tree, int indent) {
    return tree->kind == Kind::block ? " " + block(*tree, indent) : "\n" + statement(*tree, indent + 4);
}

std::string CToJavascript::statement(const CNode& s, int indent) {
    const std::string begin = spaces(indent);
    switch (s.kind) {
        case Kind::block:
            return begin + block(s, indent);
        case Kind::declaration:
            return declaration(s, indent);
        case Kind::empty:
            return {};
        case Kind::placeholder:
            return s.text;
        case Kind::if_: {
            std::string text = fmt::format("{}if ({}){}", begin, expression(s.parts[0]), body(s.parts[1], indent));
            if (s.parts.size() > 2) text += begin + "else" + body(s.parts[2], indent);
            return text;
        }
        case Kind::for_:
            return for_loop(s, indent);
        case Kind::while_:
            return fmt::format("{}while ({}){}", begin, expression(s.parts[0]), body(s.parts[1], indent));
        case Kind::switch_:
            return fmt::format("{}switch ({}) {}", begin, expression(s.parts[0]), block(*s.parts[1], indent));
        case Kind::case_:
            return fmt::format("{}case {}:\n", begin, expression(s.parts[0]));
        case Kind::return_:
            return begin + (s.parts.empty() ? "return;\n" : fmt::format("return {};\n", expression(s.parts[0])));
        case Kind::break_:
            return begin + "break;\n";
        case Kind::continue_:
            return begin + "continue;\n";
        case Kind::expression: {
            const bool is_nothing = s.parts[0]->kind == Kind::cast && s.parts[0]->type.base == CType::Base::nothing;
            if (is_nothing && s.parts[0]->parts[0]->kind == Kind::name) return {};  // an argument that is not used
            return begin + expression(s.parts[0]) + ";\n";
        }
        default:
            throw std::logic_error("a statement of C that is not translated");
    }
}

std::string CToJavascript::for_loop(const CNode& s, int indent) {
    scopes_.emplace_back();
    std::string head = s.parts[0] ? statement(*s.parts[0], 0) : ";\n";
    head.back() = ' ';
    std::string text = fmt::format("{}for ({}{}; {}){}", spaces(indent), head, s.parts[1] ? expression(s.parts[1]) : "",
                                   s.parts[2] ? expression(s.parts[2]) : "", body(s.parts[3], indent));
    scopes_.pop_back();
    return text;
}

std::string CToJavascript::declaration(const CNode& d, int indent) {
    std::vector<std::string> all;
    bool is_constant = true;
    for (const CVariable& v : d.variables) {
        scopes_.back()[v.name] = v.type;
        const std::string own = scopes_.size() == 1 ? options_.name(v.name) : javascript_name(v.name);
        const bool is_boxed = scopes_.size() > 1 && addressed_.contains(v.name) && v.type.is_number();
        std::string value;
        if (v.value && v.value->kind == Kind::list)
            value = list(*v.value, v.type);
        else if (v.value)
            value = v.type.is_structure() ? copied(v.value) : expression(v.value);
        else if (v.type.is_array() || v.type.is_structure())
            value = fresh_value(v.type, false);
        is_constant = is_constant && (is_boxed || v.type.is_array() || v.type.is_structure());
        if (is_boxed) value = fmt::format("[{}]", value.empty() ? "0" : value);
        all.push_back(own + (value.empty() ? "" : " = " + value));
    }
    return fmt::format("{}{} {};\n", spaces(indent), is_constant ? "const" : "let", fmt::join(all, ", "));
}

std::string CToJavascript::list(const CNode& list, const CType& type) {
    if (type.is_structure()) {
        const std::vector<CVariable>& members = unit_.structures.at(type.structure).members;
        std::string text;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const std::string value = i >= list.parts.size()              ? fresh_value(members[i].type, true)
                                      : list.parts[i]->kind == Kind::list ? this->list(*list.parts[i], members[i].type)
                                                                          : expression(list.parts[i]);
            text += fmt::format("{}{}: {}", i == 0 ? " " : ", ", members[i].name, value);
        }
        return "{" + text + " }";
    }
    const CType element = type.element();
    const bool is_zero = list.parts.size() == 1 &&
                         (list.parts[0]->kind == Kind::list || list.parts[0]->text == "0" || list.parts[0]->kind == Kind::call) &&
                         type.sizes[0];
    if (is_zero) return fresh_value(type, false);
    std::vector<std::string> values;
    for (const CTree& one : list.parts) values.push_back(one->kind == Kind::list ? this->list(*one, element) : expression(one));
    return fmt::format("{}{}{}", element.is_number() ? "Float64Array.of(" : "[", fmt::join(values, ", "), element.is_number() ? ")" : "]");
}

std::string javascript_from(const CUnit& unit, const FromC& options) { return CToJavascript(unit, options).run(); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "elements/key_list.hpp"

namespace dalembert {

namespace {

using T = ValueType;

const std::array model_keys{
    KeySpec{"format", T::whole_number, true, "version of the model language: 1"},
    KeySpec{"name", T::text, true, "name of files and namespaces"},
    KeySpec{"title", T::text, false, "one line for reports and plots"},
    KeySpec{"doc", T::text, false, "a sentence for the gallery: what the model shows"},
    KeySpec{"source", T::text, false, "the text the model comes from, with equation numbers"},
};
const std::vector<SectionSpec>& table() {
    static const std::vector<SectionSpec> rows{
        SectionSpec{"model", false, "What the file is about.",
                    "[model]\nformat = 1\nname   = \"cart_pendulum\"\ntitle  = \"Cart with a pendulum rod\"", model_keys, ""},
#define DALEMBERT_SECTION(name, member, Type) section_of<Type>(name),
        DALEMBERT_KINDS(DALEMBERT_SECTION)
#undef DALEMBERT_SECTION
    };
    return rows;
}

std::string key_line(const KeySpec& key, const std::string& indent) {
    const std::string value = key.type == ValueType::part && !key.refers.empty() ? key.refers : describe(key.type);
    std::string text = fmt::format("{}{:<{}} {:<23} {} {}\n", indent, key.name, 19 - indent.size(), value,
                                   key.required ? "required." : "optional.", key.doc);
    for (const std::string& line : key.lines) text += fmt::format("{}    {}\n", indent, line);
    return text;
}

/// A key with those of the table that stands for its value.
std::string key_reference(const KeySpec& key) {
    std::string text = key_line(key, "  ");
    if (key.parts == nullptr) return text;
    for (const KeySpec& part : key.parts()) text += key_line(part, "      ");
    return text;
}

}  // namespace

std::string section_reference(const SectionSpec& section) {
    std::string example;
    for (const char* c = section.example; *c != '\0'; ++c) example += *c == '\n' ? std::string("\n    ") : std::string(1, *c);
    std::string text = fmt::format("[{}{}]  {}\n\n    {}\n\n", section.name, section.is_collection ? ".NAME" : "", section.doc, example);
    for (std::size_t i = 0; i < section.keys.size(); ++i) {
        const bool is_like_last = i > 0 && section.keys[i].parts == section.keys[i - 1].parts;  // "likewise at the last end"
        text += is_like_last ? key_line(section.keys[i], "  ") : key_reference(section.keys[i]);
    }
    for (const std::string& rule : section.rules) text += fmt::format("  {}\n", rule);
    if (*section.short_form != '\0')
        text += fmt::format("  A bare value stands for `{}`.\n", section.short_form);
    return text;
}

std::span<const SectionSpec> sections() { return table(); }

const SectionSpec* find_section(std::string_view name) {
    const auto found = std::find_if(table().begin(), table().end(), [&](const SectionSpec& s) { return name == s.name; });
    return found == table().end() ? nullptr : &*found;
}

const KeySpec* find_key(const SectionSpec& section, std::string_view name) {
    const auto found = std::find_if(section.keys.begin(), section.keys.end(), [&](const KeySpec& k) { return name == k.name; });
    return found == section.keys.end() ? nullptr : &*found;
}

const char* describe(ValueType type) {
    switch (type) {
        case T::text: return "text";
        case T::whole_number: return "whole number";
        case T::number: return "number";
        case T::constant: return "number or expression";
        case T::constants: return "number(s) or expression";
        case T::unit: return "unit";
        case T::range: return "[low, high]";
        case T::expression: return "expression";
        case T::vector: return "[x, y] or [x, y, z]";
        case T::law: return "law \"e -> ...\"";
        case T::property: return "expression or \"(p, T) -> ...\"";
        case T::dependent: return "expression or \"T -> ...\"";
        case T::field: return "expression or \"(x, y) -> ...\"";
        case T::equation: return "equation";
        case T::equations: return "list of equations";
        case T::family: return "\"k = 1..N\"";
        case T::condition: return "condition";
        case T::effects: return "list of names";
        case T::modes: return "mode or list of modes";
        case T::part: return "name";
        case T::parts: return "list of names";
        case T::expressions: return "list of expressions";
        case T::matrix: return "list of rows";
        case T::points: return "list of [x, y]";
        case T::turns: return "list of [\"x\", \"y\" or \"z\", angle]";
        case T::tensor: return "expression, [Jx, Jy, Jz] or three rows";
        case T::torque: return "expression or [x, y, z]";
        case T::pieces: return "list of [length, cells]";
        case T::table: return "expression or list of lists";
        case T::coordinate: return "coordinate";
        case T::expressions_by_name: return "{ NAME = expression }";
        case T::choice: return "one of";
        case T::plots: return "list of plots";
        case T::tables: return "list of { KEY = ... }";
        case T::named_tables: return "{ NAME = { KEY = ... } }";
        case T::one_or_two: return "expression or list of two";
        case T::boolean: break;
    }
    return "true or false";
}

std::string language_reference(std::string_view word) {
    std::string text;
    if (word.empty()) {
        for (const SectionSpec& section : table()) text += section_reference(section) + "\n";
        return text;
    }
    if (const SectionSpec* section = find_section(word)) return section_reference(*section);
    const std::size_t point = word.find('.');
    const std::string_view key_name = point == std::string_view::npos ? word : word.substr(point + 1);
    for (const SectionSpec& section : table()) {
        if (point != std::string_view::npos && word.substr(0, point) != section.name) continue;
        const std::string place = fmt::format("[{}{}]", section.name, section.is_collection ? ".NAME" : "");
        if (const KeySpec* key = find_key(section, key_name)) text += place + "\n" + key_reference(*key);
        for (const KeySpec& key : section.keys)
            for (const KeySpec& part : key.parts == nullptr ? std::span<const KeySpec>() : key.parts())
                if (part.name == key_name) text += fmt::format("{} in {}\n{}", place, key.name, key_line(part, "  "));
    }
    return text;
}

std::vector<std::string> language_words() {
    std::vector<std::string> words;
    for (const SectionSpec& section : table()) {
        words.emplace_back(section.name);
        for (const KeySpec& key : section.keys) {
            words.emplace_back(key.name);
            for (const KeySpec& part : key.parts == nullptr ? std::span<const KeySpec>() : key.parts()) words.emplace_back(part.name);
        }
    }
    return words;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/settings.hpp"

#include <fmt/format.h>

#include "model/checks.hpp"
#include "model/parser.hpp"
#include "model/units.hpp"

namespace dalembert {

namespace {

/// The next comma outside of brackets, or the end.
std::size_t end_of_part(const std::string& text, std::size_t from) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (text[i] == '(' || text[i] == '[') ++depth;
        if (text[i] == ')' || text[i] == ']') --depth;
        if (text[i] == ',' && depth <= 0) return i;
    }
    return text.size();
}

/// "5bar" and "20 mm" are a number and a unit; everything else is an expression.
std::optional<std::size_t> unit_begin(const Excerpt& excerpt) {
    const std::vector<Token> tokens = tokenise(excerpt);
    std::size_t i = 0;
    while (tokens[i].kind == Token::Kind::sign && (tokens[i].text == "-" || tokens[i].text == "+")) ++i;
    if (tokens[i].kind != Token::Kind::number || tokens[i + 1].kind != Token::Kind::word) return std::nullopt;
    return tokens[i + 1].span.begin;
}

Setting parse_setting(const SourcePtr& source, std::size_t begin, std::size_t end, const std::string& option) {
    const std::size_t equals = source->text().find('=', begin);
    if (equals == std::string::npos || equals >= end)
        throw Failure(Diagnostic{Id::bad_option, Span{source, begin, end},
                                 fmt::format("'--{} {}' is not of the form NAME=VALUE", option, source->text().substr(begin, end - begin))});
    Setting setting{parse_expression(excerpt_of(source, begin, equals)), nullptr, std::nullopt};
    const Excerpt right = excerpt_of(source, equals + 1, end);
    if (const auto at = unit_begin(right)) {
        setting.unit = parse_unit(excerpt_of(source, *at, end));
        setting.value = to_si(parse_expression(excerpt_of(source, equals + 1, *at)), *setting.unit);
    } else {
        setting.value = parse_expression(right);
    }
    return setting;
}

/// The dimension of what is set.
std::optional<Dimension> dimension_of(const Expression& variable, const Names& names) {
    const bool is_rate = variable.kind == Expression::Kind::call;
    const Expression& named = is_rate && !variable.children.empty() ? *variable.children[0] : variable;
    const Named* known = names.find(named.name);
    if (known == nullptr || (known->kind != Named::Kind::parameter && known->kind != Named::Kind::coordinate && known->kind != Named::Kind::state &&
                             known->kind != Named::Kind::input))
        return std::nullopt;
    const Dimension own = known->quantity().unit.dimension;
    return is_rate ? own / Dimension::time() : own;
}

}  // namespace

std::vector<Setting> parse_settings(const std::vector<std::string>& texts, const std::string& option) {
    std::vector<Setting> settings;
    for (const std::string& text : texts) {
        const auto source = std::make_shared<const Source>("--" + option, text);
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = end_of_part(text, begin);
            settings.push_back(parse_setting(source, begin, end, option));
            begin = end + 1;
        }
    }
    return settings;
}

FixWish parse_fixed(const std::string& text, const Names& names) {
    FixWish wish{text, text == "parameters", {}};
    if (wish.all || text.empty()) return wish;
    const auto source = std::make_shared<const Source>("--fix", text);
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = end_of_part(text, begin);
        if (const std::size_t equals = text.find('=', begin); equals == std::string::npos || equals >= end) {
            wish.some.push_back({parse_expression(excerpt_of(source, begin, end)), nullptr});
        } else {
            const Setting setting = parse_setting(source, begin, end, "fix");
            check_setting(setting, nothing, names);
            wish.some.push_back({setting.variable, setting.value});
        }
        begin = end + 1;
    }
    return wish;
}

void check_setting(const Setting& setting, unsigned may_depend, const Names& names) {
    const auto dimension = dimension_of(*setting.variable, names);
    if (setting.unit && dimension && setting.unit->dimension != *dimension)
        throw Failure(Diagnostic{Id::unit_mismatch, setting.value->span,
                                 fmt::format("'{}' is in '{}', but '{}' is in '{}'", setting.variable->written(), dimension->described(),
                                             setting.unit->written, setting.unit->dimension.described())});
    check_dependence(*setting.value, may_depend, fmt::format("the value of '{}'", setting.variable->written()), names);
}

void check_dependence(const Expression& value, unsigned may_depend, const std::string& what, const Names& names) {
    for_each(value, [&](const Expression& part) {
        const bool is_leaf = part.kind == Expression::Kind::name || (part.kind == Expression::Kind::call && (part.name == "dot" || part.name == "ddot"));
        if (is_leaf && (dependence(part, names) & ~may_depend) != 0)
            throw Failure(Diagnostic{Id::not_allowed_here, part.span, fmt::format("{} must not depend on '{}'", what, part.written())});
    });
}

void apply_settings(Values& values, const std::vector<Setting>& settings, unsigned allowed, const System& system) {
    for (const Setting& setting : settings) {
        check_setting(setting, allowed == on_parameters ? nothing : on_parameters, system.names);
        values.set(*setting.variable, *setting.value, allowed);
    }
}

}  // namespace dalembert

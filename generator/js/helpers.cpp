// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/helpers.hpp"

#include <fmt/format.h>

#include "js/from_c.hpp"
#include "text/marked_sections.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// What Math of JavaScript has by itself, and the type of numbers.
const std::set<std::string>& of_the_language() {
    static const std::set<std::string> names = [] {
        std::set<std::string> result;
        for (const MarkedSection& section : marked_sections(embedded_file("math_functions.h.in"))) result.insert(section.name);
        return result;
    }();
    return names;
}

std::string name_of_c(const std::string& name) {
    if (name == "NAME_IS_FLOAT") return "false";
    if (name == "NAME_EPSILON") return "Number.EPSILON";
    if (name == "NAME_DIGITS") return "15";
    if (name == "NAME_fabs") return "Math.abs";
    if (!name.starts_with("NAME_")) return name;
    const std::string own = name.substr(std::string("NAME_").size());
    return of_the_language().contains(own) ? "Math." + own : "$" + own;
}

const FromC& in_a_module() {
    static const FromC options{.name = name_of_c, .left_out_argument = "plant_", .has_comments = true};
    return options;
}

}  // namespace

std::string js_name(const CHelper& helper) { return "$" + helper.function + (helper.size == 0 ? "" : fmt::format("_{}", helper.size)); }

std::string js_helper_source(const std::set<CHelper>& helpers) {
    CUnit unit;
    for (const CHelperSection& section : c_helper_sections(helpers))
        if (!of_the_language().contains(section.name)) parse_c(section.text, unit);
    return javascript_from(unit, in_a_module());
}

std::string js_from_functions(const std::string& text) {
    CUnit unit;
    parse_c("typedef struct NAME { int none; } NAME; typedef struct NAME_constraint { bool has_position; } NAME_constraint;", unit);
    parse_c(text, unit);
    for (auto& [name, structure] : unit.structures) structure.members.clear();
    return javascript_from(unit, in_a_module());
}

}  // namespace dalembert

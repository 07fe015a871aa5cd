// SPDX-License-Identifier: GPL-3.0-or-later
// Words of formulas: functions, derived quantities, units.
#include <fmt/format.h>

#include "language/unit_reference.hpp"
#include "language/vocabulary.hpp"
#include "reference/pages.hpp"

namespace dalembert {

namespace {

Section form_section(std::string name, std::string doc, FormPlace place) {
    Section section{std::move(name), std::move(doc), {}, "Form"};
    for (const FormSpec& form : forms())
        if (form.place == place) section.rows.push_back({form.name, form.written, {}, form.doc});
    return section;
}

Section quantity_section(std::string name, std::string doc, bool properties) {
    Section section{std::move(name), std::move(doc), {}, "Quantity", {"Unit"}};
    for (const QuantitySpec& quantity : quantities()) {
        if (quantity.is_property != properties) continue;
        const std::string behind = subscript(quantity.subscript).reference;
        // " or [body]": the name stands alone, too
        const bool is_alone = behind.starts_with(' ');
        const std::string written = is_alone ? behind.substr(0, 4) + quantity.name + behind.substr(4) : behind;
        section.rows.push_back(
            {quantity.name, quantity.name + written, {quantity.unit != nullptr ? quantity.unit : "depends"}, quantity.doc});
    }
    return section;
}

Section unit_section(std::string name, std::string doc, const char* rows_are, const std::vector<UnitRow>& rows) {
    Section section{std::move(name), std::move(doc), {}, rows_are};
    for (const UnitRow& row : rows) section.rows.push_back({row.name, {}, {}, row.doc});
    return section;
}

}  // namespace

Page function_page() {
    Page page{"functions", "Functions and operations", "Functions, operations and names that every expression may use.", {}};
    Section list{"Functions", {}, {}, "Function", {"Unit"}};
    for (const FunctionSpec& function : functions())
        list.rows.push_back(
            {function.name, fmt::format("{}({})", function.name, function.arguments), {describe(function.units)}, function.doc});
    list.notes = {
        "The column Unit names the unit of the result, and those of the arguments where they differ. 1 is a dimensionless number.",
        "A run locates the kinks and jumps of `abs`, `sign`, `min`, `max`, `step`, `ramp`, `pulse`, `mod` and `if`. If they depend on "
        "the time alone, their times are known; all others become guards of the header.",
        "`unlocated(x)` switches this off for everything inside x. An expression that jumps only in its second or a higher derivative, as "
        "`abs(v)*v`, needs no location."};
    page.sections.push_back(std::move(list));
    page.sections.push_back(form_section("Operations", "`+ - * / ^` and brackets, and:", FormPlace::everywhere));
    page.sections.push_back(form_section("In outputs and printed equations", {}, FormPlace::outputs));
    page.sections.push_back(form_section("In printed equations", {}, FormPlace::printed_equations));
    Section matrices = form_section("Matrices in printed equations", {}, FormPlace::matrices);
    matrices.notes = {"`position[BODY]` without an axis is a vector."};
    page.sections.push_back(std::move(matrices));
    Section names{"Names", "A file defines all other names.", {}, "Name"};
    for (const ConstantSpec& constant : known_names()) names.rows.push_back({constant.name, {}, {}, constant.doc});
    page.sections.push_back(std::move(names));
    return page;
}

Page quantity_page() {
    return {"quantities",
            "Derived quantities",
            "Quantities that the program derives from a model. An index in brackets names the element.",
            {quantity_section("For outputs and printed equations", {}, false),
             quantity_section("Properties",
                              "Expressions of elements may use these wherever they may use states. X is a volume, reservoir or junction.",
                              true)}};
}

Page unit_page() {
    Page page{"units",
              "Units",
              "Units are joined by `*`, `/` and `^`, as in `kg*m/s^2`. `1` is the unit of a dimensionless number, `1/s` that of a rate. A "
              "number without a unit counts in the declared unit of the parameter, coordinate, state or input that it belongs to. A number "
              "with a "
              "unit, as `\"5 bar\"`, is converted exactly. Inside a longer expression, a number with a composed unit stands in brackets: "
              "`(3 m/s)*t`.",
              {}};
    Section units{"Units", {}, {}, "Unit", {"Prefixes"}};
    for (const UnitRow& row : unit_rows()) units.rows.push_back({row.name, {}, {row.takes_prefix ? "yes" : ""}, row.doc});
    page.sections.push_back(std::move(units));
    page.sections.push_back(
        unit_section("Prefixes", "A prefix stands directly before a unit: `mm`, `kPa`, `um`.", "Prefix", prefix_rows()));
    page.sections.push_back(unit_section(
        "Other spellings", "The language does not have these units. Write the unit or the value on the right.", "Unit", other_unit_rows()));
    page.sections.back().docs_are = "Write";
    return page;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// What the program answers: errors, limits, JSON.
#include <fmt/format.h>

#include "reference/pages.hpp"
#include "report/json_fields.hpp"
#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

Page error_page() {
    Page page{"errors", "Errors and warnings",
              "A message begins with `file:line:column: error[ID]:` or `warning[ID]:`. A sentence and the line of the file follow, and "
              "often a note with the place of the other side. This page explains each id, with an example.",
              {}};
    for (const DiagnosticKind& kind : diagnostic_kinds()) page.sections.push_back({kind.name, kind.meaning, example_of(kind)});
    return page;
}

Page limit_page() {
    Page page{"limits", "Limits",
              "Each stage has limits. A count stops the same input at the same place on every machine; time and memory limits stop the "
              "rest. Some elements have limits of their own, which their messages name.",
              {}};
    for (const StageBudget& row : budgets()) {
        if (page.sections.empty() || page.sections.back().name != row.stage)
            page.sections.push_back({row.stage, {}, {}, "Counted", {"At most"}, "Beyond the limit"});
        page.sections.back().rows.push_back({row.what, {}, {fmt::format("{:g}", row.most)}, row.beyond});
    }
    return page;
}

Page json_page() {
    Page page{"json", "JSON results",
              "With `--format json`, a verb prints one JSON object. `[]` stands for the elements of an array, `<NAME>` for names of the "
              "model. Numbers are in SI units.",
              {}};
    const auto add = [&](const char* name, std::span<const JsonField> fields) {
        Section section{name, {}, {}, "Field"};
        for (const JsonField& field : fields) section.rows.push_back({field.path, {}, {}, field.doc});
        page.sections.push_back(std::move(section));
    };
    add("every result", common_json_fields());
    for (const JsonSchema& schema : json_schemas()) add(schema.verb, schema.fields);
    return page;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/dependence.hpp"
#include "elements/schema.hpp"
#include "printed/catalogue_schema.hpp"
#include "reference/pages.hpp"

namespace dalembert {

namespace {

Row key_row(const KeySpec& key, int level) {
    const bool is_table = key.parts != nullptr && key.type == ValueType::expressions_by_name;
    const std::string type = is_table ? "{ KEY = ... }" : describe(key.type) + (key.refers.empty() ? "" : " (" + key.refers + ")");
    return {key.name,
            {},
            {key.bounds.empty() ? type : type + ", " + key.bounds, key.unit,
             key.required ? "required" : key.start.empty() ? "optional" : "default " + key.start, described(key.depends)},
            key.doc,
            key.lines,
            level};
}

Section key_section(const SectionSpec& spec) {
    Section section{spec.name, spec.doc, spec.example, "Key", {"Value", "Unit", "Needed", "May depend on"}};
    for (std::size_t i = 0; i < spec.keys.size(); ++i) {
        const KeySpec& key = spec.keys[i];
        section.rows.push_back(key_row(key, 0));
        const bool is_like_last = i > 0 && spec.keys[i - 1].parts == key.parts;  // "likewise at the last end"
        if (key.parts == nullptr || is_like_last) continue;
        for (const KeySpec& part : key.parts()) section.rows.push_back(key_row(part, 1));
    }
    section.notes.assign(spec.rules.begin(), spec.rules.end());
    if (*spec.short_form != '\0') section.notes.push_back(fmt::format("A bare value stands for `{}`.", spec.short_form));
    return section;
}

std::string page_name(const Domain& domain) { return std::string("language_") + domain.name; }

Page overview() {
    Page page{"language", "The model language",
              "A model is a TOML file. Each section holds elements of one kind: `[bodies.NAME]` is a body. Below it stand the keys of the "
              "element.",
              {}};
    for (const Domain& domain : domains()) {
        Section section{domain.title, domain.doc, {}, "Section"};
        for (const SectionSpec* spec : sections_of(domain))
            section.rows.push_back({spec->name, fmt::format("[{}{}]", spec->name, spec->is_collection ? ".NAME" : ""), {}, spec->doc});
        section.link = page_name(domain);
        page.sections.push_back(std::move(section));
    }
    Section units{"Units of keys",
                  "The column Unit names the SI unit of a value. Other units of the same dimension are allowed: `\"5 bar\"`. U stands "
                  "for the unit that the element declares, or the unit of the expression that the key belongs to. Where the column is "
                  "empty, every unit is allowed."};
    page.sections.push_back(std::move(units));
    Section values{"Kinds of values", "The column Value uses these words.", {}, "Value"};
    for (const ValueWord& word : value_words())
        if (*word.meaning != '\0') values.rows.push_back({word.word, {}, {}, word.meaning});
    page.sections.push_back(std::move(values));
    Section words{"Words for dependences", "The column \"May depend on\" uses these words.", {}, "Word"};
    for (const DependenceWord& word : dependence_words()) words.rows.push_back({word.word, {}, {}, word.meaning});
    page.sections.push_back(std::move(words));
    return page;
}

}  // namespace

Pages language_pages() {
    Pages pages{overview()};
    for (const Domain& domain : domains()) {
        Page page{page_name(domain), domain.title, domain.doc, {}};
        for (const SectionSpec* spec : sections_of(domain)) page.sections.push_back(key_section(*spec));
        pages.push_back(std::move(page));
    }
    return pages;
}

Page catalogue_page() {
    Page page{"catalogue", "Catalogues of printed equations",
              "A catalogue is a TOML file with the equations of a text. `dalembert check` proves or refutes each of them.", {}};
    for (const SectionSpec& spec : catalogue_sections()) page.sections.push_back(key_section(spec));
    return page;
}

}  // namespace dalembert

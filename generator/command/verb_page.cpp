// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/verb_page.hpp"

#include <fmt/format.h>

#include "command/verb_description.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

Row option_row(const OptionDescription& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + name;
    std::string value = option.value;
    for (const std::string& choice : option.choices) value += (value.empty() ? "" : ", ") + choice;
    const std::string needed = option.is_required ? "required" : option.start.empty() ? "" : "default " + option.start;
    return {option.names.back(), names, {value, needed}, option.doc};
}

Section option_section(std::string name, std::string doc, const std::vector<OptionDescription>& options) {
    Section section{std::move(name), std::move(doc), {}, "Option", {"Value", "Needed"}};
    for (const OptionDescription& option : options) section.rows.push_back(option_row(option));
    return section;
}

}  // namespace

Page verb_page() {
    Page page{"verbs", "Verbs and options", "The first word of a command is a verb: `dalembert VERB MODEL OPTIONS`.", {}};
    for (const VerbDescription& verb : verb_descriptions()) page.sections.push_back(option_section(verb.name, verb.doc, verb.options));
    page.sections.push_back(option_section("all verbs", "These options stand before or after any verb.", program_options()));
    Section codes{"exit codes", {}, {}, "Code"};
    for (const ExitCodeSpec& code : exit_codes())
        codes.rows.push_back({std::to_string(static_cast<int>(code.code)), {}, {}, code.meaning});
    page.sections.push_back(std::move(codes));
    return page;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/verb_description.hpp"

#include <fmt/format.h>

#include "command/verbs.hpp"
#include "text/version.hpp"

namespace dalembert {

namespace {

OptionDescription described(const CLI::Option& option, const Given& given) {
    OptionDescription made;
    made.is_argument = option.get_positional();
    if (made.is_argument) made.names.push_back(option.get_name());
    for (const std::string& name : option.get_snames()) made.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) made.names.push_back("--" + name);
    made.is_flag = option.get_items_expected_max() == 0;
    made.is_required = option.get_required();
    const auto choices = given.choices.find(&option);
    if (choices != given.choices.end()) made.choices = choices->second;
    if (!made.is_flag && made.choices.empty()) {
        // The parser writes a value with its bounds as "INT:INT in [1 - 1000]".
        const std::string value = option.get_type_name();
        const std::size_t colon = value.find(':');
        const bool has_bounds = colon != std::string::npos && value.find(" in ") != std::string::npos;
        made.value = has_bounds ? value.substr(colon + 1) : value.substr(0, colon);
    }
    made.start = option.get_default_str();
    made.doc = option.get_description();
    return made;
}

std::vector<OptionDescription> described_options(const CLI::App& app, const Given& given) {
    std::vector<OptionDescription> made;
    for (const CLI::Option* option : app.get_options()) made.push_back(described(*option, given));
    return made;
}

}  // namespace

void add_program_options(CLI::App& app, double& stage_seconds, double& memory, const std::string& version) {
    app.add_option("--stage-seconds", stage_seconds, "processor time in seconds that a stage may take, in addition to `help limits`")
        ->check(CLI::PositiveNumber);
    app.add_option("--memory", memory, "memory in GB that the program may take")->check(CLI::PositiveNumber);
    app.set_version_flag("--version", "dalembert " + version);
}

std::vector<VerbDescription> verb_descriptions() {
    std::vector<VerbDescription> made;
    for (const Verb& verb : verbs()) {
        CLI::App app(verb.doc, verb.name);
        app.set_help_flag();  // every verb has it: see program_options
        Given given;
        VerbOptions options(app, given);
        verb.take(options);
        made.push_back({verb.name, verb.doc, described_options(app, given)});
    }
    return made;
}

std::vector<OptionDescription> program_options() {
    CLI::App app;
    double stage_seconds = 0, memory = 0;
    add_program_options(app, stage_seconds, memory, program_version);
    return described_options(app, {});
}

}  // namespace dalembert

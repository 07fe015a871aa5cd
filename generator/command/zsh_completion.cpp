// SPDX-License-Identifier: GPL-3.0-or-later
// Completion of command lines in zsh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command/installed_texts.hpp"
#include "command/verb_description.hpp"

namespace dalembert {

namespace {

constexpr const char* zsh_frame = R"(#compdef dalembert
# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of dalembert in zsh, written by `dalembert help --format zsh`.
_dalembert() {{
    local state line
    local -a verbs all
    verbs=(
{0}    )
    all=(
{1}    )
    _arguments -C $all '1:verb:->verb' '*::argument:->arguments'
    case $state in
        verb) _describe verb verbs ;;
        arguments)
            case $words[1] in
{2}            esac ;;
    esac
}}
_dalembert "$@"
)";

/// Text between single quotes; a backslash before what is special in a specification of _arguments.
std::string zsh_quoted(std::string_view plain, std::string_view special) {
    std::string made;
    for (const char c : plain) {
        if (c == '\'') made += "'\\'";
        else if (special.find(c) != std::string_view::npos) made += '\\';
        made += c;
    }
    return made;
}

/// "--format[text or json]:value:(text json)", in quotes, for each name.
std::vector<std::string> zsh_specifications(const OptionDescription& option) {
    if (option.is_argument) return {"'*:file:_files'"};
    std::string value;
    if (!option.choices.empty()) value = fmt::format(":value:({})", fmt::join(option.choices, " "));
    else if (option.names.back() == "--output") value = ":folder:_files -/";
    else if (!option.is_flag) value = ":value:";
    std::vector<std::string> made;
    for (const std::string& name : option.names) made.push_back(fmt::format("'{}[{}]{}'", name, zsh_quoted(option.doc, "[]:\\"), value));
    return made;
}

std::string zsh_lines(const std::vector<OptionDescription>& options, const char* before, const char* behind) {
    std::string text;
    for (const OptionDescription& option : options)
        for (const std::string& specification : zsh_specifications(option)) text += before + specification + behind;
    return text;
}

}  // namespace

std::string zsh_completion() {
    std::vector<std::string> names;
    for (const VerbDescription& verb : verb_descriptions()) names.push_back(verb.name);
    std::string verbs, options;
    for (const VerbDescription& verb : verb_descriptions()) {
        verbs += fmt::format("        '{}:{}'\n", verb.name, zsh_quoted(verb.doc, ":\\"));
        options += fmt::format("                {}) _arguments $all", verb.name) +
                   (verb.name == "help" ? fmt::format(" '1:topic:({})'", fmt::join(names, " ")) : "") + zsh_lines(verb.options, " \\\n                    ", "") + " ;;\n";
    }
    return fmt::format(zsh_frame, verbs, zsh_lines(program_options(), "        ", "\n"), options);
}

}  // namespace dalembert

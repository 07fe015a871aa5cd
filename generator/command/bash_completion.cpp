// SPDX-License-Identifier: GPL-3.0-or-later
// Completion of command lines in bash.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command/installed_texts.hpp"
#include "command/verb_description.hpp"

namespace dalembert {

namespace {

constexpr const char* bash_frame = R"(# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of dalembert in bash, written by `dalembert help --format bash`.
_dalembert()
{{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb="" options="" at
    # "--format=json" is three words.
    if [[ $word == "=" ]]; then word=""; elif [[ $before == "=" ]]; then before=${{COMP_WORDS[COMP_CWORD-2]}}; fi
    COMPREPLY=()
    for ((at = 1; at < COMP_CWORD; ++at)); do
        case ${{COMP_WORDS[at]}} in
            {0}) verb=${{COMP_WORDS[at]}}; break ;;
        esac
    done
    case "$verb $before" in
{1}        *" -o" | *" --output") mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;
    esac
    case $verb in
{2}    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options {3}" -- "$word")
    elif [[ -z $verb || $verb == help ]]; then
        mapfile -t COMPREPLY < <(compgen -W "{4}" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X '!*.@(toml|so)' -- "$word")
    fi
}}
shopt -s extglob
complete -o filenames -F _dalembert dalembert
)";

/// The names of options that begin with "-", one behind the other.
std::string bash_words(const std::vector<OptionDescription>& options) {
    std::vector<std::string> names;
    for (const OptionDescription& option : options)
        if (!option.is_argument) names.insert(names.end(), option.names.begin(), option.names.end());
    return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

std::string bash_completion() {
    std::vector<std::string> verbs;
    std::string values, options;
    for (const VerbDescription& verb : verb_descriptions()) {
        verbs.push_back(verb.name);
        options += fmt::format("        {}) options=\"{}\" ;;\n", verb.name, bash_words(verb.options));
        for (const OptionDescription& option : verb.options) {
            if (option.choices.empty()) continue;
            std::vector<std::string> cases;
            for (const std::string& name : option.names) cases.push_back(fmt::format("\"{} {}\"", verb.name, name));
            values += fmt::format("        {}) mapfile -t COMPREPLY < <(compgen -W \"{}\" -- \"$word\"); return ;;\n", fmt::join(cases, " | "),
                                  fmt::join(option.choices, " "));
        }
    }
    return fmt::format(bash_frame, fmt::join(verbs, " | "), values, options, bash_words(program_options()), fmt::join(verbs, " "));
}

}  // namespace dalembert

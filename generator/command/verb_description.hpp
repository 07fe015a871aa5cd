// SPDX-License-Identifier: GPL-3.0-or-later
// The verbs with their options as data, read off the parser that takes them: for reference pages, man page and completion.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dalembert {

struct OptionDescription {
    std::vector<std::string> names;    ///< "-o", "--output"; "MODEL" of an argument
    bool is_argument = false;          ///< stands by itself, without a name
    bool is_flag = false;              ///< takes no value
    bool is_required = false;
    std::string value;                 ///< kind of the value: "TEXT", "FLOAT"; of a bounded one "INT in [1 - 1000]"
    std::vector<std::string> choices;  ///< words that it may be; none: any
    std::string start;                 ///< the value when it is left out; empty: none is shown
    std::string doc;
};

struct VerbDescription {
    std::string name;
    std::string doc;
    std::vector<OptionDescription> options;
};

/// In the order of `dalembert --help`.
std::vector<VerbDescription> verb_descriptions();
/// Options that stand before or behind any verb.
std::vector<OptionDescription> program_options();

/// Adds the options that stand before or behind any verb.
void add_program_options(CLI::App& app, double& stage_seconds, double& memory, const std::string& version);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// The man page dalembert(1), in the language of man(7).
#include <fmt/format.h>

#include <cctype>

#include "command/command_line.hpp"
#include "command/installed_texts.hpp"
#include "command/verb_description.hpp"
#include "text/diagnostic.hpp"
#include "text/version.hpp"

namespace dalembert {

namespace {

struct EnvironmentVariable {
    const char* name;
    const char* doc;
};
constexpr EnvironmentVariable environment[] = {
    {"CXX", "C++ compiler that compiles plants, with options if needed; c++ if it is not set"},
    {"XDG_CACHE_HOME", "folder in which the folder dalembert keeps compiled plants; ~/.cache if it is not set"},
};

/// Plain text in the language of the page; `code` is bold.
std::string roff(std::string_view plain) {
    std::string made = plain.starts_with(".") || plain.starts_with("'") ? "\\&" : "";
    bool is_code = false;
    for (const char c : plain) {
        if (c == '`') made += (is_code = !is_code) ? "\\fB" : "\\fR";
        else if (c == '\\') made += "\\e";
        else if (c == '-') made += "\\-";
        else made += c;
    }
    return made;
}

std::string sentence(std::string words) {
    words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
    return words.back() == '.' ? words : words + ".";
}

std::string man_heading(const char* title) { return fmt::format(".SH {}\n", title); }
std::string man_item(const std::string& tag, std::string_view doc) { return fmt::format(".TP\n{}\n{}\n", tag, roff(doc)); }
std::string man_bold(std::string_view plain) { return "\\fB" + roff(plain) + "\\fR"; }
std::string man_italic(std::string_view plain) { return "\\fI" + roff(plain) + "\\fR"; }

/// "-o, --output TEXT"
std::string man_tag(const OptionDescription& option) {
    std::string tag;
    for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + (option.is_argument ? man_italic(name) : man_bold(name));
    std::string choices;
    for (const std::string& choice : option.choices) choices += (choices.empty() ? "" : " | ") + man_bold(choice);
    if (!choices.empty()) return tag + " " + choices;
    return option.is_flag || option.is_argument ? tag : tag + " " + man_italic(option.value);
}

std::string man_items(const std::vector<OptionDescription>& options) {
    std::string text;
    for (const OptionDescription& option : options)
        text += man_item(man_tag(option), option.doc + (option.start.empty() ? "" : fmt::format(" (default: {})", option.start)));
    return text;
}

std::string man_synopsis(const VerbDescription& verb) {
    std::string text = ".B dalembert " + verb.name + "\n";
    for (const OptionDescription& option : verb.options)
        if (option.is_argument) text += option.is_required ? man_italic(option.names[0]) + "\n" : "[" + man_italic(option.names[0]) + "]\n";
    return text + "[" + man_italic("OPTIONS") + "]\n";
}

}  // namespace

std::string man_page() {
    std::string text = fmt::format(".\\\" SPDX-License-Identifier: GPL-3.0-or-later\n.TH DALEMBERT 1 \"\" \"dalembert {}\" \"User Commands\"\n.nh\n",
                                   program_version);
    text += man_heading("NAME") + "dalembert \\- derive the equations of a machine, prove them, and write them as C++ or C\n";
    text += man_heading("SYNOPSIS") + ".B dalembert\n" + man_italic("VERB") + "\n[" + man_italic("MODEL") + "]\n[" + man_italic("OPTIONS") + "]\n";
    text += man_heading("DESCRIPTION");
    text += roff("The program reads a model file of a machine, derives its equations of motion symbolically, proves what can be proven, and "
                    "writes a header in C++ or C that needs no library. It also runs the model: simulations, equilibria, linearisations.") +
            "\n.PP\n" +
            roff("`dalembert help` prints the reference of the model language, `dalembert help WORD` the part of it about a section, a key or "
                    "a function.") +
            "\n";
    text += man_heading("VERBS");
    for (const VerbDescription& verb : verb_descriptions())
        text += ".SS " + verb.name + "\n" + man_synopsis(verb) + ".PP\n" + roff(sentence(verb.doc)) + "\n" + man_items(verb.options);
    text += man_heading("OPTIONS OF ALL VERBS") + man_items(program_options());
    text += man_heading("EXIT STATUS");
    for (const ExitCodeSpec& code : exit_codes()) text += man_item(man_bold(std::to_string(static_cast<int>(code.code))), code.meaning);
    text += man_heading("ENVIRONMENT");
    for (const EnvironmentVariable& variable : environment) text += man_item(man_bold(variable.name), variable.doc);
    text += man_heading("EXAMPLES") + ".nf\n";
    for (const char* example : command_examples()) text += roff(example) + "\n";
    return text + ".fi\n";
}

}  // namespace dalembert

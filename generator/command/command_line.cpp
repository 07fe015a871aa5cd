// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "command/verb_description.hpp"
#include "command/verbs.hpp"
#include "text/diagnostic.hpp"
#include "text/guardian.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr const char* examples[] = {
    R"(dalembert derive systems/mechanics/cart_pendulum.toml --scene lab)",
    R"(dalembert generate systems/mechanics/n_pendulum.toml --size N=5 -o include)",
    R"(dalembert check systems/mechanics/cart_pendulum.toml)",
    R"(dalembert evaluate systems/mechanics/cart_pendulum.toml --state "s=0.55,phi=0.7,dot(s)=-0.3" --input f_e=4.5)",
    R"(dalembert simulate systems/mechanics/cart_pendulum.toml --until 10 --tolerance 1e-9 -o out)",
    R"(dalembert optimise systems/mechanics/projectile.toml --run flight --maximise distance --over alpha=10deg:80deg)",
    R"(dalembert help bodies)",
};

std::string footer() {
    std::string text = "Examples:\n";
    for (const char* example : examples) text += fmt::format("  {}\n", example);
    std::string codes;
    for (const ExitCodeSpec& code : exit_codes())
        codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code.code), code.meaning);
    return text + fmt::format("\nExit codes: {}.", codes);
}

/// "N=5": sizes as they are given.
std::vector<std::pair<std::string, int>> read_sizes(const std::vector<std::string>& texts) {
    std::vector<std::pair<std::string, int>> sizes;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        const auto value = equals == std::string::npos ? std::nullopt : read_decimal(text.substr(equals + 1));
        const auto whole = value ? to_int(*value) : std::nullopt;
        if (!whole) throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("'--size {}' is not of the form NAME=WHOLE_NUMBER", text)});
        sizes.emplace_back(text.substr(0, equals), *whole);
    }
    return sizes;
}

/// "left.p_1", as model files call what a part has, is left_p_1.
void join_names(std::string& text) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    char first = ' ';  // of the word
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '.' && is_letter(first) && i + 1 < text.size() && is_letter(text[i + 1])) text[i] = '_';
        const bool is_in_word = is_letter(text[i]) || text[i] == '_' || std::isdigit(static_cast<unsigned char>(text[i])) != 0;
        first = !is_in_word ? ' ' : first == ' ' ? text[i] : first;
    }
}

/// In all options that hold names of the model.
void join_names(Options& o) {
    for (std::string* text : {&o.choice.scene, &o.against, &o.fit, &o.fix, &o.mode, &o.maximise, &o.minimise, &o.over}) join_names(*text);
    for (auto* texts : {&o.parameters, &o.states, &o.inputs, &o.measured, &o.noise, &o.held_inputs, &o.priors, &o.sensitivities, &o.vary,
                        &o.observe, &o.hold, &o.moving, &o.free})
        for (std::string& text : *texts) join_names(text);
}

class Parser {
public:
    explicit Parser(const std::string& version) : app_("Derives the equations of a machine, proves them, and emits C++.", "dalembert") {
        app_.footer(footer());
        app_.require_subcommand(1);
        app_.fallthrough();
        add_program_options(app_, stage_seconds_, memory_, version);
        for (const Verb& verb : verbs()) {
            VerbOptions options(*app_.add_subcommand(verb.name, verb.doc), given_);
            verb.take(options);
        }
    }

    /// Nothing to do when help was asked for and printed.
    std::optional<Options> parse(std::vector<std::string> arguments, Streams streams) {
        arguments_ = arguments;
        std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them back to front
        try {
            app_.parse(std::move(arguments));
        } catch (const CLI::ParseError& error) {
            if (error.get_exit_code() == 0) {
                app_.exit(error, streams.out, streams.err);
                return std::nullopt;
            }
            throw not_understood(error);
        }
        set_stage_budget(stage_seconds_, 1e9 * memory_);
        return asks_for_help(streams) ? std::nullopt : std::optional(completed());
    }

    /// Calls the verb that was parsed. Throws Failure.
    ExitCode run(const Options& options, Streams streams) const {
        const auto verb = std::find_if(verbs().begin(), verbs().end(), [&](const Verb& one) { return one.name == options.verb; });
        return verb->run(options, streams);
    }

private:
    /// Whether help on a verb was asked for, by `help VERB`, and printed.
    bool asks_for_help(Streams streams) {
        if (parsed_verb() != "help" || given_.options.format != "text") return false;
        for (const CLI::App* verb : app_.get_subcommands({})) {
            if (verb->get_name() != given_.options.topic) continue;
            streams.out << verb->help("dalembert");
            return true;
        }
        return false;
    }

    std::string parsed_verb() const { return app_.get_subcommands().front()->get_name(); }

    Options completed() const {
        Options options = given_.options;
        if (!std::isfinite(options.tolerance) || !std::isfinite(options.step) || !std::isfinite(options.periods))
            throw Failure(Diagnostic{Id::bad_option, {}, "tolerance, step and periods are finite numbers"});
        options.verb = parsed_verb();
        join_names(options);
        options.choice.model = given_.model;
        std::vector<std::string> sizes = given_.sizes;
        for (std::string& text : sizes) join_names(text);
        for (const auto& [name, value] : read_sizes(sizes)) {
            options.choice.sizes[name] = value;
            options.size_lists[name].push_back(value);
        }
        return options;
    }

    static std::vector<std::string> verb_names() {
        std::vector<std::string> names;
        for (const Verb& verb : verbs()) names.emplace_back(verb.name);
        return names;
    }

    /// What CLI11 could not make sense of, in a sentence of ours.
    Failure not_understood(const CLI::ParseError& error) {
        if (const std::string slip = misspelt(); !slip.empty())
            return Failure(Diagnostic{Id::bad_option, {}, slip + "; see `dalembert --help`"});
        const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || app_.get_subcommands().empty();
        const std::string hint = is_extra ? fmt::format("; the verbs are {}", quoted_list(verb_names())) : "";
        return Failure(Diagnostic{Id::bad_option, {}, std::string(error.what()) + hint + "; see `dalembert --help`"});
    }

    /// A sentence on a verb or an option that is none, and the nearest one; empty where all are known.
    std::string misspelt() {
        if (arguments_.empty() || arguments_[0].starts_with("-")) return {};
        const std::vector<std::string> names = verb_names();
        const auto found = std::find(names.begin(), names.end(), arguments_[0]);
        if (found == names.end())
            return fmt::format(
                "there is no verb '{}'{}", arguments_[0],
                nearest(arguments_[0], names).empty() ? "; the verbs are " + quoted_list(names) : did_you_mean(arguments_[0], names));
        const CLI::App* verb = app_.get_subcommand(*found);
        std::vector<std::string> known;
        for (const CLI::Option* option : verb->get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        for (const std::string& argument : arguments_) {
            const std::string option = argument.substr(0, argument.find('='));
            if (!option.starts_with("--") || option == "--" || std::find(known.begin(), known.end(), option) != known.end()) continue;
            return fmt::format("'{}' has no option '{}'{}; `dalembert help {}` lists them", *found, option, did_you_mean(option, known),
                               *found);
        }
        return {};
    }

    CLI::App app_;
    Given given_;
    std::vector<std::string> arguments_;
    double stage_seconds_ = 0, memory_ = 0;
};

}  // namespace

std::span<const char* const> command_examples() { return examples; }

int run_program(const std::vector<std::string>& arguments, Streams streams, const std::string& version) {
    try {
        Parser parser(version);
        const auto options = parser.parse(arguments, streams);
        return static_cast<int>(options ? parser.run(*options, streams) : ExitCode::good);
    } catch (const Failure& failure) {
        streams.err << failure.what();
        return static_cast<int>(failure.exit_code());
    } catch (const std::bad_alloc&) {
        streams.err << "dalembert: error[too-large]: there is not enough memory; use a smaller model, fewer cells or modes\n";
        return static_cast<int>(ExitCode::bad_input);
    } catch (const GiNaC::pole_error&) {
        streams.err << "dalembert: error[division-by-zero]: a value that was given makes an expression divide by zero\n";
        return static_cast<int>(ExitCode::bad_input);
    } catch (const std::filesystem::filesystem_error& error) {
        streams.err << "dalembert: error[unreadable-file]: " << error.what() << "\n";
        return static_cast<int>(ExitCode::tool_missing);
    } catch (const std::exception& error) {
        streams.err << "dalembert: error: " << error.what() << "\nThis is a defect of the program; please report it with the model.\n";
        return static_cast<int>(ExitCode::tool_missing);
    }
}

}  // namespace dalembert

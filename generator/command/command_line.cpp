// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "graph/passes.hpp"
#include "elements/methods.hpp"
#include "text/budgets.hpp"
#include "text/guardian.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr const char* examples = R"(Examples:
  dalembert derive systems/mechanics/cart_pendulum.toml --scene lab
  dalembert generate systems/mechanics/n_pendulum.toml --size N=5 -o include
  dalembert check systems/mechanics/cart_pendulum.toml
  dalembert evaluate systems/mechanics/cart_pendulum.toml --state "s=0.55,phi=0.7,dot(s)=-0.3" --input f_e=4.5
  dalembert simulate systems/mechanics/cart_pendulum.toml --until 10 --tolerance 1e-9 -o out
  dalembert optimise systems/mechanics/projectile.toml --run flight --maximise distance --over alpha=10deg:80deg
  dalembert help bodies

Exit codes: 0 good, 1 a check failed, 2 bad input, 3 a tool or compiler is missing or failed, 4 a run stopped.)";

/// For CLI11: empty when the text is the name of a file and no path, else what is wrong.
std::string file_name(const std::string& text) {
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; };
    if (!text.empty() && text.front() != '.' && text.front() != '-' && std::all_of(text.begin(), text.end(), fits)) return {};
    return fmt::format("'{}' is not a file name of letters, digits, '_', '-' and '.'", text);
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

using Command = ExitCode (*)(const Options&, Streams);

class Parser {
public:
    Parser() : app_("Derives the equations of a machine, proves them, and emits C++.", "dalembert") {
        app_.footer(examples);
        app_.require_subcommand(1);
        app_.fallthrough();
        app_.add_option("--stage-seconds", stage_seconds_, "processor time that a stage may take, beside the counts of `help limits`")->check(CLI::PositiveNumber);
        app_.add_option("--memory", memory_, "GB of memory that the program may take")->check(CLI::PositiveNumber);
        app_.set_version_flag("--version", std::string("dalembert ") + program_version);

        CLI::App* derive = model_verb(derive_command, "derive", "print the equations of motion");
        format(derive, "text, latex or json", {"text", "latex", "json"});
        CLI::App* generate = model_verb(generate_command, "generate", "write the C++ header");
        output(generate);
        auto* every = generate->add_flag("--every-scene", options_.every_scene, "the headers of all scenes");
        generate->add_option("--header", options_.header, "file name of the header instead of NAME_SCENE.hpp")->excludes(every)->check(file_name);
        generate->add_option("--fix", options_.fix, "parameters that become numbers in the code: `parameters` for all, or names, each with =VALUE if it is not the default's");
        generate->add_flag("--taylor", options_.taylor, "with Taylor series of the motion, for the method taylor");
        generate->add_flag("--together", options_.together, "with one more function, `together`, for rates, Jacobian, outputs and energies at once");
        format(generate, "text or json", {"text", "json"});
        explain(generate);
        rewriting(generate);
        language(generate);
        CLI::App* check = add_verb(check_command, "check", "prove derivations and check printed equations: of models, in every scene unless one is chosen, and of catalogues of texts");
        check->add_option("FILES", options_.models, "model files and catalogues")->required();
        check->add_option("-o,--output", options_.pages, "folder for book.html, every equation with its verdict, and errata.html; none are written, if left out");
        check->add_option("--scene", options_.choice.scene, "of models: the scene, if there are several");
        check->add_option("--size", sizes_, "of models: size of a family, as N=5")->delimiter(',');
        format(check, "text or json", {"text", "json"});
        CLI::App* evaluate = model_verb(evaluate_command, "evaluate", "state derivative, outputs and energies at one point");
        settings(evaluate);
        mode(evaluate);
        format(evaluate, "text or json", {"text", "json"});
        evaluate->add_option("--time", options_.time, "the time, as 0.5 (in seconds) or 3ms; 0, if left out");
        evaluate->add_option("--digits", options_.digits, "significant digits of the results")->capture_default_str()->check(CLI::Range(1, 1000));
        CLI::App* simulate = model_verb(simulate_command, "simulate", "generate, compile and run a simulation; write CSV and plots");
        settings(simulate);
        output(simulate);
        format(simulate, "text or json", {"text", "json"});
        integration(simulate);
        simulate->add_option("--until", options_.until, "end of the run in seconds");
        CLI::App* equilibrium = model_verb(equilibrium_command, "equilibrium", "find an equilibrium, and the linearisation there with its eigenvalues");
        settings(equilibrium);
        mode(equilibrium);
        format(equilibrium, "text or json", {"text", "json"});
        equilibrium->add_option("--hold", options_.hold, "states that keep their value, comma separated")->delimiter(',');
        equilibrium->add_option("--moving", options_.moving, "coordinates that go on at constant speed: a steady motion is sought, at the speeds of the start; comma separated")->delimiter(',');
        equilibrium->add_option("--free", options_.free, "inputs that may change, comma separated")->delimiter(',');
        CLI::App* modal = model_verb(modal_command, "modal", "eigenvalues, eigenvectors and modal form of a linear mechanical system, or of the linearisation at its start");
        settings(modal);
        mode(modal);
        format(modal, "text or json", {"text", "json"});
        modal->add_option("--run", options_.run, "the [runs.NAME] at whose start; `reference`, or the only one, if left out");
        CLI::App* optimise = model_verb(optimise_command, "optimise", "find the parameter with which an output at the end of a run is largest or smallest");
        auto* maximise = optimise->add_option("--maximise", options_.maximise, "the output, or state, that is to be as large as possible");
        optimise->add_option("--minimise", options_.minimise, "the one that is to be as small as possible")->excludes(maximise);
        optimise->add_option("--over", options_.over, "the parameter and where to look, as alpha=10deg:80deg")->required();
        optimise->add_option("--points", options_.points, "values of the scan that finds where to look closer")->capture_default_str()->check(CLI::Range(3, 10000));
        settings(optimise);
        format(optimise, "text or json", {"text", "json"});
        integration(optimise, false);
        optimise->add_option("--until", options_.until, "end of the run in seconds, where no event ends it before");
        CLI::App* survey = add_verb(survey_command, "survey", "check, generate and simulate several models; print a table");
        survey->add_option("MODELS", options_.models, "model files")->required();
        survey->add_option("--size", sizes_, "size of a family, as N=5, where a model has it")->delimiter(',');
        survey->add_flag("--every-scene", options_.every_scene, "a row for each scene, not only for the default");
        output(survey);
        format(survey, "text or json", {"text", "json"});
        integration(survey);
        CLI::App* effects = model_verb(effects_command, "effects", "what each scene and each effect costs, and what leaving it out changes; writes CSV and a plot");
        effects->add_option("--against", options_.against, "the scene that others are compared with; the one with most effects, if left out");
        settings(effects);
        output(effects);
        format(effects, "text or json", {"text", "json"});
        integration(effects);
        effects->add_option("--until", options_.until, "end of the run in seconds");
        CLI::App* cost = add_verb(cost_command, "cost", "what accuracy costs in time: every method in every arithmetic, against a reference; writes CSV and plots");
        cost->add_option("MODELS", options_.models, "model files")->required();
        auto* scene = cost->add_option("--scene", options_.choice.scene, "one scene; all scenes of one model, if left out, and the usual one of several");
        cost->add_flag("--every-scene", options_.every_scene, "all scenes, also of several models")->excludes(scene);
        cost->add_option("--size", sizes_, "sizes of a family, each of which is measured, as N=10,N=20")->delimiter(',');
        cost->add_option("--methods", options_.methods, "those that are measured, comma separated; all, if left out")->delimiter(',')->check(CLI::IsMember(method_names()));
        cost->add_option("--arithmetics", options_.arithmetics, "float, double, long_double; all, if left out")->delimiter(',')->check(CLI::IsMember({"float", "double", "long_double"}));
        cost->add_option("--budget", options_.budget, "as '1 ms step, 20 us': instead, the most accurate way that makes such a step in this time");
        cost->add_option("--limit", options_.limit, "seconds after which a run is given up; the reference has twelve times as many")->capture_default_str()->check(CLI::Range(1.0, 1e5));
        settings(cost);
        output(cost);
        format(cost, "text or json", {"text", "json"});
        cost->add_option("--run", options_.run, "the [runs.NAME] to take; `reference`, or the only one, if left out");
        cost->add_option("--until", options_.until, "end of the run in seconds");
        cost->add_flag("--no-plot", options_.no_plot, "write the CSV only");
        CLI::App* accuracy = model_verb(accuracy_command, "accuracy", "how many digits the generated functions have, in float and double, against 100 digits at random and edge points");
        accuracy->add_option("--points", options_.test_points, "points in each arithmetic")->capture_default_str()->check(CLI::Range(1, 1000000));
        accuracy->add_option("--seed", options_.seed, "of the random numbers")->capture_default_str();
        accuracy->add_option("--limit", options_.ulp_limit, "largest error in double that is good, in ulp beyond the condition")->capture_default_str()->check(CLI::PositiveNumber);
        format(accuracy, "text or json", {"text", "json"});
        accuracy->add_flag("--explain", options_.explain, "what was rewritten to keep digits");
        rewriting(accuracy);
        CLI::App* scenes = add_verb(scenes_command, "scenes", "list the scenes of a model and their effects");
        scenes->add_option("MODEL", model_, "model file")->required();
        format(scenes, "text or json", {"text", "json"});
        CLI::App* help = add_verb(help_command, "help", "the model language: a section, a key, `functions`, `quantities`, `units`; also `catalogue`, `errors`, `limits`, `json` and any verb");
        help->add_option("TOPIC", options_.topic, "for example `bodies`, `bodies.mass` or `mass`");
    }

    /// Calls the verb that was parsed.
    ExitCode run(const Options& options, Streams streams) const { return commands_.at(options.verb)(options, streams); }

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
            if (const std::string slip = misspelt(); !slip.empty()) throw Failure(Diagnostic{Id::bad_option, {}, slip + "; see `dalembert --help`"});
            std::string hint;
            if (const auto* extras = dynamic_cast<const CLI::ExtrasError*>(&error); extras != nullptr || app_.get_subcommands().empty()) {
                std::vector<std::string> verbs;
                for (const CLI::App* verb : app_.get_subcommands({})) verbs.push_back(verb->get_name());
                hint = fmt::format("; the verbs are {}", quoted_list(verbs));
            }
            throw Failure(Diagnostic{Id::bad_option, {}, std::string(error.what()) + hint + "; see `dalembert --help`"});
        }
        if (!std::isfinite(options_.tolerance) || !std::isfinite(options_.step) || !std::isfinite(options_.periods))
            throw Failure(Diagnostic{Id::bad_option, {}, "tolerance, step and periods are finite numbers"});
        set_stage_budget(stage_seconds_, 1e9 * memory_);
        options_.verb = app_.get_subcommands().front()->get_name();
        for (const CLI::App* verb : app_.get_subcommands({})) {
            if (options_.verb != "help" || verb->get_name() != options_.topic) continue;
            streams.out << verb->help("dalembert");
            return std::nullopt;
        }
        options_.choice.model = model_;
        for (const auto& [name, value] : read_sizes(sizes_)) {
            options_.choice.sizes[name] = value;
            options_.size_lists[name].push_back(value);
        }
        return options_;
    }

private:
    /// A sentence on a verb or an option that is none, and the nearest one; empty where all are known.
    std::string misspelt() {
        if (arguments_.empty() || arguments_[0].starts_with("-")) return {};
        std::vector<std::string> verbs;
        for (const CLI::App* verb : app_.get_subcommands({})) verbs.push_back(verb->get_name());
        const auto found = std::find(verbs.begin(), verbs.end(), arguments_[0]);
        if (found == verbs.end())
            return fmt::format("there is no verb '{}'{}", arguments_[0], nearest(arguments_[0], verbs).empty() ? "; the verbs are " + quoted_list(verbs) : did_you_mean(arguments_[0], verbs));
        const CLI::App* verb = app_.get_subcommand(*found);
        std::vector<std::string> known;
        for (const CLI::Option* option : verb->get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        for (const std::string& argument : arguments_) {
            const std::string option = argument.substr(0, argument.find('='));
            if (!option.starts_with("--") || option == "--" || std::find(known.begin(), known.end(), option) != known.end()) continue;
            return fmt::format("'{}' has no option '{}'{}; `dalembert help {}` lists them", *found, option, did_you_mean(option, known), *found);
        }
        return {};
    }

    void mode(CLI::App* verb) { verb->add_option("--mode", options_.mode, "of a machine that switches, the mode; the first, if left out"); }

    /// Each verb with what it calls and what it says of itself, here and nowhere else.
    CLI::App* add_verb(Command command, const char* name, const char* what) {
        commands_[name] = command;
        return app_.add_subcommand(name, what);
    }
    CLI::App* model_verb(Command command, const char* name, const char* what) {
        CLI::App* verb = add_verb(command, name, what);
        verb->add_option("MODEL", model_, "model file")->required();
        verb->add_option("--scene", options_.choice.scene, "the scene, if the model has several; NAME+EFFECT and NAME-EFFECT add one effect or leave one out");
        verb->add_option("--size", sizes_, "size of a family, as N=5")->delimiter(',');
        return verb;
    }
    void output(CLI::App* verb) { verb->add_option("-o,--output", options_.output, "folder for results; made if it is not there")->default_val("."); }
    void format(CLI::App* verb, const char* what, std::vector<std::string> choices) {
        verb->add_option("--format", options_.format, what)->check(CLI::IsMember(std::move(choices)));
    }
    void settings(CLI::App* verb) {
        verb->add_option("--parameter", options_.parameters, "as m_W=1.2 or p=5bar, comma separated; without a unit, a value counts in the declared one");
        verb->add_option("--state", options_.states, "as s=0.55,dot(s)=-0.3");
        verb->add_option("--input", options_.inputs, "as f_e=4.5; for simulate an expression of t and the states");
    }
    void integration(CLI::App* verb, bool draws = true) {
        verb->add_option("--run", options_.run, "the [runs.NAME] to take; `reference`, or the only one, if left out");
        verb->add_option("--tolerance", options_.tolerance, "relative tolerance of a step")->check(CLI::Range(1e-16, 0.5));
        verb->add_option("--method", options_.method, methods_text())->check(CLI::IsMember(method_names()));
        verb->add_option("--step", options_.step, "step of methods with a fixed one, in seconds")->check(CLI::PositiveNumber);
        verb->add_option("--samples", options_.samples, "number of intervals at which results are written")->check(CLI::Range(1, budget::samples));
        verb->add_option("--periods", options_.periods, "length of the run in periods, where the run names a period")->check(CLI::PositiveNumber);
        if (!draws) return;
        verb->add_flag("--no-plot", options_.no_plot, "write the CSV only");
        verb->add_option("--units", options_.units, "of CSV and plots: declared, as in the model, or si; if left out, CSV is in SI and plots are in declared units")->check(CLI::IsMember({"declared", "si"}));
    }
    void rewriting(CLI::App* verb) {
        std::vector<std::string> names;
        std::string docs = "passes to leave out, comma separated:";
        for (const Pass& pass : all_passes) {
            names.emplace_back(pass.name);
            docs += fmt::format("{} {} ({})", names.size() == 1 ? "" : ",", pass.name, pass.doc);
        }
        verb->add_option("--without", options_.without, docs)->delimiter(',')->check(CLI::IsMember(names));
        verb->add_option("--trig", options_.trig, "combined: sine and cosine in float from one reduction, as fast for every angle")
            ->check(CLI::IsMember({"library", "combined"}));
    }
    void language(CLI::App* verb) {
        std::vector<std::string> names;
        std::string docs = "of the header:";
        for (const Language& one : languages()) {
            names.emplace_back(one.name);
            docs += fmt::format("{} {} ({})", names.size() == 1 ? "" : ",", one.name, one.doc);
        }
        verb->add_option("--language", options_.language, docs)->check(CLI::IsMember(names));
    }
    void explain(CLI::App* verb) {
        verb->add_flag("--explain", options_.explain, "time and result of each stage, and what was rewritten to keep digits");
        verb->add_option("--dump", options_.dump, "print a stage instead: scene, equations, atoms or code")->check(CLI::IsMember({"scene", "equations", "atoms", "code"}));
    }

    CLI::App app_;
    Options options_;
    std::string model_;
    std::vector<std::string> sizes_;
    std::vector<std::string> arguments_;
    double stage_seconds_ = 0, memory_ = 0;
    std::map<std::string, Command> commands_;
};

}  // namespace

int run_program(const std::vector<std::string>& arguments, Streams streams) {
    try {
        Parser parser;
        const auto options = parser.parse(arguments, streams);
        return static_cast<int>(options ? parser.run(*options, streams) : ExitCode::good);
    } catch (const Failure& failure) {
        streams.err << failure.what();
        return static_cast<int>(failure.exit_code());
    } catch (const std::bad_alloc&) {
        streams.err << "dalembert: error[too-large]: there is not enough memory; a smaller model, fewer cells or modes need less\n";
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

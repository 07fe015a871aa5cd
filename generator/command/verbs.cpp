// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "command/installed_texts.hpp"
#include "elements/methods.hpp"

namespace dalembert {

/// Each in a file of its own.
ExitCode new_command(const Options& options, Streams streams);
ExitCode derive_command(const Options& options, Streams streams);
ExitCode generate_command(const Options& options, Streams streams);
ExitCode compile_command(const Options& options, Streams streams);
ExitCode check_command(const Options& options, Streams streams);
ExitCode evaluate_command(const Options& options, Streams streams);
ExitCode simulate_command(const Options& options, Streams streams);
ExitCode equilibrium_command(const Options& options, Streams streams);
ExitCode modal_command(const Options& options, Streams streams);
ExitCode optimise_command(const Options& options, Streams streams);
ExitCode survey_command(const Options& options, Streams streams);
ExitCode gallery_command(const Options& options, Streams streams);
ExitCode effects_command(const Options& options, Streams streams);
ExitCode cost_command(const Options& options, Streams streams);
ExitCode accuracy_command(const Options& options, Streams streams);
ExitCode scenes_command(const Options& options, Streams streams);
ExitCode help_command(const Options& options, Streams streams);

namespace {

/// For CLI11: empty when the text is the name of a file and no path, else what is wrong.
std::string file_name(const std::string& text) {
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; };
    if (!text.empty() && text.front() != '.' && text.front() != '-' && std::all_of(text.begin(), text.end(), fits)) return {};
    return fmt::format("'{}' is not a file name of letters, digits, '_', '-' and '.'", text);
}

void take_new(VerbOptions& o) {
    o.add("NAME", o.options.project, "name of the project, of its folder and of its model")->required();
    o.kind();
    o.output();
    o.format();
}

void take_derive(VerbOptions& o) {
    o.model();
    o.format({"text", "latex", "json"});
}

void take_generate(VerbOptions& o) {
    o.model();
    o.output();
    auto* every = o.flag("--every-scene", o.options.every_scene, "the headers of all scenes");
    o.add("--header", o.options.header, "file name of the header instead of NAME_SCENE.hpp")->excludes(every)->check(file_name);
    o.add("--fix", o.options.fix,
          "parameters that become numbers in the code: `parameters` for all, or names, each with =VALUE if it is not the default's");
    o.flag("--taylor", o.options.taylor, "with Taylor series of the motion, for the method taylor");
    o.flag("--together", o.options.together, "with one more function, `together`, for rates, Jacobian, outputs and energies at once");
    o.format();
    o.explain("time and result of each stage, and what was rewritten to keep digits");
    o.dump();
    o.rewriting();
    o.language();
}

void take_compile(VerbOptions& o) {
    o.model();
    o.output();
    o.format();
    o.rewriting();
}

void take_check(VerbOptions& o) {
    o.files("FILES", "model files and catalogues");
    o.add("-o,--output", o.options.pages,
          "folder for book.html, every equation with its verdict, and errata.html; none are written, if left out");
    o.add("--scene", o.options.choice.scene, "of models: the scene, if there are several");
    o.sizes("of models: size of a family, as N=5");
    o.format();
}

void take_evaluate(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.add("--time", o.options.time, "the time, as 0.5 (in seconds) or 3ms; 0, if left out");
    o.add("--digits", o.options.digits, "significant digits of the results")->capture_default_str()->check(CLI::Range(1, 1000));
}

void take_simulate(VerbOptions& o) {
    o.model();
    o.settings();
    o.output();
    o.format();
    o.integration();
    o.plots();
    o.until();
    o.cache();
    o.explain("time and result of each stage, and where the plant comes from");
}

void take_equilibrium(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.add("--hold", o.options.hold, "states that keep their value, comma separated")->delimiter(',');
    o.add("--moving", o.options.moving,
          "coordinates that go on at constant speed: a steady motion is sought, at the speeds of the start; comma separated")
        ->delimiter(',');
    o.add("--free", o.options.free, "inputs that may change, comma separated")->delimiter(',');
    o.cache();
    o.explain("time and result of each stage, and where the plant comes from");
}

void take_modal(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.run("the [runs.NAME] at whose start; `reference`, or the only one, if left out");
    o.cache();
    o.explain("time and result of each stage, and where the plant comes from");
}

void take_optimise(VerbOptions& o) {
    o.model();
    auto* maximise = o.add("--maximise", o.options.maximise, "the output, or state, that is to be as large as possible");
    o.add("--minimise", o.options.minimise, "the one that is to be as small as possible")->excludes(maximise);
    o.add("--over", o.options.over, "the parameter and where to look, as alpha=10deg:80deg")->required();
    o.add("--points", o.options.points, "values of the scan that finds where to look closer")
        ->capture_default_str()
        ->check(CLI::Range(3, 10000));
    o.settings();
    o.format();
    o.integration();
    o.until("end of the run in seconds, where no event ends it before");
    o.cache();
}

void take_survey(VerbOptions& o) {
    o.files("MODELS", "model files");
    o.sizes("size of a family, as N=5, where a model has it");
    o.flag("--every-scene", o.options.every_scene, "a row for each scene, not only for the default");
    o.output();
    o.format();
    o.integration();
    o.plots();
    o.cache();
}

void take_gallery(VerbOptions& o) {
    o.files("MODELS", "model files; the folder of each is its domain");
    o.add("--generated", o.options.generated,
          "folder of headers, DOMAIN/NAME_SCENE.hpp, to which the pages link, and for pictures, gallery/NAME.svg; that of the pages, if left out");
    o.output();
    o.cache();
}

void take_effects(VerbOptions& o) {
    o.model();
    o.add("--against", o.options.against, "the scene that others are compared with; the one with most effects, if left out");
    o.settings();
    o.output();
    o.format();
    o.integration();
    o.plots();
    o.until();
    o.cache();
}

void take_cost(VerbOptions& o) {
    o.files("MODELS", "model files");
    auto* scene = o.add("--scene", o.options.choice.scene, "one scene; all scenes of one model, if left out, and the usual one of several");
    o.flag("--every-scene", o.options.every_scene, "all scenes, also of several models")->excludes(scene);
    o.sizes("sizes of a family, each of which is measured, as N=10,N=20");
    o.one_of(o.add("--methods", o.options.methods, "methods to measure, comma separated; all, if left out")->delimiter(','),
             method_names());
    o.one_of(o.add("--arithmetics", o.options.arithmetics, "number types to measure, comma separated; all, if left out")->delimiter(','),
             {"float", "double", "long_double"});
    o.add("--budget", o.options.budget, "as '1 ms step, 20 us': instead, the most accurate way that makes such a step in this time");
    o.add("--limit", o.options.limit, "seconds after which a run is given up; the reference has twelve times as many")
        ->capture_default_str()->check(CLI::Range(1.0, 1e5));
    o.settings();
    o.output();
    o.format();
    o.run();
    o.until();
    o.flag("--no-plot", o.options.no_plot, "write the CSV only");
}

void take_accuracy(VerbOptions& o) {
    o.model();
    o.add("--points", o.options.test_points, "points in each arithmetic")->capture_default_str()->check(CLI::Range(1, 1000000));
    o.add("--seed", o.options.seed, "of the random numbers")->capture_default_str();
    o.add("--limit", o.options.ulp_limit, "largest error in double that is good, in ulp beyond the condition")
        ->capture_default_str()->check(CLI::PositiveNumber);
    o.format();
    o.explain("what was rewritten to keep digits");
    o.rewriting();
}

void take_scenes(VerbOptions& o) {
    o.model_alone();
    o.format();
}

void take_help(VerbOptions& o) {
    o.add("TOPIC", o.options.topic, "for example `bodies`, `bodies.mass` or `mass`");
    std::vector<std::string> formats{"text"};
    for (const InstalledText& text : installed_texts()) formats.emplace_back(text.format);
    o.format(std::move(formats));
}

constexpr auto table = std::to_array<Verb>({
    {"new", "write a project to begin with: a model with comments, and a C++ program around it", new_command, take_new},
    {"derive", "print the equations of motion", derive_command, take_derive},
    {"generate", "write the C++ header", generate_command, take_generate},
    {"compile", "write the model as a plant: a shared library with a table of C functions, and the C header of that table", compile_command,
     take_compile},
    {"check", "prove derivations and check printed equations: of models, in every scene unless one is chosen, and of catalogues of texts",
     check_command, take_check},
    {"evaluate", "state derivative, outputs and energies at one point", evaluate_command, take_evaluate},
    {"simulate", "run a simulation of a model, or of a plant (FILE.so) that somebody compiled; write CSV and plots", simulate_command,
     take_simulate},
    {"equilibrium", "find an equilibrium, and the linearisation there with its eigenvalues", equilibrium_command, take_equilibrium},
    {"modal", "eigenvalues, eigenvectors and modal form of a linear mechanical system, or of the linearisation at its start", modal_command,
     take_modal},
    {"optimise", "find the parameter with which an output at the end of a run is largest or smallest", optimise_command, take_optimise},
    {"survey", "check, generate and simulate several models; print a table", survey_command, take_survey},
    {"gallery", "pages of several models, gallery.html and GALLERY.md: of each a small plot, numbers, what it shows, verdicts and links",
     gallery_command, take_gallery},
    {"effects", "what each scene and each effect costs, and what leaving it out changes; writes CSV and a plot", effects_command,
     take_effects},
    {"cost", "what accuracy costs in time: every method in every arithmetic, against a reference; writes CSV and plots", cost_command,
     take_cost},
    {"accuracy", "how many digits the generated functions have, in float and double, against 100 digits at random and edge points",
     accuracy_command, take_accuracy},
    {"scenes", "list the scenes of a model and their effects", scenes_command, take_scenes},
    {"help",
     "the model language: a section, a key, `functions`, `quantities`, `units`; also `catalogue`, `errors`, `limits`, `json` and any verb",
     help_command, take_help},
});

}  // namespace

std::span<const Verb> verbs() { return table; }

}  // namespace dalembert

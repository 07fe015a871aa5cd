// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "command/installed_texts.hpp"
#include "identify/fit.hpp"
#include "plant/methods.hpp"

namespace dalembert {

/// Each in a file of its own.
ExitCode new_command(const Options& options, Streams streams);
ExitCode derive_command(const Options& options, Streams streams);
ExitCode generate_command(const Options& options, Streams streams);
ExitCode compile_command(const Options& options, Streams streams);
ExitCode export_command(const Options& options, Streams streams);
ExitCode check_command(const Options& options, Streams streams);
ExitCode evaluate_command(const Options& options, Streams streams);
ExitCode simulate_command(const Options& options, Streams streams);
ExitCode equilibrium_command(const Options& options, Streams streams);
ExitCode modal_command(const Options& options, Streams streams);
ExitCode optimise_command(const Options& options, Streams streams);
ExitCode identify_command(const Options& options, Streams streams);
ExitCode study_command(const Options& options, Streams streams);
ExitCode survey_command(const Options& options, Streams streams);
ExitCode gallery_command(const Options& options, Streams streams);
ExitCode report_command(const Options& options, Streams streams);
ExitCode watch_command(const Options& options, Streams streams);
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
    auto* every = o.flag("--every-scene", o.options.every_scene, "write the headers of all scenes");
    o.add("--header", o.options.header, "file name of the header instead of NAME_SCENE.hpp")->excludes(every)->check(file_name);
    o.add("--fix", o.options.fix,
          "parameters that become numbers in the code: `parameters` for all, or names, each with =VALUE if it differs from the default");
    o.flag("--taylor", o.options.taylor, "add Taylor series of the motion, for the method taylor");
    for (const HeaderFunction& row : header_functions())
        if (row.in == HeaderFunction::In::wished)
            o.flag(flag_of(row.function), o.options.wished[row.function], fmt::format("add the function `{}`: {}", row.name, row.wish));
    o.format();
    o.explain("print time and result of each stage, and the expressions rewritten for accuracy");
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

void take_export(VerbOptions& o) {
    o.model();
    o.target();
    o.output();
    o.add("--fix", o.options.fix,
          "parameters that become numbers in the code: `parameters` for all, or names, each with =VALUE if it differs from the default");
    o.flag("--sources-only", o.options.sources_only, "write sources only, also for a target with compiled files");
    o.add("--mode", o.options.mode, "mode of a machine with modes, for a target that cannot switch");
    o.format();
    o.rewriting();
}

void take_report(VerbOptions& o) {
    o.files("MODELS", "model files; of several, index.html lists the pages");
    o.add("--scene", o.options.choice.scene, "scene of a single model; all of its scenes if left out");
    o.sizes("size of a family, as N=5");
    o.output();
    o.run("run of the page; `reference` or the only one if left out");
    o.cache();
    o.format();
}

void take_watch(VerbOptions& o) {
    o.model();
    o.run("run of the page; `reference` or the only one if left out");
    o.add("--port", o.options.port, "port of 127.0.0.1 at which the page is shown; 0: any that is free")
        ->capture_default_str()
        ->check(CLI::Range(0, 65535));
}

void take_check(VerbOptions& o) {
    o.files("FILES", "model files and catalogues");
    o.add("-o,--output", o.options.pages,
          "folder for book.html (every equation with its verdict) and errata.html; if left out, none is written");
    o.add("--scene", o.options.choice.scene, "scene of a model, if it has several");
    o.sizes("size of a family of a model, as N=5");
    o.format();
}

void take_evaluate(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.add("--time", o.options.time, "time, as 0.5 (in seconds) or 3ms; 0 if left out");
    o.add("--digits", o.options.digits, "significant digits of the results")->capture_default_str()->check(CLI::Range(1, 1000));
}

void take_simulate(VerbOptions& o) {
    o.model();
    o.settings();
    o.output();
    o.format();
    o.integration();
    o.plots();
    o.result_files();
    o.until();
    o.add("--sensitivities", o.options.sensitivities,
          "also write derivatives of states and outputs along the run: by parameters, and by start values of coordinates, velocities and "
          "states; names, comma separated")
        ->delimiter(',');
    o.flag("--second-order", o.options.second_order,
           "with --sensitivities: also write second derivatives, by differences of 14 runs for each name");
    o.cache();
    o.explain("print time and result of each stage, and the origin of the plant");
}

void take_equilibrium(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.add("--hold", o.options.hold, "states that keep their value, comma separated")->delimiter(',');
    o.add("--moving", o.options.moving,
          "coordinates that move at the constant speed of the start: the result is a steady motion; comma separated")
        ->delimiter(',');
    o.add("--free", o.options.free, "inputs that the search may change, comma separated")->delimiter(',');
    o.cache();
    o.explain("print time and result of each stage, and the origin of the plant");
}

void take_modal(VerbOptions& o) {
    o.model();
    o.settings();
    o.mode();
    o.format();
    o.run("run whose start is used; `reference` or the only one if left out");
    o.cache();
    o.explain("print time and result of each stage, and the origin of the plant");
}

void take_optimise(VerbOptions& o) {
    o.model();
    auto* maximise = o.add("--maximise", o.options.maximise, "output or state to be maximised");
    o.add("--minimise", o.options.minimise, "output or state to be minimised")->excludes(maximise);
    o.add("--over", o.options.over, "parameter with its range, as alpha=10deg:80deg")->required();
    o.add("--points", o.options.points, "number of values in the first scan")
        ->capture_default_str()
        ->check(CLI::Range(3, 10000));
    o.settings();
    o.format();
    o.integration();
    o.until("end of the run in seconds, if no event ends it earlier");
    o.cache();
}

void take_identify(VerbOptions& o) {
    o.model();
    o.add("--data", o.options.data, "CSV file of an experiment, with titles as `phi [deg]`; once for each experiment")->required();
    o.add("--fit", o.options.fit,
          "what is fitted, comma separated: parameters, start(STATE) in each experiment, offset(COLUMN) of a sensor, delay(INPUT)")
        ->required();
    o.add("--measured", o.options.measured, "columns to compare, comma separated; if left out, all that are outputs or states")
        ->delimiter(',');
    o.add("--noise", o.options.noise, "standard deviations of columns, as phi=0.2deg; if left out, estimated from the residuals");
    o.add("--hold", o.options.held_inputs,
          "inputs whose values in the data count up to the next time, comma separated; others change linearly")
        ->delimiter(',');
    o.add("--prior", o.options.priors, "what is known beforehand, as d_R=normal(0.3, 5 %): mean and standard deviation");
    o.one_of(o.add("--loss", o.options.loss, "how outliers count: none, huber or cauchy; none: as all other values")->capture_default_str(),
             {loss_names.begin(), loss_names.end()});
    o.add("--starts", o.options.starts, "number of starts: the values of the model, and random ones")
        ->capture_default_str()->check(CLI::Range(1, 10000));
    o.add("--seed", o.options.seed, "seed of the random starts")->capture_default_str();
    o.settings();
    o.output();
    o.format();
    o.run();
    o.fit_integration();
    o.no_plot();
    o.cache();
    o.explain("print time and result of each stage, and the origin of the plant");
}

void take_study(VerbOptions& o) {
    o.model(VerbOptions::Model::optional);
    o.add("--vary", o.options.vary,
          "parameters, start values of coordinates, velocities and states, and constant inputs, as \"m_W=normal(1, 5 %), d_R=0.1:1:10\": "
          "a grid LOW:HIGH:COUNT, or a distribution, which is cut off at the range of the model");
    o.add("--runs", o.options.runs, "number of runs, where distributions are varied");
    o.one_of(o.add("--sampling", o.options.sampling, "points of distributions: random, or of a Sobol sequence; the latter with --indices"),
             {"random", "sobol"});
    o.flag("--indices", o.options.indices,
           "compute first-order and total Sobol indices; the runs are in groups of two more than what is varied");
    o.add("--seed", o.options.seed, "seed of the points")->capture_default_str();
    o.add("--observe", o.options.observe,
          "what is kept of a run, as \"max(phi), end(s)^2, time(EVENT)\"; if left out, states and outputs at the end");
    o.add("--worst", o.options.worst, "how many runs with the smallest and with the largest values are listed")
        ->capture_default_str()->check(CLI::Range(0, 1000));
    o.add("--only", o.options.only, "number of a run that is made again; its CSV is that of simulate");
    o.add("--shard", o.options.shard,
          "part of the runs, as 2/3; if left out, the part that SLURM_ARRAY_TASK_ID and its companions say, or all");
    o.add("--merge", o.options.merge, "files of all shards, which become the file of the whole study; without a model");
    o.add("--jobs", o.options.jobs, "number of threads; if left out, one for each processor")->check(CLI::Range(1, 1024));
    o.settings();
    o.output();
    o.format();
    o.integration();
    o.until();
    o.flag("--no-plot", o.options.no_plot, "draw no histograms and scatter plots");
    o.cache();
}

void take_survey(VerbOptions& o) {
    o.files("MODELS", "model files");
    o.sizes("size of a family, as N=5, for the models that have it");
    o.flag("--every-scene", o.options.every_scene, "print a row for each scene, not only for the default one");
    o.output();
    o.format();
    o.integration();
    o.plots();
    o.cache();
}

void take_gallery(VerbOptions& o) {
    o.files("MODELS", "model files; the folder of each is its domain");
    o.add("--generated", o.options.generated,
          "folder of the headers DOMAIN/NAME_SCENE.hpp that the pages link to, and of the pictures gallery/NAME.svg; if left out, "
          "the folder of the pages");
    o.output();
    o.cache();
}

void take_effects(VerbOptions& o) {
    o.model();
    o.add("--against", o.options.against, "scene that the others are compared with; the one with most effects if left out");
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
    auto* scene = o.add("--scene", o.options.choice.scene,
                        "one scene; if left out, all scenes of a single model, or the default scenes of several models");
    o.flag("--every-scene", o.options.every_scene, "measure all scenes, also of several models")->excludes(scene);
    o.sizes("sizes of a family to measure, as N=10,N=20");
    o.one_of(o.add("--methods", o.options.methods, "methods to measure, comma separated; all, if left out")->delimiter(','),
             method_names());
    o.one_of(o.add("--arithmetics", o.options.arithmetics, "number types to measure, comma separated; all, if left out")->delimiter(','),
             {"float", "double", "long_double"});
    o.add("--budget", o.options.budget,
          "as '1 ms step, 20 us': find instead the most accurate method that computes this step in this time");
    o.add("--limit", o.options.limit, "seconds after which a run is stopped; the reference has twelve times as many")
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
    o.add("--points", o.options.test_points, "number of points for each number type")->capture_default_str()->check(CLI::Range(1, 1000000));
    o.add("--seed", o.options.seed, "seed of the random numbers")->capture_default_str();
    o.add("--limit", o.options.ulp_limit, "largest error in double that passes, in ulp beyond the condition")
        ->capture_default_str()->check(CLI::PositiveNumber);
    o.format();
    o.explain("print the expressions rewritten for accuracy");
    o.rewriting();
}

void take_scenes(VerbOptions& o) {
    o.model_alone();
    o.format();
}

void take_help(VerbOptions& o) {
    o.add("TOPIC", o.options.topic,
          "a page, verb, section, key, function, quantity, unit or error id: `errors`, `bodies`, `bodies.mass`, `atan2`");
    std::vector<std::string> formats{"text", "markdown", "html"};
    for (const InstalledText& text : installed_texts()) formats.emplace_back(text.format);
    o.format(std::move(formats));
    o.add("-o,--output", o.options.pages, "folder for all pages, as Markdown or HTML files; if left out, they are printed");
}

constexpr auto table = std::to_array<Verb>({
    {"new", "write a project to begin with: a model with comments, and a C++ program around it", new_command, take_new},
    {"derive", "print the equations of motion", derive_command, take_derive},
    {"generate", "write the C++ header", generate_command, take_generate},
    {"compile", "write the model as a plant: a shared library with a table of C functions, and the C header of this table", compile_command,
     take_compile},
    {"export", "write the model for another tool, with its exact derivatives", export_command, take_export},
    {"check", "prove derivations and check printed equations, of models (in every scene, or the chosen one) and of catalogues",
     check_command, take_check},
    {"evaluate", "print state derivative, outputs and energies at one point", evaluate_command, take_evaluate},
    {"simulate", "simulate a model or a compiled plant (FILE.so); write CSV and plots", simulate_command,
     take_simulate},
    {"equilibrium",
     "find an equilibrium (a steady state), its outputs and the linearisation there, with its eigenvalues and time constants",
     equilibrium_command, take_equilibrium},
    {"modal", "print eigenvalue, natural frequency, damping ratio and eigenvector of each mode, and the modal form, of a linear "
              "mechanical system or of the linearisation at its start; for a model without coordinates, as of heat, see equilibrium",
     modal_command,
     take_modal},
    {"optimise", "find the parameter that maximises or minimises an output at the end of a run", optimise_command, take_optimise},
    {"identify",
     "fit parameters, start values, offsets and delays to measured data, with error bars; write a parameter file, a page and CSV",
     identify_command, take_identify},
    {"study", "make many runs with varied parameters, start values and inputs; write a CSV with a row for each, statistics and plots",
     study_command, take_study},
    {"survey", "check, generate and simulate several models; print a table", survey_command, take_survey},
    {"gallery", "write gallery.html and GALLERY.md: a small plot, numbers, traits, verdicts and links for each of several models",
     gallery_command, take_gallery},
    {"report",
     "write NAME.html for each model: a page that shows the machine, its equations and proofs, and runs it; it needs nothing else",
     report_command, take_report},
    {"watch", "show the page of `report` in a browser of this computer, made anew whenever the model changes, and errors at their places",
     watch_command, take_watch},
    {"effects", "measure the cost of each scene and effect, and the error of leaving it out; write CSV and a plot", effects_command,
     take_effects},
    {"cost", "measure time against accuracy: every method in every number type, compared with a reference; write CSV and plots",
     cost_command,
     take_cost},
    {"accuracy", "measure the accuracy of the generated functions in float and double, against 100 digits at random and extreme points",
     accuracy_command, take_accuracy},
    {"scenes", "list the scenes of a model and their effects", scenes_command, take_scenes},
    {"help", "print the reference: of the model language, functions, quantities, units, verbs, errors, limits and JSON fields",
     help_command,
     take_help},
});

}  // namespace

std::span<const Verb> verbs() { return table; }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/library_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "plant/jumps_in_time.hpp"
#include "plant/library.hpp"
#include "plant/methods.hpp"
#include "text/diagnostic.hpp"
#include "text/guardian.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(Id id, std::string message) { throw Failure(Diagnostic{id, {}, std::move(message)}); }

/// The whole text as a number; nothing where it is none, or infinite.
std::optional<double> number_in(const std::string& text) {
    char* rest = nullptr;
    const double value = std::strtod(text.c_str(), &rest);
    return text.empty() || *rest != '\0' || !std::isfinite(value) ? std::nullopt : std::optional(value);
}

/// A library is one scene of one size, without runs and declared units: what asks for another is not passed over.
void refuse_options_of_models(const Options& options) {
    const auto only_of_models = [](bool is_given, const char* option) {
        if (is_given)
            refuse(Id::bad_option, fmt::format("'{}' is for models; a plant is one scene of one size, without runs, in SI", option));
    };
    only_of_models(!options.choice.scene.empty(), "--scene");
    only_of_models(!options.choice.sizes.empty(), "--size");
    only_of_models(!options.run.empty(), "--run");
    only_of_models(!options.parameter_files.empty(), "--parameters");
    only_of_models(options.periods > 0, "--periods");
    only_of_models(!options.sensitivities.empty(), "--sensitivities");
    only_of_models(options.second_order, "--second-order");
    only_of_models(options.units == "declared", "--units declared");
}

/// NAME=NUMBER, several with commas between them.
void set_numbers(const std::vector<std::string>& texts, const dalembert_quantity* table, std::size_t count, std::vector<double>& numbers,
                 const char* option, const dalembert_plant& plant) {
    for (const std::string& text : texts) {
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find(',', at), text.size());
            const std::string one = text.substr(at, end - at);
            at = end + 1;
            const std::size_t equals = one.find('=');
            const std::string name = one.substr(0, equals), number = equals == std::string::npos ? "" : one.substr(equals + 1);
            const auto value = number_in(number);
            if (!value)
                refuse(Id::bad_option,
                       fmt::format("'--{} {}' is not of the form NAME=NUMBER; the numbers of a plant are in SI", option, one));
            std::vector<std::string> known;
            for (std::size_t i = 0; i < count; ++i) known.emplace_back(table[i].name);
            const auto found = std::find(known.begin(), known.end(), name);
            if (found == known.end())
                refuse(Id::unknown_name, fmt::format("--{}: plant '{}' has no '{}'{}; there are {}", option, plant.name, name,
                                                     did_you_mean(name, known), quoted_list(known)));
            numbers[static_cast<std::size_t>(found - known.begin())] = *value;
        }
    }
}

PlantRun asked_for(const Options& options, const dalembert_plant& plant) {
    refuse_options_of_models(options);
    for (const char* name : {plant.name, plant.scene})
        if (*name == '\0' || std::string_view(name).find_first_of("/\\") != std::string_view::npos)
            refuse(Id::bad_plant, fmt::format("'{}', the name or scene of a plant, cannot be part of a file name", name));
    if (!options.inputs.empty() && plant.inputs_of_run != nullptr)
        refuse(Id::bad_option, fmt::format("plant '{}' was compiled with inputs of its own, so that --input has no effect", plant.name));
    PlantRun run;
    run.parameters.assign(plant.parameter_defaults, plant.parameter_defaults + plant.parameters);
    run.held_inputs.assign(plant.inputs, 0.0);
    run.start.assign(plant.start_values, plant.start_values + plant.states);
    set_numbers(options.parameters, plant.parameter_table, plant.parameters, run.parameters, "parameter", plant);
    set_numbers(options.inputs, plant.input_table, plant.inputs, run.held_inputs, "input", plant);
    // Start values may follow from parameters.
    const std::unique_ptr<void, void (*)(void*)> self(plant.create(), plant.destroy);
    if (self == nullptr) refuse(Id::bad_plant, fmt::format("plant '{}' cannot create an instance", plant.name));
    plant.set_parameters(self.get(), run.parameters.data());
    plant.start_state(self.get(), run.start.data());
    set_numbers(options.states, plant.state_table, plant.states, run.start, "state", plant);
    for (std::size_t i = 0; i < plant.states; ++i) {
        run.places.push_back(i);
        run.states.push_back({plant.state_table[i].name, plant.state_table[i].unit, i, false});
    }
    run.until = number_in(options.until).value_or(0);
    if (!(run.until > 0))
        refuse(Id::bad_option, fmt::format("a plant has no runs: give the end of the run with --until, as a number of seconds{}",
                                           options.until.empty() ? "" : ", not '" + options.until + "'"));
    run.method = options.method.empty() ? "automatic" : options.method;
    run.tolerance = options.tolerance > 0 ? options.tolerance : 1e-9;
    run.step = options.step;
    if (needs_step(run.method) && !(run.step > 0))
        refuse(Id::bad_option, fmt::format("method '{}' has a fixed step: give it with --step", run.method));
    if (options.samples > 0) run.intervals = static_cast<std::size_t>(options.samples);
    run.kinks = jump_times(plant, run.parameters, run.held_inputs, run.until);
    return run;
}

SimulationReport report_of(const Options& options, const dalembert_plant& plant, const PlantRun& run) {
    const PlantRunResult result = simulate_plant(plant, run);
    SimulationSettings settings;
    settings.until = run.until;
    settings.tolerance = run.tolerance;
    settings.step = run.step;
    settings.draw = !options.no_plot;
    settings.formats = options.write;
    for (const RecordedState& state : run.states) settings.plots.push_back({state.name, "", {state.name}, {}});
    SimulationReport report = report_of_run(result, plant, settings);
    if (result.outcome.guard < plant.guards) report.guard = plant.guard_table[result.outcome.guard].doc;
    if ((result.outcome.status == Status::constraint_broken || result.outcome.status == Status::singular_position) &&
        result.outcome.constraint < plant.constraints)
        report.constraint = plant.constraint_table[result.outcome.constraint].name;
    if ((result.outcome.status == Status::not_finite || result.outcome.status == Status::step_too_small) &&
        result.outcome.state < plant.states)
        report.culprit = plant.state_table[result.outcome.state].name;
    report.message = result.message;
    add_results(report, result, plant, settings, {}, fmt::format("{} ({})", plant.title, plant.scene), fs::path(options.output),
                fmt::format("{}_{}", plant.name, plant.scene));
    return report;
}

}  // namespace

bool is_library(const fs::path& file) { return file.extension() == ".so"; }

LibraryRun run_library(const Options& options) {
    const fs::path file = options.choice.model;
    // Another process runs it first: what ends that one does not end the program. A run that came to its end there is made again here.
    auto not_ending = Leftovers::all().hold();
    const pid_t child = ::fork();
    if (child < 0) refuse(Id::tool_failed, "the process for the plant cannot be started");
    if (child == 0) {
        ::setpgid(0, 0);
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(signal, SIG_DFL);
        const rlimit limit{static_cast<rlim_t>(stage_limits().seconds), RLIM_INFINITY};
        ::setrlimit(RLIMIT_CPU, &limit);
        try {
            const PlantLibrary library(file);
            simulate_plant(library.table(), asked_for(options, library.table()));
        } catch (...) {  // is told by the run that counts
        }
        ::_exit(0);
    }
    ::setpgid(child, child);
    Leftovers::all().add_child(child);
    not_ending.unlock();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    Leftovers::all().remove_child(child);
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        refuse(Id::bad_plant, signal == SIGXCPU ? fmt::format("the plant '{}' did not finish a call within {:g} s of processor time",
                                                              file.string(), stage_limits().seconds)
                                                : fmt::format("the plant '{}' crashed in a call: {}", file.string(), ::strsignal(signal)));
    }
    const PlantLibrary library(file);
    const dalembert_plant& plant = library.table();
    LibraryRun run{plant.name, plant.scene, report_of(options, plant, asked_for(options, plant))};
    run.report.plant = library.origin();
    return run;
}

}  // namespace dalembert

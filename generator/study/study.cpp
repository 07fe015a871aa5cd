// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "elements/model.hpp"
#include "read/reader.hpp"
#include "run/in_parallel.hpp"
#include "text/digest.hpp"
#include "text/files.hpp"
#include "text/guardian.hpp"
#include "text/version.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_runs = 10000000;

[[noreturn]] void refuse_study(const std::string& sentence) { throw Failure(Diagnostic{Id::bad_option, {}, sentence}); }

/// Of a model with its parts and data, one behind the other.
std::string text_of_files(const std::filesystem::path& model) {
    const FilesRead read;
    Diagnostics told_before;
    read_model(model, told_before);
    std::string text;
    for (const auto& [path, stamp] : read.files()) text += read_file(path);
    return text;
}

/// Tells models apart that were changed between two calls.
std::string digest_of(const std::string& text) { return fmt::format("{:016x}", digest(text)); }

nlohmann::ordered_json description(const Study& study, const Options& options, const std::vector<VariedQuantity>& varied,
                                   const std::vector<Observable>& observables) {
    const Scene& scene = study.runs().machine().system->scene;
    nlohmann::ordered_json json;
    json["dalembert"] = program_version;
    json["model"] = scene.model->name;
    json["digest"] = digest_of(text_of_files(options.choice.model));
    json["scene"] = scene.name;
    json["sizes"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.sizes) json["sizes"][name] = value;
    for (const auto& [name, text] : {std::pair{"run", &options.run}, {"until", &options.until}, {"method", &options.method}})
        if (!text->empty()) json[name] = *text;
    for (const auto& [name, number] : {std::pair{"tolerance", options.tolerance}, {"step", options.step}, {"periods", options.periods}})
        if (number != 0) json[name] = number;
    if (options.samples != 0) json["samples"] = options.samples;
    for (const auto& [name, texts] : {std::pair{"parameter", &options.parameters}, {"state", &options.states}, {"input", &options.inputs}})
        if (!texts->empty()) json[name] = *texts;
    for (const std::string& file : options.parameter_files) json["parameters"].push_back(digest_of(read_file(file)));
    json["vary"] = nlohmann::ordered_json::array();
    for (const VariedQuantity& one : varied) json["vary"].push_back(one.place.text());
    json["observe"] = nlohmann::ordered_json::array();
    for (const Observable& one : observables) json["observe"].push_back(one.name);
    json["sampling"] = study.design().sampling == Sampling::sobol ? "sobol" : "random";
    json["indices"] = study.design().has_indices;
    json["seed"] = study.design().seed;
    json["runs"] = study.design().runs;
    return json;
}

}  // namespace

Study::Study(const std::shared_ptr<const LoadedModel>& model, const Options& options) : runs_(model, options, "study") {
    const System& system = *runs_.machine().system;
    varied_ = read_varied(options.vary, system, runs_.values());
    observables_ = read_observables(options.observe, system);
    read_design(options);
    std::vector<const Variable*> variables;
    for (const VariedQuantity& one : varied_) variables.push_back(one.variable);
    runs_.vary(variables);
    bound_values();
    head_.study = description(*this, options, varied_, observables_.list);
    for (const VariedQuantity& one : varied_) head_.varied.push_back({one.name(), one.unit()});
    for (const Observable& one : observables_.list) head_.observed.push_back({one.name, one.unit});
    head_.shard = shard_of(options.shard, design_.runs);
}

void Study::read_design(const Options& options) {
    if (varied_.empty()) refuse_study("nothing is varied; give --vary NAME=LOW:HIGH:COUNT or --vary NAME=DISTRIBUTION");
    for (const VariedQuantity& one : varied_) design_.variations.push_back(one.variation);
    design_.has_indices = options.indices;
    design_.seed = options.seed;
    const bool is_sobol = options.sampling == "sobol" || (options.sampling.empty() && options.indices);
    design_.sampling = is_sobol ? Sampling::sobol : Sampling::random;
    const std::size_t random = design_.random_count();
    double points = 1;  // that a product of whole numbers could leave their range
    for (const Variation& one : design_.variations)
        if (const auto* axis = std::get_if<GridAxis>(&one)) points *= static_cast<double>(axis->count);
    if (points > static_cast<double>(most_runs))
        refuse_study(fmt::format("the grid has {:.4g} points; the limit is {}", points, most_runs));
    const auto grid = design_.grid_points();
    if (options.indices && random != varied_.size())
        refuse_study("--indices needs a distribution for all that is varied, and a grid has none; write uniform(low, high) instead");
    if (random == 0) {
        if (!options.sampling.empty()) refuse_study("--sampling is for distributions, but only grids are varied");
        if (options.runs != 0 && options.runs != grid)
            refuse_study(fmt::format("the grid has {} points, a run each, and --runs asks for {}; leave out --runs", grid, options.runs));
        design_.runs = grid;
        return;
    }
    if (options.runs == 0) refuse_study("the number of runs is missing, because distributions are varied; give --runs");
    if (options.runs > most_runs) refuse_study(fmt::format("--runs asks for {} runs; the limit is {}", options.runs, most_runs));
    const std::size_t together = grid * design_.group();
    if (options.runs % together != 0) {
        const std::size_t less = options.runs / together * together;
        const std::string why = options.indices
                                    ? fmt::format("--indices with {} varied quantities makes runs in groups of {}", random, together)
                                    : fmt::format("each of the {} grid points gets the same number of runs", grid);
        refuse_study(fmt::format("{}, and {} is no multiple of {}; give --runs {}{}", why, options.runs, together,
                                 less > 0 ? fmt::format("{} or ", less) : "", less + together));
    }
    design_.runs = options.runs;
}

/// The box that the values of all runs lie in.
void Study::bound_values() {
    std::vector<double> low(varied_.size(), std::numeric_limits<double>::infinity()), high(varied_.size(), -low.front());
    ValuesOfRuns values(design_);
    for (std::size_t run = 0; run < design_.runs; ++run) {
        const std::vector<double> at = values(run);
        for (std::size_t i = 0; i < at.size(); ++i) {
            low[i] = std::min(low[i], at[i]);
            high[i] = std::max(high[i], at[i]);
        }
    }
    runs_.stay_between(low, high);
}

PlantRunResult Study::simulated(std::size_t run) const { return simulate_plant(runs_.plant(), runs_(ValuesOfRuns(design_)(run))); }

RowOfRun Study::row(std::size_t run) const { return row_of(run, ValuesOfRuns(design_)(run)); }

RowOfRun Study::row_of(std::size_t run, std::vector<double> values) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    enter_stage("a run of a study");  // each has a budget of its own
    RowOfRun row{run, "", none, std::move(values), std::vector<double>(observables_.list.size(), none)};
    try {
        std::vector<double> observed = row.observed;
        const PlantRunResult result = observables_.observe(runs_.plant(), runs_(row.varied), observed);
        const System& system = *runs_.machine().system;
        const EventEquation* ends = event_that_ended(result.outcome, system);
        row.t = result.outcome.t;
        row.status = to_string(result.outcome.status);
        if (ends != nullptr)
            row.status = "ended by " + ends->name;
        else if (result.outcome.status == Status::event)
            row.status = "left the model at " + end_of_model(result.outcome, system).name;
        if (row.is_good()) row.observed = observed;
    } catch (const Failure& failure) {
        row.status = fmt::format("refused: {}", name_of(failure.diagnostics().front().id));
    }
    return row;
}

std::string Study::lines(std::size_t first, std::size_t count) const {
    ValuesOfRuns values(design_);
    std::string text;
    for (std::size_t run = first; run < first + count; ++run) text += line_of(row_of(run, values(run)));
    return text;
}

std::string Study::file_name() const {
    const Scene& scene = runs_.machine().system->scene;
    const std::string name = fmt::format("{}_{}_study", scene.sized_name(), scene.name);
    return head_.shard.is_whole() ? name + ".csv" : fmt::format("{}_{}_of_{}.csv", name, head_.shard.part, head_.shard.of);
}

Shard shard_of(const std::string& text, std::size_t runs) {
    const auto number = [](std::string_view written) {
        std::size_t value = 0;
        const auto end = std::from_chars(written.data(), written.data() + written.size(), value);
        return end.ec == std::errc() && end.ptr == written.data() + written.size() ? std::optional(value) : std::nullopt;
    };
    std::optional<std::size_t> part, of;
    if (text.empty()) {
        const char *id = std::getenv("SLURM_ARRAY_TASK_ID"), *count = std::getenv("SLURM_ARRAY_TASK_COUNT");
        if (id == nullptr || count == nullptr) return {};
        const char* least = std::getenv("SLURM_ARRAY_TASK_MIN");
        of = number(count);
        const auto place = number(id), from = number(least != nullptr ? least : "1");
        if (place && from && *place >= *from) part = *place - *from + 1;
        if (!part || !of || *part > *of)
            refuse_study(
                fmt::format("SLURM_ARRAY_TASK_ID={}, SLURM_ARRAY_TASK_MIN={} and SLURM_ARRAY_TASK_COUNT={} name no part of a study; number "
                            "the array without gaps, as --array=1-8, or give --shard",
                            id, least != nullptr ? least : "", count));
    } else {
        const std::size_t slash = text.find('/');
        if (slash != std::string::npos) {
            part = number(std::string_view(text).substr(0, slash));
            of = number(std::string_view(text).substr(slash + 1));
        }
        if (!part || !of || *part < 1 || *part > *of)
            refuse_study(fmt::format("'--shard {}' names no part of a study; write I/N with I from 1 to N, as in 2/3", text));
    }
    if (*of > runs) refuse_study(fmt::format("a study of {} runs cannot be divided into {} shards", runs, *of));
    return {*part, *of};
}

MakeRuns by_threads(std::size_t threads) {
    return [threads](const Study& study, std::size_t first, std::size_t last, const std::function<void(const std::string&)>& take) {
        const std::size_t blocks = (last - first + runs_of_block - 1) / runs_of_block;
        in_parallel(
            blocks,
            [&](std::size_t block) {
                const std::size_t from = first + block * runs_of_block;
                return study.lines(from, std::min(runs_of_block, last - from));
            },
            [&](std::size_t, const std::string& lines) { take(lines); }, threads);
    };
}

}  // namespace dalembert

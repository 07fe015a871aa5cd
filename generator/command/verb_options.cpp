// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/verb_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "command/project_kinds.hpp"
#include "plant/methods.hpp"
#include "export/target.hpp"
#include "graph/passes.hpp"
#include "run/result_files.hpp"
#include "text/budgets.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// "of the header: cpp (C++20), c (C99)": a name with its description for each row of a table.
template <class Rows>
std::pair<std::vector<std::string>, std::string> names_and_docs(const Rows& rows, std::string docs) {
    std::vector<std::string> names;
    for (const auto& row : rows) {
        docs += fmt::format("{} {} ({})", names.empty() ? "" : ",", row.name, row.doc);
        names.emplace_back(row.name);
    }
    return {names, docs};
}

}  // namespace

CLI::Option* VerbOptions::one_of(CLI::Option* option, std::vector<std::string> words) {
    given_.choices[option] = words;
    const std::string listed = fmt::format("{{{}}}", fmt::join(words, ","));
    const auto problem = [words = std::move(words)](const std::string& word) {
        if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
        return fmt::format("'{}' is not one of {}{}", word, quoted_list(words), did_you_mean(word, words));
    };
    return option->check(CLI::Validator(problem, listed));
}

void VerbOptions::model_alone(Model need) { verb_.add_option("MODEL", given_.model, "model file")->required(need == Model::required); }

void VerbOptions::model(Model need) {
    model_alone(need);
    verb_.add_option("--scene", options.choice.scene,
                     "scene, if the model has several; NAME+EFFECT adds an effect, NAME-EFFECT leaves one out");
    sizes("size of a family, as N=5");
}

void VerbOptions::sizes(const char* doc) { verb_.add_option("--size", given_.sizes, doc)->delimiter(','); }

void VerbOptions::output() {
    verb_.add_option("-o,--output", options.output, "folder for results; created if missing")->default_val(".");
}

void VerbOptions::format(std::vector<std::string> choices) {
    std::string doc;
    for (std::size_t i = 0; i < choices.size(); ++i) doc += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + choices[i];
    one_of(verb_.add_option("--format", options.format, doc)->capture_default_str(), std::move(choices));
}

void VerbOptions::settings() {
    verb_.add_option("--parameter", options.parameters,
                     "parameters, as m_W=1.2 or p=5bar, comma separated; a number without a unit counts in the declared one");
    verb_.add_option("--parameters", options.parameter_files,
                     "TOML file with values of parameters, as identify writes it; --parameter comes before it");
    verb_.add_option("--state", options.states, "states, coordinates and velocities, as s=0.55,dot(s)=-0.3");
    verb_.add_option("--input", options.inputs, "inputs, as f_e=4.5; for simulate, expressions of t and the states");
}

void VerbOptions::mode() {
    verb_.add_option("--mode", options.mode,
                     "mode of a machine with modes; if left out, the first, and in evaluate the first that accepts the state");
}
void VerbOptions::run(const char* doc) { verb_.add_option("--run", options.run, doc); }
void VerbOptions::until(const char* doc) { verb_.add_option("--until", options.until, doc); }

void VerbOptions::fit_integration() {
    verb_.add_option("--tolerance", options.tolerance, "relative tolerance of a step")->check(CLI::Range(1e-16, 0.5));
}
void VerbOptions::no_plot() { verb_.add_flag("--no-plot", options.no_plot, "draw nothing"); }

void VerbOptions::integration() {
    run();
    fit_integration();
    one_of(verb_.add_option("--method", options.method, methods_text()), method_names());
    verb_.add_option("--step", options.step, "step of a method with fixed step, in seconds")->check(CLI::PositiveNumber);
    verb_.add_option("--samples", options.samples, "number of intervals at which results are written")
        ->check(CLI::Range(1, budget::samples));
    verb_.add_option("--periods", options.periods, "length of the run in periods, if the run has a period")
        ->check(CLI::PositiveNumber);
}

void VerbOptions::cache() { verb_.add_flag("--no-cache", options.no_cache, "compile the plant again, and do not keep it"); }

void VerbOptions::result_files() {
    const auto [names, docs] = names_and_docs(result_formats(), "result files besides CSV, comma separated:");
    one_of(verb_.add_option("--write", options.write, docs)->delimiter(','), names);
}

void VerbOptions::plots() {
    verb_.add_flag("--no-plot", options.no_plot, "write the CSV only");
    one_of(verb_.add_option("--units", options.units,
                            "units of CSV and plots: declared (as in the model) or si; if left out, CSV is in SI and plots are in declared "
                            "units"),
           {"declared", "si"});
}

void VerbOptions::explain(const char* doc) { verb_.add_flag("--explain", options.explain, doc); }

void VerbOptions::dump() {
    one_of(verb_.add_option("--dump", options.dump, "print a stage instead: scene, equations, atoms or code"),
           {"scene", "equations", "atoms", "code"});
}

void VerbOptions::rewriting() {
    const auto [names, docs] = names_and_docs(all_passes, "passes to leave out, comma separated:");
    one_of(verb_.add_option("--without", options.without, docs)->delimiter(','), names);
    one_of(verb_.add_option("--trig", options.trig,
           "sine and cosine in float: from the library, or combined, from one reduction that takes the same time for every angle"),
           {"library", "combined"});
}

void VerbOptions::language() {
    const auto [names, docs] = names_and_docs(languages(), "language of the header:");
    one_of(verb_.add_option("--language", options.language, docs), names);
}

void VerbOptions::target() {
    const auto [names, docs] = names_and_docs(targets(), "tool that takes the export:");
    one_of(verb_.add_option("--to", options.target, docs)->required(), names);
}

void VerbOptions::kind() {
    const auto [names, docs] = names_and_docs(project_kinds, "kind of the project:");
    one_of(verb_.add_option("--kind", options.kind, docs)->default_val(names.front()), names);
}

}  // namespace dalembert

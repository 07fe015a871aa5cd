// SPDX-License-Identifier: GPL-3.0-or-later
// Options that verbs have on the command line: each is defined once, and a verb takes those it needs.
#pragma once

#include <CLI/CLI.hpp>

#include <map>

#include "run/options.hpp"

namespace dalembert {

/// Where the parser puts what was given.
struct Given {
    Options options;
    std::string model;               ///< file
    std::vector<std::string> sizes;  ///< "N=5"
    std::map<const CLI::Option*, std::vector<std::string>> choices;  ///< words that an option takes
};

class VerbOptions {
public:
    VerbOptions(CLI::App& verb, Given& given) : verb_(verb), given_(given), options(given.options) {}

private:
    CLI::App& verb_;
    Given& given_;

public:
    Options& options;  ///< that own options of a verb are written to

    /// An option or flag of this verb alone.
    template <class Value>
    CLI::Option* add(const char* name, Value& value, const char* doc) { return verb_.add_option(name, value, doc); }
    /// The option takes one of these words.
    CLI::Option* one_of(CLI::Option* option, std::vector<std::string> words);
    CLI::Option* flag(const std::string& name, bool& value, const std::string& doc) { return verb_.add_flag(name, value, doc); }
    /// File names that are written after the verb.
    void files(const char* name, const char* doc) { verb_.add_option(name, options.models, doc)->required(); }

    enum class Model { required, optional };
    void model_alone(Model need = Model::required);
    /// With scene and sizes.
    void model(Model need = Model::required);
    void sizes(const char* doc);
    void output();
    /// text and json, or what is given.
    void format(std::vector<std::string> choices = {"text", "json"});
    /// Parameters, states and inputs.
    void settings();
    void mode();
    void run(const char* doc = "run of the model; `reference` or the only one if left out");
    void until(const char* doc = "end of the run in seconds");
    void integration();
    /// Of fits, whose ends and samples the data give.
    void fit_integration();
    void no_plot();
    /// Of runs that are drawn.
    void plots();
    void result_files();
    /// Of what runs plants.
    void cache();
    void explain(const char* doc);
    void rewriting();
    void language();
    void target();
    /// Of projects.
    void kind();
    void dump();
};

}  // namespace dalembert

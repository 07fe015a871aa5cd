// SPDX-License-Identifier: GPL-3.0-or-later
// The way of a model through the program: one call a stage, value in, value out.
#pragma once

#include <filesystem>
#include <memory>
#include <set>

#include "elements/model.hpp"
#include "emit/header.hpp"
#include "scene/fix_parameters.hpp"
#include "prove/printed.hpp"

namespace dalembert {

/// What one run of the program is about.
struct Choice {
    std::filesystem::path model;
    std::string scene;                  ///< empty: the default
    std::map<std::string, int> sizes;
};

/// Time and result of each stage, for `--explain`.
struct StageReport {
    std::string stage;
    double seconds;
    std::string result;
};

/// A model that was read and checked. Its parts refer to each other, so it stays where it is.
struct LoadedModel {
    explicit LoadedModel(Model read) : model(std::move(read)), names(model) {}
    LoadedModel(const LoadedModel&) = delete;
    Model model;
    Names names;
};

/// A function that was asked for and cannot be made (bad-option).
class CannotMake : public Failure {
public:
    CannotMake(Function function, std::string reason, Diagnostic why)
        : Failure(std::move(why)), function_(function), reason_(std::move(reason)) {}
    Function function() const { return function_; }
    /// "'fin' has rods ...", for who did not ask by a flag.
    const std::string& reason() const { return reason_; }

private:
    Function function_;
    std::string reason_;
};

/// A derived and proven machine.
struct Machine {
    std::shared_ptr<const LoadedModel> loaded;
    std::unique_ptr<System> system;
    Audit audit;
    std::unique_ptr<Code> code;          ///< after generate
    std::unique_ptr<FieldCode> fields;   ///< after generate, where cells of rods are computed in loops
    std::vector<AuditEntry> emitted;     ///< after generate
    std::string no_series = {};          ///< after generate that would have made series where possible: why there are none
    std::vector<Machine> other_modes;    ///< of one that switches: the machine in its other modes; this one is in the first
    std::vector<StageReport> stages;
    Passes passes;                       ///< that generate makes
    Trig trig = Trig::library;
    const Language* language = &languages().front();
    std::set<Function> wished = {};      ///< of the functions that headers have where they are asked for
};

/// text -> model. Warnings go to diagnostics.
std::shared_ptr<const LoadedModel> load(const std::filesystem::path& path, Diagnostics& diagnostics);

/// model -> symbolic -> mechanics -> form -> prove. Throws Failure.
Machine derive_machine(std::shared_ptr<const LoadedModel> loaded, const std::string& scene, const std::map<std::string, int>& sizes,
                       const FixWish& fixed = {});

/// model -> form, in all modes, without proofs of the derivation: for what is checked against it. Parameters of the model from
/// `first_letter` on are in the scene although nothing of it needs them. Throws Failure.
std::vector<std::unique_ptr<System>> derive_systems(const LoadedModel& loaded, const std::string& scene, std::size_t first_letter);

/// Whether a header has Taylor series.
enum class SeriesWish {
    none,
    wanted,       ///< or Failure (no-series)
    if_possible,  ///< and not too large to be compiled soon
};

/// graph -> prove -> emit. Throws Failure when the code cannot be proven equal to the derivation, not even by numbers.
Header generate(Machine& machine, SeriesWish wish = SeriesWish::none);
/// After generate.
bool has_series(const Machine& machine);

/// What a machine computes at each instant: its right-hand side, or a sample of a controller.
Function main_function(const Machine& machine);

/// Of a function, in the mode that needs most. After generate.
OperationCount operations(const Machine& machine, Function function);

/// What was proven, in all modes. After generate.
Proofs proofs_of(const Machine& machine);

/// The command that the banner shows: model file name without path, options sorted.
std::string normalised_command(const Machine& machine);

}  // namespace dalembert

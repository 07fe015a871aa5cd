// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "elements/model.hpp"
#include "emit/failed_audits.hpp"
#include "form/hessian.hpp"
#include "form/fluid_validity.hpp"
#include "form/heat_validity.hpp"
#include "form/mode_systems.hpp"
#include "graph/series.hpp"
#include "check/checks.hpp"
#include "read/reader.hpp"
#include "elements/verdict.hpp"
#include "prove/body_validity.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/right_angles.hpp"
#include "prove/value_checks.hpp"
#include "symbolic/polynomial.hpp"
#include "text/budgets.hpp"
#include "text/guardian.hpp"

namespace dalembert {

namespace {

/// Notes how long each stage takes.
class Stopwatch {
public:
    explicit Stopwatch(std::vector<StageReport>& stages) : stages_(stages) {}
    void lap(const char* stage, std::string result) {
        const auto now = std::chrono::steady_clock::now();
        stages_.push_back({stage, std::chrono::duration<double>(now - last_).count(), std::move(result)});
        last_ = now;
    }

private:
    std::vector<StageReport>& stages_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Whatever GiNaC or CLN throw about numbers and poles, as a diagnostic of the model.
template <class Work>
auto guarded(const Model& model, Work work) {
    try {
        return work();
    } catch (const Failure&) {
        throw;
    } catch (const TooManyTerms&) {
        throw Failure(Diagnostic{Id::too_large, model.name_span,
                                 fmt::format("an expression in the code of model '{}', or a derivative of one, takes more than {:g} "
                                             "products of terms; use shorter expressions or a lower degree",
                                             model.name, budget::code_work)});
    } catch (const std::bad_alloc&) {
        throw Failure(Diagnostic{Id::too_large, model.name_span,
                                 fmt::format("the derivation of model '{}' needs more memory than there is", model.name)});
    } catch (const std::exception& error) {
        throw Failure(
            Diagnostic{Id::division_by_zero, model.name_span,
                       fmt::format("the derivation of model '{}' meets an expression that has no value: {}", model.name, error.what())});
    }
}

/// Measured: the derivation of a heat exchanger of 180 states takes a second, and grows with their square; that of mechanics grows faster.
void check_size(const Scene& scene) {
    const std::size_t states =
        2 * scene.coordinates.size() + scene.states.size();  // cells of fields are not counted: they are derived once
    if (scene.coordinates.size() > budget::coordinates)
        throw Failure(Diagnostic{Id::too_large, scene.model->name_span,
                                 fmt::format("scene '{}' has {} coordinates; this version derives at most {}", scene.name,
                                             scene.coordinates.size(), budget::coordinates)});
    if (states > budget::states)
        throw Failure(Diagnostic{Id::too_large, scene.model->name_span,
                                 fmt::format("scene '{}' has {} states; this version derives at most {}{}", scene.name, states,
                                             budget::states, scene.rods.empty() ? "" : ", not counting the cells of rods in loops")});
}

}  // namespace

std::shared_ptr<const LoadedModel> load(const std::filesystem::path& path, Diagnostics& diagnostics) {
    enter_stage(fmt::format("reading '{}'", path.filename().string()));
    auto loaded = std::make_shared<LoadedModel>(read_model(path, diagnostics));
    warn_of_unused(loaded->model, diagnostics);
    warn_of_vanishing(loaded->model, diagnostics);
    return loaded;
}

namespace {

/// Proves what was derived of a machine, in one of its modes if it has any.
void prove(Machine& machine, const std::shared_ptr<const LoadedModel>& loaded, std::unique_ptr<System> system) {
    machine.loaded = loaded;
    warn_of_stiff_junctions(*system);
    machine.system = std::move(system);
    Values defaults(machine.system->scene, machine.system->translate);  // which lie in their ranges
    check_fluid_values(*machine.system, defaults);
    check_heat_values(*machine.system, defaults);
    stop_on_unbalanced_mass(*machine.system);
    machine.audit = audit(*machine.system);
    stop_on_failed_audit(*machine.system, machine.audit);
    check_right_angles(*machine.system);
    meet_constraints(*machine.system, defaults);
    check_values(*machine.system, defaults);
}

bool all_derivations_proven(const Machine& machine) {
    return machine.audit.all_proven() && std::all_of(machine.other_modes.begin(), machine.other_modes.end(), all_derivations_proven);
}

[[noreturn]] void refuse_wish(const Machine& machine, Function function, const std::string& why) {
    const std::string reason = fmt::format("'{}' {}", machine.loaded->model.name, why);
    throw CannotMake(function, reason,
                     Diagnostic{Id::bad_option, machine.loaded->model.name_span, fmt::format("{}: {}", flag_of(function), reason)});
}

/// Throws Failure (bad-option) for a function that was asked for and cannot be made.
void check_wishes(const Machine& machine) {
    for (const Function function : machine.wished) {
        if (machine.fields)
            refuse_wish(machine, function,
                        "has rods with cells in loops, and each function has a loop of its own; a smaller size has code for each cell");
        if (!machine.code->wished.contains(function))
            refuse_wish(machine, function,
                        "has many bodies, whose motion is solved for in loops; second derivatives are made only where the solve is "
                        "written out");
    }
}

std::unique_ptr<Code> code_of(const Machine& machine, const CodeWish& wish) {
    const std::size_t parts = wish.functions.contains(Function::hessian) ? parts_of_motion(*machine.system) : 0;
    if (parts > budget::hessian_parts)
        refuse_wish(machine, Function::hessian,
                    fmt::format("has equations of motion of {} parts; second derivatives are made of up to {}", parts,
                                budget::hessian_parts));
    try {
        return make_code(*machine.system, wish);
    } catch (const NoDerivative& missing) {
        if (!wish.functions.contains(Function::hessian)) throw;
        refuse_wish(machine, Function::hessian,
                    fmt::format("needs the derivative of the function '{}', which this program does not have", missing.what()));
    }
}

CodeWish wish_of(const Machine& machine, bool with_series) {
    return {.passes = machine.passes, .series = with_series, .functions = machine.wished, .trig = machine.trig};
}

/// Rewritten code has to be proven as well as code in the form of the derivation is; else it is not taken.
void keep_proofs(Machine& machine, bool with_series) {
    const auto is_proven = [](const AuditEntry& entry) { return entry.result.verdict == Verdict::proven; };
    if (machine.code->rewritten.empty() || std::all_of(machine.emitted.begin(), machine.emitted.end(), is_proven)) return;
    CodeWish without_rewriting = wish_of(machine, with_series);
    without_rewriting.passes.rewriting = false;
    auto plain = make_code(*machine.system, without_rewriting);
    std::vector<AuditEntry> of_plain = verify(*plain);
    if (std::count_if(of_plain.begin(), of_plain.end(), is_proven) <=
        std::count_if(machine.emitted.begin(), machine.emitted.end(), is_proven))
        return;
    machine.code = std::move(plain);
    machine.emitted = std::move(of_plain);
}

void make_and_prove_code(Machine& machine, Stopwatch& watch, bool with_series) {
    const Scene& scene = machine.system->scene;
    const std::string name = scene.name + (scene.mode ? "', mode '" + scene.modes[*scene.mode].name : "");
    enter_stage(fmt::format("the code of scene '{}'", name));
    machine.code = code_of(machine, wish_of(machine, with_series));
    const OperationCount count = machine.code->count(main_function(machine));
    watch.lap("graph", fmt::format("{} operations in {}, {} cached values", count.total(), name_of(main_function(machine)),
                                     machine.code->cache.values().size()));
    enter_stage(fmt::format("the proof of the code of scene '{}'", name));
    machine.emitted = verify(*machine.code);
    keep_proofs(machine, with_series);
    if (!machine.system->heat.fields.empty()) {
        machine.fields = make_field_code(*machine.system);
        for (AuditEntry& entry : verify_fields(*machine.fields)) machine.emitted.push_back(std::move(entry));
    }
    for (const AuditEntry& entry : machine.emitted)
        if (entry.result.verdict == Verdict::wrong)
            throw Failure(
                Diagnostic{Id::not_equal, machine.loaded->model.name_span,
                           fmt::format("{} fails. This is a defect of the program; please report it with the model", entry.name)});
}

}  // namespace

namespace {

/// Series that are not there, or were not asked for at any price, are forgotten.
void keep_series(Machine& machine, const std::vector<Code*>& modes, SeriesWish wish) {
    constexpr int most_operations = 1000;  // beyond, compiling takes minutes
    std::optional<Diagnostic> why;
    if (machine.fields)
        why = Diagnostic{Id::no_series, machine.loaded->model.name_span,
                         "cells of rods that loops compute have no Taylor series; a smaller size has code for each cell"};
    for (const Code* code : modes) {
        if (why) break;
        if (const auto missing = missing_series(*code)) why = *missing;
        else if (wish == SeriesWish::if_possible && code->count(Function::rhs).total() > most_operations)
            why = Diagnostic{
                Id::too_large,
                {},
                fmt::format("its right-hand side has more than {} operations, and its series would take long to compile", most_operations)};
    }
    if (!why) return;
    if (wish == SeriesWish::wanted) throw Failure(*why);
    machine.no_series = why->message;
    for (Code* code : modes) code->series_of.reset();
}

}  // namespace

Machine derive_machine(std::shared_ptr<const LoadedModel> loaded, const std::string& scene_name, const std::map<std::string, int>& sizes,
                       const FixWish& fixed) {
    const Model& model = loaded->model;
    return guarded(model, [&] {
        Machine machine;
        Stopwatch watch(machine.stages);
        Scene scene = select_scene(model, loaded->names, resolve_scene(model, scene_name), sizes);
        fix_parameters(scene, loaded->names, fixed);
        check_size(scene);
        watch.lap("scene",
                  fmt::format("{} coordinates, {} states, {} inputs, {} parameters{}", scene.coordinates.size(), scene.states.size(),
                              scene.inputs.size(), scene.parameters.size(),
                              scene.modes.empty() ? "" : fmt::format(", {} modes, {} events", scene.modes.size(), scene.events.size())));
        enter_stage(fmt::format("the derivation of scene '{}'", scene.name));
        auto modes = derive_modes(loaded->names, scene);
        const System& first = *modes.front();
        watch.lap("derive", fmt::format("{} bodies, {} potentials, {} resistances, {} supplies{}", first.bodies.size(),
                                        first.potentials.size(), first.resistances.size(), first.supplies.size(),
                                        modes.size() == 1 ? "" : fmt::format(" in the first of {} modes", modes.size())));
        enter_stage(fmt::format("the proof of scene '{}'", first.scene.name));
        prove(machine, loaded, std::move(modes.front()));
        for (std::size_t i = 1; i < modes.size(); ++i) prove(machine.other_modes.emplace_back(), loaded, std::move(modes[i]));
        watch.lap("prove", all_derivations_proven(machine) ? "everything proven" : "some parts only numerically equal");
        return machine;
    });
}

std::vector<std::unique_ptr<System>> derive_systems(const LoadedModel& loaded, const std::string& scene_name, std::size_t first_letter) {
    const Model& model = loaded.model;
    return guarded(model, [&] {
        Scene scene = select_scene(model, loaded.names, resolve_scene(model, scene_name), {});
        check_size(scene);
        for (std::size_t i = first_letter; i < model.parameters.size(); ++i) {
            const Parameter& letter = model.parameters[i];
            if (std::any_of(scene.parameters.begin(), scene.parameters.end(), [&](const auto& member) { return member.item == &letter; }))
                continue;
            const auto [from, to] = letter.family ? bounds(*letter.family, scene) : std::pair(0, 0);
            for (int k = from; k <= to; ++k) scene.parameters.push_back({&letter, k});
        }
        return derive_modes(loaded.names, scene);
    });
}

Proofs proofs_of(const Machine& machine) {
    Proofs proofs{machine.audit, machine.emitted};
    for (const Machine& other : machine.other_modes) {
        const auto add = [](std::vector<AuditEntry>& all, const std::vector<AuditEntry>& more) {
            all.insert(all.end(), more.begin(), more.end());
        };
        add(proofs.derivation.derivations, other.audit.derivations);
        add(proofs.derivation.potentials, other.audit.potentials);
        add(proofs.derivation.media, other.audit.media);
        add(proofs.derivation.balances, other.audit.balances);
        add(proofs.derivation.constraints, other.audit.constraints);
        add(proofs.derivation.dissipation, other.audit.dissipation);
        add(proofs.derivation.loads, other.audit.loads);
        add(proofs.emitted, other.emitted);
        if (is_worse(other.audit.power_balance.result.verdict, proofs.derivation.power_balance.result.verdict))
            proofs.derivation.power_balance = other.audit.power_balance;
    }
    return proofs;
}

Function main_function(const Machine& machine) {
    return machine.system->scene.sampling != nullptr ? Function::sample : Function::rhs;
}

OperationCount operations(const Machine& machine, Function function) {
    OperationCount most = machine.code->count(function);
    for (const Machine& other : machine.other_modes)
        if (const OperationCount count = other.code->count(function); count.total() > most.total()) most = count;
    return most;
}

bool has_series(const Machine& machine) { return machine.code->series_of.has_value(); }

Header generate(Machine& machine, SeriesWish wish) {
    return guarded(machine.loaded->model, [&] {
        Stopwatch watch(machine.stages);
        std::vector<const Code*> modes;
        std::vector<Code*> all;
        make_and_prove_code(machine, watch, wish != SeriesWish::none);
        all.push_back(machine.code.get());
        for (Machine& other : machine.other_modes) {
            other.passes = machine.passes;
            other.trig = machine.trig;
            other.wished = machine.wished;
            make_and_prove_code(other, watch, wish != SeriesWish::none);
            all.push_back(other.code.get());
        }
        modes.assign(all.begin(), all.end());
        if (wish != SeriesWish::none) keep_series(machine, all, wish);
        check_wishes(machine);
        const Proofs proofs = proofs_of(machine);
        watch.lap("prove code", proofs.all_proven() ? "everything proven" : "some parts only numerically equal");
        const auto effects_out =
            sizes_of_effects_out(*machine.system, {machine.system->scene.sizes.begin(), machine.system->scene.sizes.end()});
        if (!effects_out.empty()) watch.lap("effects out", fmt::format("{} compared at the start", effects_out.size()));
        Header header = make_header(modes, machine.fields.get(), proofs, effects_out, normalised_command(machine), *machine.language);
        watch.lap("emit", fmt::format("{} bytes", header.text.size()));
        return header;
    });
}

std::string normalised_command(const Machine& machine) {
    const Scene& scene = machine.system->scene;
    const std::string file = std::filesystem::path(scene.model->source->name()).filename().string();
    std::string command = fmt::format("dalembert generate {} --scene {}", file, scene.wish);
    if (machine.language != &languages().front()) command += fmt::format(" --language {}", machine.language->name);
    std::string without;
    for (const Pass& pass : all_passes)
        if (!(machine.passes.*pass.is_on)) without += (without.empty() ? " --without " : ",") + std::string(pass.name);
    command += without;
    if (!scene.fix_text.empty())
        command += " --fix " + (scene.fix_text.find(' ') == std::string::npos ? scene.fix_text : "'" + scene.fix_text + "'");
    if (machine.trig == Trig::combined) command += " --trig combined";
    for (const auto& [name, value] : scene.sizes) command += fmt::format(" --size {}={}", name, value);
    if (machine.code && has_series(machine)) command += " --taylor";
    for (const Function function : machine.wished) command += " " + flag_of(function);
    return command;
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "run/run_header.hpp"
#include "run/run_preparation.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "program/function_bodies.hpp"
#include "emit/runner.hpp"
#include "form/state_places.hpp"
#include "prove/body_validity.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/statics_validity.hpp"
#include "prove/switching_validity.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// The name of a state by its place in x; of none, nothing.
std::string name_of_state(const System& system, std::size_t place) {
    const StatePlaces places = place_states(system);
    std::vector<std::string> names;
    for (const Variable* variable : system.symbols.state_variables()) names.push_back(variable->name);
    const auto found = std::find(places.positions.begin(), places.positions.end(), place);
    if (found != places.positions.end()) return names[static_cast<std::size_t>(found - places.positions.begin())];
    for (std::size_t f = 0; f < places.firsts.size(); ++f) {
        const RodField& field = system.heat.fields[f];
        if (place >= places.firsts[f] && place < places.firsts[f] + field.geometry.cells())
            return fmt::format("{}[{}]", field.states->name, place - places.firsts[f] + static_cast<std::size_t>(field.first_index));
    }
    return "";
}

/// Steps that are too long for the eye make a twentieth; steps that are controlled make some multiple of the tolerance, which grows with
/// the length of the run. Over 100 periods at 1e-12 all systems keep their energy to 1e-9: see tests/physics/energy.sh.
double energy_limit(const SimulationSettings& settings) {
    constexpr double coarse = 0.05, fine = 1e-6, multiple = 1000;
    return settings.step > 0 ? coarse : std::clamp(multiple * settings.tolerance, fine, coarse);
}

}  // namespace

std::string exact_roots(const Scene& scene) {
    std::string flows;
    for (const auto& member : scene.flows) {
        const Flow& flow = *member.item;
        const bool is_root = flow.law == Flow::Law::hydraulic_orifice || flow.law == Flow::Law::pneumatic_orifice ||
                             (flow.law == Flow::Law::check_valve && flow.area);
        if (is_root && !flow.width && !flow.switches) flows += fmt::format("{}'{}'", flows.empty() ? "" : ", ", member.name());
    }
    return flows;
}

std::string energy_warning(const PreparedSimulation& prepared, const SimulationReport& report) {
    const SimulationSettings& settings = prepared.settings;
    std::string cause;
    if (settings.step > 0) cause = fmt::format("steps of {:g} s are likely to be too long: try a shorter --step", settings.step);
    else if (settings.tolerance > 1e-7)
        cause = fmt::format("the tolerance of {:g} is likely to be too coarse: try --tolerance {:g}", settings.tolerance,
                            settings.tolerance / 1000);
    else if (!steps_freely(*prepared.machine.system, settings.inputs) && report.steps <= 2 * static_cast<std::size_t>(settings.intervals) &&
             report.rejected * 10 < report.steps)
        cause =
            fmt::format("something shorter than the steps of some {:.2g} s, a pulse or a jump, was likely stepped over: try more --samples",
                        report.t / static_cast<double>(std::max<std::size_t>(1, report.steps)));
    else if (const std::string roots = exact_roots(prepared.machine.system->scene); !roots.empty())
        cause = fmt::format(
            "near balance flows like a root, here {}, have fewer digits than the pressures: try a smaller --tolerance, or a `width` (a "
            "pressure)",
            roots);
    else
        cause =
            "something jumps that the steps do not see, or digits cancel: try a smaller --tolerance, and declare the jump as an event, a "
            "mode or a function of time with `step`, `pulse` or `if`";
    return fmt::format("the energy error of {:.2g} is above the limit of {:g}, so that the results are not to be trusted; {}",
                       report.energy_error, report.energy_limit, cause);
}

std::string scene_of_run(const Model& model, const std::string& run) {
    const Run* found = find_run(model, run);
    return found == nullptr ? "" : found->scene;
}

std::string scene_for_run(const Model& model, const Options& options) { return RunPreparation(model, options).scene(options.choice.scene); }

std::pair<Values, std::vector<ex>> start_of_run(const System& system, const Options& options) {
    const RunPreparation preparation(*system.scene.model, options);
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    check_body_values(system, values);
    meet_constraints_in_mode(system, values);
    return {values, preparation.inputs_at_start(values, system)};
}

PreparedRun prepare_run(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options, const char* verb,
                        bool tries_series) {
    const RunPreparation preparation(model->model, options);
    Machine machine = derive_machine(model, preparation.scene(scene), options.choice.sizes);
    const System& system = *machine.system;
    refuse_rest(system, verb);
    const SeriesWish wish = tries_series                       ? SeriesWish::if_possible
                            : preparation.method() == "taylor" ? SeriesWish::wanted
                                                               : SeriesWish::none;
    Header header = generate(machine, wish);
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    check_switching_values(system, values);
    meet_constraints(system, values);
    check_body_values(system, values);
    check_solid_values(system, values);
    SimulationSettings settings = preparation.make_settings(values, system);
    for (const Machine& other : machine.other_modes) {
        Values same(other.system->scene, other.system->translate);
        preparation.set_values(same, *other.system);
        const std::vector<double> kinks = preparation.make_settings(same, *other.system).kinks;
        settings.kinks.insert(settings.kinks.end(), kinks.begin(), kinks.end());
    }
    std::sort(settings.kinks.begin(), settings.kinks.end());
    settings.kinks.erase(std::unique(settings.kinks.begin(), settings.kinks.end()), settings.kinks.end());
    settings.series = has_series(machine) && (!tries_series || have_series(*machine.code, settings.inputs));
    std::string name = fmt::format("{}_{}", system.scene.sized_name(), system.scene.name);
    return {std::move(machine), std::move(header), std::move(values), std::move(settings), std::move(name)};
}

PreparedSimulation prepare_simulation(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options) {
    PreparedRun run = prepare_run(model, scene, options, "simulate");
    PreparedSimulation prepared;
    prepared.draw = run.settings.draw;
    prepared.settings = run.settings;
    prepared.source = simulation_source(*run.machine.code, run.header, run.values, run.settings);
    if (options.compares_scenes) prepared.cost = cost_source(*run.machine.code, run.header, run.values, run.settings);
    prepared.doubts = doubts_of_start(run.values, *run.machine.system);
    prepared.machine = std::move(run.machine);
    prepared.header = std::move(run.header);
    prepared.name = std::move(run.name);
    return prepared;
}

CostMeasurement::CostMeasurement(const PreparedSimulation& prepared) : folder_(std::make_unique<ScratchFolder>()) {
    compile_with_header(*folder_, prepared.header, prepared.cost, "-O2");
}

void CostMeasurement::measure() {
    const auto result = run_compiled(*folder_, {});
    nanoseconds_.push_back(std::stod(result.at("ns")));
    bytes_ = std::stoul(result.at("bytes"));
}

SimulationReport run_simulation(const PreparedSimulation& prepared, const std::filesystem::path& folder) {
    const ScratchFolder scratch;
    const std::filesystem::path base = std::filesystem::path(scratch.path()) / prepared.name;
    const auto result = run_with_header(scratch, prepared.header, prepared.source, {base.string()}, "-O2");
    SimulationReport report;
    report.status = result.at("status");
    report.t = std::stod(result.at("t"));
    report.events = std::stoul(result.at("events"));
    const auto& guards = prepared.machine.system->guards;
    if (const std::size_t guard = std::stoul(result.at("guard")); guard < guards.size() && prepared.machine.system->scene.modes.empty())
        report.guard = guards[guard].doc;
    report.steps = std::stoul(result.at("steps"));
    report.rejected = std::stoul(result.at("rejected"));
    report.rhs_calls = std::stoul(result.at("rhs_calls"));
    std::istringstream steps_by(result.at("steps_by"));
    for (const char* method : {"dopri5", "dop853", "rodas5p"}) {
        std::size_t steps = 0;
        if (steps_by >> steps && steps > 0) report.methods.emplace_back(method, steps);
    }
    report.energy_error = std::stod(result.at("energy_error"));
    report.energy_limit = energy_limit(prepared.settings);
    if (const auto step = result.find("euler_step"); step != result.end()) {
        const double value = std::stod(step->second);
        if (std::isfinite(value)) report.euler_step = value;
    }
    report.drawn = result.at("drawn") == "1";
    if (const auto lost = result.find("lost"); lost != result.end()) {
        report.lost = std::stod(lost->second);
        report.mode = result.at("mode");
        report.message = result.at("message");
        const auto& events = prepared.machine.system->events;
        const std::size_t event = std::stoul(result.at("guard"));
        report.ended = report.status == "event" && event < events.size() && events[event].item != nullptr && !events[event].item->is_limit;
        report.guard = event < events.size() && !report.ended && report.status == "event" ? events[event].doc : "";
        if (report.ended && !events[event].doc.empty()) report.message += ": " + events[event].doc;
    }
    if (report.status == "constraint broken" || report.status == "singular position")
        report.constraint = prepared.machine.system->constraints[std::stoul(result.at("constraint"))].item->name;
    if (report.status == "not finite" || report.status == "step too small") {
        report.culprit = name_of_state(*prepared.machine.system, std::stoul(result.at("state")));
    }
    report.files = {{folder / prepared.header.file_name, prepared.header.text},
                    {folder / (prepared.name + ".csv"), read_file(base.string() + ".csv")}};
    if (report.lost) report.files.emplace_back(folder / (prepared.name + "_events.csv"), read_file(base.string() + "_events.csv"));
    if (report.drawn)
        for (const char* ending : {".svg", ".png"})
            report.files.emplace_back(folder / (prepared.name + ending), read_file(base.string() + ending));
    return report;
}

}  // namespace dalembert

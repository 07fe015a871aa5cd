// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <dalembert/plot.hpp>

#include "elements/fluids.hpp"
#include "elements/runs.hpp"
#include "form/state_places.hpp"
#include "program/function_bodies.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "run/result_files.hpp"
#include "run/run_header.hpp"
#include "run/run_preparation.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "run/varied.hpp"

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
        const CellField& field = system.heat.fields[f];
        if (place >= places.firsts[f] && place < places.firsts[f] + field.cells)
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
    if (settings.step > 0)
        cause = fmt::format("steps of {:g} s are probably too long: try a shorter --step", settings.step);
    else if (settings.tolerance > 1e-7)
        cause = fmt::format("the tolerance of {:g} is probably too coarse: try --tolerance {:g}", settings.tolerance,
                            settings.tolerance / 1000);
    else if (prepared.run.seen_step == 0 && report.steps <= 2 * static_cast<std::size_t>(settings.intervals) &&
             report.rejected * 10 < report.steps)
        cause = fmt::format("the steps of about {:.2g} s probably skipped a shorter pulse or jump: try more --samples",
                            report.t / static_cast<double>(std::max<std::size_t>(1, report.steps)));
    else if (const std::string roots = exact_roots(prepared.machine.system->scene); !roots.empty())
        cause = fmt::format(
            "near equal pressures, flows with a square root, here {}, have fewer digits than the pressures: try a smaller --tolerance, or "
            "a `width` (a pressure)",
            roots);
    else
        cause =
            "the steps miss a jump, or digits cancel: try a smaller --tolerance, and declare the jump as an event, a mode or a function of "
            "time with `step`, `pulse` or `if`";
    return fmt::format("the energy error of {:.2g} is above the limit of {:g}, so do not trust the results; {}", report.energy_error,
                       report.energy_limit, cause);
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
    meet_constraints_in_mode(system, values);
    check_values(system, values);
    return {values, preparation.inputs_at_start(values, system)};
}

KinksOfRun kinks_of_run(const RunPreparation& preparation, const Machine& machine) {
    return [&](const auto& change) {
        std::vector<double> kinks;
        const auto add = [&](const System& mode) {
            Values same(mode.scene, mode.translate);
            preparation.set_values(same, mode);
            change(mode, same);
            const std::vector<double> some = preparation.make_settings(same, mode).kinks;
            kinks.insert(kinks.end(), some.begin(), some.end());
        };
        add(*machine.system);
        for (const Machine& other : machine.other_modes) add(*other.system);
        std::sort(kinks.begin(), kinks.end());
        kinks.erase(std::unique(kinks.begin(), kinks.end()), kinks.end());
        return kinks;
    };
}

Header generate_with_slopes(Machine& machine, std::string& without_outputs, SeriesWish wish) {
    if (!machine.system->outputs.empty()) machine.wished.insert(Function::output_jacobian_p);
    try {
        return generate(machine, wish);
    } catch (const CannotMake& refused) {
        without_outputs = refused.reason();
        machine.wished.erase(refused.function());
        return generate(machine, wish);
    }
}

PreparedRun prepare_run(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options, const char* verb,
                        bool tries_series) {
    if (options.second_order && options.sensitivities.empty())
        throw Failure(Diagnostic{Id::bad_option, {}, "--second-order needs --sensitivities, which says by what the run is differentiated"});
    const RunPreparation preparation(model->model, options);
    Machine machine = derive_machine(model, preparation.scene(scene), options.choice.sizes);
    const System& system = *machine.system;
    refuse_rest(system, verb);
    if (std::string_view(verb) != "simulate") refuse_samplers(system, verb);
    if (!options.sensitivities.empty()) refuse_samplers(system, "simulate --sensitivities");
    const SeriesWish wish = tries_series                       ? SeriesWish::if_possible
                            : preparation.method() == "taylor" ? SeriesWish::wanted
                                                               : SeriesWish::none;
    std::string without_slopes_of_outputs;
    Header header =
        options.sensitivities.empty() ? generate(machine, wish) : generate_with_slopes(machine, without_slopes_of_outputs, wish);
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    const Values unmet = values;
    meet_constraints(system, values);
    check_values(system, values);
    SimulationSettings settings = preparation.make_settings(values, system);
    const KinksOfRun kinks_of = kinks_of_run(preparation, machine);
    settings.kinks = kinks_of([](const System&, Values&) {});
    if (!system.scene.samplers.empty() && settings.method == "taylor")
        throw Failure(Diagnostic{Id::bad_option, system.scene.samplers.front()->span,
                                 fmt::format("the method taylor needs series of all inputs, and sampler '{}' sets one at its samples; "
                                             "choose another method",
                                             system.scene.samplers.front()->name)});
    const std::vector<NamedVariable> named = named_variables(options.sensitivities, system);
    std::vector<VariedOfRun> varied = varied_of_run(named, system, unmet, kinks_of);
    std::vector<MovedRuns> moved;
    if (options.second_order) moved = moved_runs(named, system, unmet, settings, kinks_of);
    settings.series = has_series(machine) && (!tries_series || have_series(*machine.code, settings.inputs));
    std::string name = fmt::format("{}_{}", system.scene.sized_name(), system.scene.name);
    return {std::move(machine),  std::move(header), std::move(values),
            std::move(settings), std::move(varied), std::move(moved),
            std::move(without_slopes_of_outputs), std::move(name)};
}

PreparedSimulation prepare_simulation(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options) {
    PreparedRun run = prepare_run(model, scene, options, "simulate");
    PreparedSimulation prepared;
    prepared.draw = run.settings.draw;
    prepared.settings = run.settings;
    const System& system = *run.machine.system;
    prepared.plant = source_of_plant(*run.machine.code, run.header, run.settings);
    prepared.run = run_of_plant(system, run.values, run.settings);
    prepared.controllers = prepare_controllers(system, run.values, run.settings.until);
    prepared.run.varied = std::move(run.varied);
    prepared.moved = std::move(run.moved);
    prepared.without_slopes_of_outputs = std::move(run.without_slopes_of_outputs);
    prepared.cache = plant_cache(options);
    prepared.units = shown_units(system);
    for (const PreparedController& controller : prepared.controllers)
        for (const ShownUnit& unit : shown_units(*controller.machine->system))
            if (controller.machine->system->symbols.find(SymbolKind::state, unit.column, 0) != nullptr) {
                prepared.units.push_back(unit);
                prepared.units.back().column = controller.sampler->name + "_" + unit.column;
            }
    const std::string title = system.scene.model->title.empty() ? system.scene.sized_name() : system.scene.model->title;
    prepared.title = fmt::format("{} ({})", title, system.scene.name);
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

namespace {

/// A number as reports show it: with so many digits.
double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

/// "t [s],event,from,to", a line each event.
std::string events_csv(const PlantRunResult& run, const dalembert_plant& plant) {
    std::string text = "t [s],event,from,to\n";
    for (const EventOfRun& e : run.events)
        text += fmt::format("{},{},{},{}\n", detail::number_text(e.t), plant.event_names[e.event], plant.mode_names[e.from],
                            e.to ? plant.mode_names[*e.to] : "");
    return text;
}

/// The same in the formats that were asked for.
void add_formats(SimulationReport& report, const PlantRunResult& run, const dalembert_plant& plant, const Recording& recording,
                 const std::vector<std::string>& wanted, const std::filesystem::path& folder, const std::string& name) {
    ResultTable table{recording, {}, {plant.mode_names, plant.mode_names + plant.modes}};
    for (const EventOfRun& e : run.events)
        table.events.push_back({e.t, plant.event_names[e.event], plant.mode_names[e.from], e.to ? plant.mode_names[*e.to] : ""});
    for (const ResultFormat& format : result_formats())
        if (std::find(wanted.begin(), wanted.end(), format.name) != wanted.end())
            report.files.emplace_back(folder / (name + format.suffix), format.write(table));
}

std::vector<Panel> panels_of(const std::vector<Plot>& plots) {
    std::vector<Panel> panels;
    for (const Plot& plot : plots) panels.push_back({plot.title, plot.x, plot.y});
    return panels;
}

/// How it ended, in words of the model.
/// "; in mode 'S_open' the current of inductor 'L_1' has no path": why an event leads to no mode.
std::string interrupted_currents(const Machine& machine, std::size_t event, const std::string& from) {
    const Scene& scene = machine.system->scene;
    std::string text;
    for (std::size_t mode = 0; mode < scene.modes.size(); ++mode) {
        if (scene.modes[mode].name != from) continue;
        for (const std::size_t to : scene.modes_after(machine.system->events[event].next(), mode)) {
            const System& system = to == 0 ? *machine.system : *machine.other_modes[to - 1].system;
            for (const BranchState& branch : system.circuit.branches)
                if (branch.is_cut_off)
                    text += fmt::format("; in mode '{}' the current of inductor '{}' has no path", scene.modes[to].name, branch.name);
        }
    }
    return text;
}

void name_end(SimulationReport& report, const PlantRunResult& run, const Machine& machine) {
    const System& system = *machine.system;
    const Outcome& outcome = run.outcome;
    if (outcome.guard < system.guards.size() && system.scene.modes.empty()) report.guard = system.guards[outcome.guard].doc;
    if (!system.scene.modes.empty()) {
        const std::size_t event = outcome.guard;
        const bool is_event = outcome.status == Status::event && event < system.events.size();
        report.message = run.message;
        report.ended = is_event && system.events[event].item != nullptr && !system.events[event].item->is_limit;
        report.guard = is_event && !report.ended ? system.events[event].doc : "";
        if (outcome.status == Status::no_mode && event < system.events.size())
            report.message += interrupted_currents(machine, event, report.mode);
        if (report.ended && !system.events[event].doc.empty()) report.message += ": " + system.events[event].doc;
    }
    if (outcome.status == Status::constraint_broken || outcome.status == Status::singular_position)
        report.constraint = system.constraints[outcome.constraint].item->name;
    if (outcome.status == Status::not_finite || outcome.status == Status::step_too_small)
        report.culprit = name_of_state(system, outcome.state);
}

}  // namespace

SimulationReport report_of_run(const PlantRunResult& run, const dalembert_plant& plant, const SimulationSettings& settings) {
    const Outcome& outcome = run.outcome;
    SimulationReport report;
    report.status = to_string(outcome.status);
    report.t = outcome.t;
    report.events = outcome.events;
    report.steps = outcome.steps;
    report.rejected = outcome.rejected;
    report.rhs_calls = outcome.rhs_calls;
    std::size_t method = 0;
    for (const char* name : {"dopri5", "dop853", "rodas5p"})
        if (const std::size_t steps = outcome.steps_by[method++]; steps > 0) report.methods.emplace_back(name, steps);
    report.energy_error = rounded(run.energy_error, 3);
    report.energy_limit = energy_limit(settings);
    if (plant.modes > 0) {
        report.lost = rounded(run.lost, 6);
        report.mode = plant.mode_names[run.mode];
    }
    return report;
}

void add_results(SimulationReport& report, const PlantRunResult& run, const dalembert_plant& plant, const SimulationSettings& settings,
                 const std::vector<ShownUnit>& units, const std::string& title, const std::filesystem::path& folder,
                 const std::string& name) {
    const ScratchFolder scratch;
    const std::string base = (std::filesystem::path(scratch.path()) / name).string();
    if (settings.draw) {
        const Recording drawn = settings.declared_plots ? for_plots(run.recording, units) : run.recording;
        report.drawn = draw(drawn, panels_of(settings.plots), title, base);
    }
    const Recording recording = settings.declared_csv ? in_units(run.recording, units) : run.recording;
    report.files.emplace_back(folder / (name + ".csv"), csv_text(recording));
    if (report.lost) report.files.emplace_back(folder / (name + "_events.csv"), events_csv(run, plant));
    add_formats(report, run, plant, recording, settings.formats, folder, name);
    if (report.drawn)
        for (const char* ending : {".svg", ".png"}) report.files.emplace_back(folder / (name + ending), read_file(base + ending));
}

namespace {

/// How far they go, and the file.
void add_sensitivities(SimulationReport& report, const PlantRunResult& run, const PreparedSimulation& prepared,
                       const std::filesystem::path& file) {
    const System& system = *prepared.machine.system;
    const Outcome& outcome = run.of_sensitivities;
    report.sensitivities.emplace();
    report.sensitivities->without_outputs = prepared.without_slopes_of_outputs;
    report.sensitivities->t = run.sensitivities.rows.empty() ? 0 : run.sensitivities.rows.back()[0];
    if (outcome.status == Status::not_finite && outcome.guard < system.events.size())
        report.sensitivities->reason =
            fmt::format("event '{}' only touches its zero there, and has no derivative behind it", system.events[outcome.guard].name);
    else if (outcome.status == Status::not_finite)
        report.sensitivities->reason = "a derivative of the rates is not finite there, as of a root at zero";
    else if (outcome.status != Status::success)
        report.sensitivities->reason = to_string(outcome.status);
    report.files.emplace_back(file, csv_text(run.sensitivities));
}

void add_second_order(SimulationReport& report, const PlantRunResult& run, const dalembert_plant& plant,
                      const PreparedSimulation& prepared, const std::filesystem::path& file) {
    report.second_order = second_order_of(plant, prepared.run.varied, run, prepared.moved);
    report.files.emplace_back(file, csv_text(report.second_order->recording));
}

}  // namespace

SimulationReport run_simulation(const PreparedSimulation& prepared, const std::filesystem::path& folder) {
    const PlantLibrary library(prepared.plant, prepared.cache);
    const LoadedControllers controllers(prepared.controllers, prepared.cache);
    PlantRun of_plant = prepared.run;
    of_plant.controllers = controllers.of_run();
    const PlantRunResult run = simulate_plant(library.table(), of_plant);
    SimulationReport report = report_of_run(run, library.table(), prepared.settings);
    report.plant = library.origin();
    if (prepared.run.is_of_heat && std::isfinite(run.euler_step)) report.euler_step = run.euler_step;
    name_end(report, run, prepared.machine);
    if (run.outcome.status == Status::no_start_mode) return report;  // no motion to record
    report.files.emplace_back(folder / prepared.header.file_name, prepared.header.text);
    add_results(report, run, library.table(), prepared.settings, prepared.units, prepared.title, folder, prepared.name);
    if (!prepared.run.varied.empty()) add_sensitivities(report, run, prepared, folder / (prepared.name + "_sensitivities.csv"));
    if (!prepared.moved.empty())
        add_second_order(report, run, library.table(), prepared, folder / (prepared.name + "_second_order.csv"));
    return report;
}

}  // namespace dalembert

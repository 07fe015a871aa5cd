// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include "report/json_output.hpp"
#include "run/optimum.hpp"
#include "run/repeated_run.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// "alpha=10deg:80deg"
struct SearchRange {
    ExpressionPtr parameter;
    ExpressionPtr low, high;
};

SearchRange read_over(const std::string& text, const System& system) {
    const std::size_t colon = text.find(':'), equals = text.find('=');
    if (colon == std::string::npos || equals == std::string::npos || colon < equals || text.find(':', colon + 1) != std::string::npos)
        throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("'--over {}' is not of the form PARAMETER=LOW:HIGH", text)});
    const std::string name = text.substr(0, equals + 1);
    const std::vector<Setting> ends = parse_settings({text.substr(0, colon), name + text.substr(colon + 1)}, "over");
    if (ends.size() != 2) throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("'--over {}' names more than one parameter", text)});
    // Both ends are values of the parameter like any other.
    for (const Setting& end : ends) {
        Values values(system.scene, system.translate);
        apply_settings(values, {end}, on_parameters, system);
    }
    return {ends[0].variable, value_of(ends[0], nothing, system.names), value_of(ends[1], nothing, system.names)};
}

const Variable& parameter_of(const Expression& named, const System& system) {
    const int index = named.children.empty() ? 0 : index_value(*named.children[0], system.scene, {});
    const Variable* found = system.symbols.find(SymbolKind::parameter, named.name, index);
    if (found == nullptr) throw Failure(Diagnostic{Id::unknown_name, named.span, fmt::format("'{}' is a family; one of its members can be varied", named.written())});
    return *found;
}

double number_of(const Expression& e, const System& system) {
    const Values defaults(system.scene, system.translate);
    const auto value = value_at(system.translate(e, {}).subs(defaults.substitution(), GiNaC::subs_options::no_pattern), {}, 30);
    if (!value) throw Failure(Diagnostic{Id::division_by_zero, e.span, "this has no value"});
    return cln::double_approx(*value);
}

/// "0.7423 rad (42.53 deg)": in SI, and as the model gives the parameter.
std::string with_units(double value, const Variable& parameter, int digits) {
    const Unit& unit = parameter.declared->unit;
    std::string text = fmt::format("{:.{}g}{}{}", value, digits, parameter.unit == "1" ? "" : " ", parameter.unit == "1" ? "" : parameter.unit);
    if (unit.is_coherent() || !is_zero(unit.offset)) return text;
    return text + fmt::format(" ({:.{}g} {})", value / (cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power)), digits, unit.written);
}

std::string unit_of(const std::string& wanted, const System& system) {
    if (wanted == "t") return "s";
    for (const OutputEquation& output : system.outputs)
        if (output.name == wanted) return output.unit == "1" ? "" : output.unit;
    for (const Variable* state : system.symbols.state_variables())
        if (state->recorded_name() == wanted) return state->is_root ? state->declared->unit.si() : state->unit == "1" ? "" : state->unit;
    return "";
}

const char* name_of(Optimum::Place place) {
    return place == Optimum::Place::inside ? "inside" : place == Optimum::Place::at_low ? "low" : "high";
}

}  // namespace

ExitCode optimise_command(const Options& options, Streams streams) {
    if (options.maximise.empty() == options.minimise.empty()) throw Failure(Diagnostic{Id::bad_option, {}, "what is to be found? Give either --maximise OUTPUT or --minimise OUTPUT"});
    const bool largest = !options.maximise.empty();
    const std::string& wanted = largest ? options.maximise : options.minimise;
    RepeatedRun run(loaded(options, streams), options, wanted);
    show_warnings(run.machine(), streams);
    const System& system = *run.machine().system;
    const SearchRange over = read_over(options.over, system);
    const Variable& parameter = parameter_of(*over.parameter, system);
    const double low = number_of(*over.low, system), high = number_of(*over.high, system);
    if (!(low < high))
        throw Failure(Diagnostic{Id::bad_option, over.low->span, fmt::format("the search for '{}' would begin at {} and end at {}; it begins at the smaller one", parameter.name, with_units(low, parameter, 6), with_units(high, parameter, 6))});

    run.compile();
    OptimumSearch found{};
    RepeatedRun::End end{}, coarser{};
    try {
        const auto value = [&](double p) { return (largest ? 1 : -1) * run(*over.parameter, p).value; };
        found = find_maximum(value, low, high, static_cast<std::size_t>(options.points));
        end = run(*over.parameter, found.best.at);
        coarser = run(*over.parameter, found.best.at, RepeatedRun::Care::coarse);
    } catch (const RunStopped& stopped) {
        streams.err << fmt::format("dalembert: {}, scene {}: {}\n", system.scene.sized_name(), system.scene.name, stopped.what());
        return ExitCode::run_stopped;
    }
    if (found.is_constant)
        throw Failure(Diagnostic{Id::bad_option, over.parameter->span, fmt::format("'{}' at the end of the run is {:.6g} for every '{}' of the scan, so that none is best", wanted, end.value, parameter.name)});

    // Of every step a rounding, which do not all add up.
    const double rounding = 4 * std::sqrt(end.steps) * std::numeric_limits<double>::epsilon() * std::fabs(end.value);
    const double error = std::fabs(end.value - coarser.value) + rounding;
    std::optional<double> curvature, loses_a_percent;
    double accuracy = found.resolution;
    if (found.curvature && *found.curvature < 0) {
        curvature = (largest ? 1 : -1) * *found.curvature;
        // A slope is known to the error of two values by the step between them.
        accuracy = found.step ? found.last_shift + 2 * error / (*found.step * std::fabs(*curvature)) : std::max(accuracy, std::sqrt(2 * error / std::fabs(*curvature)));
        loses_a_percent = std::sqrt(0.02 * std::fabs(end.value / *curvature));
    }
    if (found.best.place != Optimum::Place::inside) accuracy = 0;
    const char* superlative = largest ? "largest" : "smallest";
    if (found.best.place != Optimum::Place::inside)
        streams.err << fmt::format("dalembert: warning: '{}' is {} at the {} end of the range of '{}'; beyond it there may be better ones\n", wanted, superlative, found.best.place == Optimum::Place::at_low ? "lower" : "upper", parameter.name);
    for (const Optimum& other : found.others)
        streams.err << fmt::format("dalembert: warning: '{}' has another local optimum, {:.6g} at {} = {}\n", wanted, (largest ? 1 : -1) * other.value, parameter.name, with_units(other.at, parameter, 6));

    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("optimise", system.scene);
        json["goal"] = largest ? "maximise" : "minimise";
        json["output"] = wanted;
        json["parameter"] = parameter.name;
        json["low"] = low;
        json["high"] = high;
        json["value"] = end.value;
        json["value_error"] = error;
        json["at"] = found.best.at;
        json["at_error"] = accuracy;
        json["place"] = name_of(found.best.place);
        json["second_derivative"] = curvature ? nlohmann::ordered_json(*curvature) : nlohmann::ordered_json();
        json["t"] = end.t;
        json["event"] = end.event;
        json["evaluations"] = found.evaluations;
        json["others"] = nlohmann::ordered_json::array();
        for (const Optimum& other : found.others) json["others"].push_back({{"at", other.at}, {"value", (largest ? 1 : -1) * other.value}, {"place", name_of(other.place)}});
        streams.out << printed(json);
        return ExitCode::good;
    }
    const std::string unit = unit_of(wanted, system), spaced = unit.empty() ? "" : " " + unit;
    std::string text = fmt::format("{}, scene {}: {} is {} with\n", system.scene.sized_name(), system.scene.name, wanted, superlative);
    text += fmt::format("  {:<12} {}, {}\n", parameter.name, with_units(found.best.at, parameter, 10), accuracy > 0 ? fmt::format("within {:.1e}", accuracy) : "an end of the range");
    text += fmt::format("  {:<12} {:.15g}{}, within {:.1e}; at t = {:.6g} s, {}\n", wanted, end.value, spaced, error, end.t, end.event.empty() ? "the end of the run" : fmt::format("where '{}' ends the run", end.event));
    if (curvature) text += fmt::format("  {:<12} its second derivative by {} is {:.6g}; a percent is lost {} away\n", "", parameter.name, *curvature, with_units(*loses_a_percent, parameter, 3));
    text += fmt::format("  {:<12} {} runs, {} of them at steps from {} to {}\n", "", found.evaluations, options.points, with_units(low, parameter, 6), with_units(high, parameter, 6));
    streams.out << text;
    return ExitCode::good;
}

}  // namespace dalembert

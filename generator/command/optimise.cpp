// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/optimise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "command/write_result.hpp"
#include "run/recorded_columns.hpp"
#include "run/repeated_run.hpp"
#include "run/settings.hpp"
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
    if (found == nullptr)
        throw Failure(Diagnostic{Id::unknown_name, named.span, fmt::format("'{}' is a family; name the member to vary", named.written())});
    return *found;
}

double number_of(const Expression& e, const System& system) {
    const Values defaults(system.scene, system.translate);
    const auto value = value_at(system.translate(e, {}).subs(defaults.substitution(), GiNaC::subs_options::no_pattern), {}, 30);
    if (!value) throw Failure(Diagnostic{Id::division_by_zero, e.span, "the expression has no value"});
    return cln::double_approx(*value);
}

VariedParameter shown(const Variable& parameter) {
    VariedParameter result{parameter.name, parameter.unit == "1" ? "" : parameter.unit};
    const Unit& unit = parameter.declared->unit;
    if (unit.is_coherent() || !is_zero(unit.offset)) return result;
    result.declared_unit = unit.written;
    result.of_declared = cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power);
    return result;
}

std::string unit_of(const std::string& wanted, const System& system) {
    for (const RecordedColumn& column : recorded_columns(system))
        if (column.name == wanted) return column.unit;
    return "";
}

/// What was found, and the run there: at usual care and at less, which shows the error.
struct OptimumFound {
    OptimumSearch search;
    RepeatedRun::End end, coarser;
};

OptimumFound search(const RepeatedRun& run, const OptimiseResult& wanted) {
    const auto value = [&](double p) { return (wanted.is_largest ? 1 : -1) * run(p).value; };
    OptimumSearch found = find_maximum(value, wanted.low, wanted.high, static_cast<std::size_t>(wanted.points));
    const double at = found.best.at;
    return {std::move(found), run(at), run(at, RepeatedRun::Care::coarse)};
}

void fill(OptimiseResult& result, const OptimumFound& found) {
    const int sign = result.is_largest ? 1 : -1;
    const RepeatedRun::End& end = found.end;
    result.value = end.value;
    // Of every step a rounding, which do not all add up.
    const double rounding = 4 * std::sqrt(end.steps) * std::numeric_limits<double>::epsilon() * std::fabs(end.value);
    result.value_error = std::fabs(end.value - found.coarser.value) + rounding;
    const OptimumSearch& search = found.search;
    result.at = search.best.at;
    result.at_error = search.resolution;
    if (search.curvature && *search.curvature < 0) {
        const double curvature = sign * *search.curvature;
        result.second_derivative = curvature;
        // A slope is known to the error of two values by the step between them.
        result.at_error = search.step ? search.last_shift + 2 * result.value_error / (*search.step * std::fabs(curvature))
                                      : std::max(result.at_error, std::sqrt(2 * result.value_error / std::fabs(curvature)));
        result.loses_a_percent = std::sqrt(0.02 * std::fabs(end.value / curvature));
    }
    result.place = search.best.place;
    if (result.place != Optimum::Place::inside) result.at_error = 0;
    result.t = end.t;
    result.event = end.event;
    result.evaluations = search.evaluations;
    for (const Optimum& other : search.others) result.others.push_back({other.at, sign * other.value, other.place});
}

}  // namespace

ExitCode optimise_command(const Options& options, Streams streams) {
    if (options.maximise.empty() == options.minimise.empty())
        throw Failure(Diagnostic{Id::bad_option, {}, "the goal is missing; give either --maximise OUTPUT or --minimise OUTPUT"});
    const bool is_largest = !options.maximise.empty();
    const std::string& wanted = is_largest ? options.maximise : options.minimise;
    RepeatedRun run(loaded(options, streams), options, wanted);
    show_warnings(run.machine(), streams);
    const System& system = *run.machine().system;
    const SearchRange over = read_over(options.over, system);
    OptimiseResult result{.subject = subject_of(system.scene), .is_largest = is_largest, .output = wanted, .unit = unit_of(wanted, system),
                          .parameter = shown(parameter_of(*over.parameter, system))};
    result.low = number_of(*over.low, system);
    result.high = number_of(*over.high, system);
    result.points = options.points;
    if (!(result.low < result.high))
        throw Failure(Diagnostic{
            Id::bad_option, over.low->span,
            fmt::format("the search for '{}' would begin at {} and end at {}; give the smaller value first", result.parameter.name,
                        with_units(result.low, result.parameter, 6), with_units(result.high, result.parameter, 6))});
    run.compile(parameter_of(*over.parameter, system));
    std::optional<OptimumFound> found;
    try {
        found = search(run, result);
    } catch (const RunStopped& stopped) {
        streams.err << fmt::format("dalembert: {}, scene {}: {}\n", result.subject.sized_name, result.subject.scene, stopped.what());
        return ExitCode::run_stopped;
    }
    if (found->search.is_constant)
        throw Failure(Diagnostic{Id::bad_option, over.parameter->span,
                                 fmt::format("'{}' at the end of the run is {:.6g} for every '{}' of the scan, so none is best", wanted,
                                             found->end.value, result.parameter.name)});
    fill(result, *found);
    streams.err << warnings_of(result);
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert

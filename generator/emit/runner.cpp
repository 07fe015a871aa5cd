// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "program/function_bodies.hpp"
#include "cpp/helpers.hpp"
#include "cpp/print.hpp"
#include "text/safe_text.hpp"
#include "balance/steps.hpp"
#include "text/template.hpp"
#include "form/state_places.hpp"
#include "graph/lower.hpp"
#include "language/parser.hpp"
#include "check/written_values.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::string double_literal(const ex& value) {
    const auto number = value_at(value, {}, 40);
    if (!number) throw Failure(Diagnostic{Id::division_by_zero, {}, "a start value or parameter has no value"});
    const std::string text = fmt::format("{}", cln::double_approx(*number));
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string double_literal(double value) {
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string parameter_statements(const Symbols& symbols, const Values& values) {
    std::string text;
    const auto& parameters = symbols.all(SymbolKind::parameter);
    std::map<std::string, int> position;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Variable& p = parameters[i];
        const std::string member = p.is_member ? fmt::format("{}[{}]", p.base, position[p.base]++) : p.base;
        text += fmt::format("    p_.{} = {};\n", member, double_literal(values.parameter(i)));
    }
    return text;
}

template <class Number>
std::string joined(const std::vector<Number>& values) {
    std::vector<std::string> texts;
    for (const Number& value : values) texts.push_back(double_literal(value));
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// u[i] = ... for every input that is not zero.
std::string input_statements(Code& code, const std::vector<ex>& inputs) {
    std::vector<Polynomial> polynomials;
    for (const ex& input : inputs) polynomials.push_back(lower(code.system.symbols.without_definitions(input), code.atoms));
    FunctionCode f;
    ProgramBuilder builder(code.atoms, code.cache, ParameterParts::in_place, f.program, code.passes);
    builder.prepare(polynomials);
    for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(i));
    const CachedValues none;
    StatementMaker cpp(code, f, none, {"x", "t", "u", "p_"});
    Statements statements = cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        if (f.is_zero(f.results[i])) continue;
        const Value value = cpp.value(f.results[i], statements);
        statements.push_back(Assignment{Value::element(Value::name("u"), i), value});
    }
    return cpp_body(statements);
}

/// What makes inputs of a function, given as a lambda, and series of them: texts that stand before and behind it.
struct InputSeriesTexts {
    std::string before, after;
};
InputSeriesTexts input_series_texts(Code& code, const SimulationSettings& settings, const std::string& captures,
                                    const std::string& scalar) {
    if (!settings.series || settings.inputs.empty()) return {};
    const InputSeries series = input_series(code, settings.inputs);
    return {
        fmt::format("dalembert::with_series<{}>(", series.rows),
        fmt::format(
            ", [{0}]([[maybe_unused]] const auto* x, [[maybe_unused]] {1} t, typename System::Input& u, [[maybe_unused]] {1}* rows) {{\n"
            "        using Scalar = {1};\n        namespace detail = dalembert::detail;\n{2}        (void)u;\n"
            "        return [=]([[maybe_unused]] std::size_t k) {{\n            typename System::Input u_now{{}};\n{3}            return "
            "u_now;\n        }};\n    }})",
            captures, scalar, cpp_body(series.start), shifted(cpp_text(series.step)))};
}

/// Columns and values of the states as the model calls them: what is integrated as its root is recorded as itself.
std::pair<std::string, std::string> recorded_states(const System& system) {
    const Symbols& symbols = system.symbols;
    const StatePlaces places = place_states(system);
    std::vector<std::string> columns;
    std::vector<std::string> values;
    for (const Variable* each : symbols.state_variables()) {
            const Variable& variable = *each;
            const std::string x = fmt::format("x[{}]", places.positions[values.size()]);
            const bool is_root = variable.is_root;
            columns.push_back(fmt::format("{{{}, {}}}", cpp_string(is_root ? variable.recorded_name() : variable.name),
                                          cpp_string(is_root ? variable.declared->unit.si() : variable.unit)));
            values.push_back(is_root ? x + " * " + x : x);
        }
    return {fmt::format("{}", fmt::join(columns, ", ")), fmt::format("{}", fmt::join(values, ", "))};
}

/// What is recorded in a declared unit that is not SI.
std::string shown_units(const System& system) {
    std::vector<std::string> names;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system.symbols.all(kind)) names.push_back(variable.recorded_name());
    for (const OutputEquation& output : system.outputs) names.push_back(output.name);
    std::string text;
    for (const std::string& name : names) {
        const auto unit = declared_unit(*parse_expression(excerpt_of(std::make_shared<const Source>("recording", name))), system.names);
        if (!unit || unit->is_coherent()) continue;
        text += fmt::format("{}{{{}, {}, {}, {}}}", text.empty() ? "" : ", ", cpp_string(name), cpp_string(unit->written),
                            double_literal(cln::double_approx(unit->factor) * std::pow(std::numbers::pi, unit->pi_power)),
                            double_literal(cln::double_approx(unit->offset)));
    }
    return text;
}

std::string start_statements(const System& system, const Values& values) {
    const StatePlaces places = place_states(system);
    const std::vector<ex> state = values.state();
    std::string text;
    for (std::size_t i = 0; i < state.size(); ++i)
        text += fmt::format("    start[{}] = {};\n", places.positions[i], double_literal(state[i]));
    return text;
}

std::string flags(const std::vector<bool>& values) {
    std::vector<std::string> texts;
    for (const bool value : values) texts.emplace_back(value ? "true" : "false");
    return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

bool steps_freely(const System& system, const std::vector<ex>& inputs) {
    if (!system.guards.empty() || !system.scene.modes.empty() || !system.heat.fields.empty() || !system.motion.multipliers.empty())
        return false;
    const Motion& motion = system.motion;
    std::vector<ex> acting = inputs;
    acting.insert(acting.end(), motion.residual.begin(), motion.residual.end());
    acting.insert(acting.end(), system.state_rates.begin(), system.state_rates.end());
    for (const auto& [coordinate, acceleration] : motion.accelerations) acting.push_back(acceleration);
    for (const ConstraintEquation& c : system.constraints) acting.push_back(c.whole_rate);
    return std::none_of(acting.begin(), acting.end(), [&](const ex& e) { return e.has(system.symbols.time()); });
}

std::string simulation_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings) {
    std::string panels;
    for (const Plot& plot : settings.plots) {
        std::vector<std::string> names;
        for (const std::string& name : plot.y) names.push_back(cpp_string(name));
        panels += fmt::format("\n        {{{}, {}, {{{}}}}},", cpp_string(plot.title), cpp_string(plot.x), fmt::join(names, ", "));
    }
    const Scene& scene = code.system.scene;
    const auto [state_columns, state_values] = recorded_states(code.system);
    const InputSeriesTexts series = input_series_texts(code, settings, "&", "double");
    const std::string title = scene.model->title.empty() ? scene.sized_name() : scene.model->title;
    std::map<std::string, std::string> values_of{
        {"NAMESPACE", header.name_space},
        {"HEADER", header.file_name},
        {"PARAMETERS", parameter_statements(code.system.symbols, values)},
        {"START", start_statements(code.system, values)},
        {"STATE_COLUMNS", state_columns},
        {"STATE_VALUES", state_values},
        {"INPUTS", input_statements(code, settings.inputs)},
        {"INPUTS_BEGIN", series.before},
        {"INPUTS_END", series.after},
        {"METHOD", settings.method},
        {"TOLERANCE", double_literal(settings.tolerance)},
        {"STEP", double_literal(settings.step)},
        {"INTERVALS", std::to_string(settings.intervals)},
        {"UNTIL", double_literal(settings.until)},
        {"KINKS", settings.kinks.empty() ? "" : fmt::format("    options.kinks = {{{}}};\n", joined(settings.kinks))},
        {"PANELS", panels},
        {"UNITS", shown_units(code.system)},
        {"CSV", settings.declared_csv ? "shown" : "recording"},
        {"PLOTTED", settings.declared_plots ? "shown" : "recording"},
        {"DRAW", settings.draw ? "true" : "false"},
        {"TITLE", cpp_string(fmt::format("{} ({})", title, scene.name))}};
    if (!scene.modes.empty()) return fill_template(embedded_file("switching.cpp.in"), values_of);
    values_of["FREE_STEPS"] =
        steps_freely(code.system, settings.inputs) ? "    options.max_step = 0.0;  // nothing acts in between that steps could miss\n" : "";
    // Of heat the bound of explicit methods is what one asks for first (4.99).
    const bool has_heat = !code.system.heat.empty();
    values_of["EXTRA_INCLUDES"] = has_heat ? "#include \"dalembert/euler_step.hpp\"\n" : "";
    values_of["EXTRA_RESULTS"] =
        has_heat ? "    std::printf(\"euler_step=%.17g\\n\", dalembert::largest_euler_step(system, begin, inputs(begin, 0.0), 0.0));\n"
                 : "";
    values_of["BEGIN"] = has_heat ? "    const System::State begin = start;\n" : "";
    return fill_template(embedded_file("simulation.cpp.in"), values_of);
}

std::string repeated_source(Code& code, const Header& header, const SimulationSettings& settings, const std::string& wanted) {
    const System& system = code.system;
    const auto [state_columns, state_values] = recorded_states(system);
    std::string parameters, start;
    std::map<std::string, std::size_t> position;
    for (const Variable& p : system.symbols.all(SymbolKind::parameter))
        parameters += fmt::format("    p_.{} = next();\n", p.is_member ? fmt::format("{}[{}]", p.base, position[p.base]++) : p.base);
    for (const std::size_t place : place_states(system).positions) start += fmt::format("    start[{}] = next();\n", place);
    const bool switches = !system.scene.modes.empty();
    const InputSeriesTexts series = input_series_texts(code, settings, "&", "double");
    return fill_template(embedded_file("repeated.cpp.in"), {{"NAMESPACE", header.name_space},
                                                            {"HEADER", header.file_name},
                                                            {"MODE", switches ? "System::Mode{}, " : ""},
                                                            {"PARAMETERS", parameters},
                                                            {"START", start},
                                                            {"STATE_COLUMNS", state_columns},
                                                            {"STATE_VALUES", state_values},
                                                            {"INPUTS", input_statements(code, settings.inputs)},
                                                            {"INPUTS_BEGIN", series.before},
                                                            {"INPUTS_END", series.after},
                                                            {"METHOD", settings.method},
                                                            {"WANTED", cpp_string(wanted)}});
}

std::vector<std::string> repeated_arguments(const System& system, const Values& values, const SimulationSettings& settings) {
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < system.symbols.count(SymbolKind::parameter); ++i) arguments.push_back(double_literal(values.parameter(i)));
    for (const ex& value : values.state()) arguments.push_back(double_literal(value));
    for (const double number : {settings.until, settings.tolerance, settings.step, static_cast<double>(settings.intervals)})
        arguments.push_back(double_literal(number));
    for (const double kink : settings.kinks) arguments.push_back(double_literal(kink));
    return arguments;
}

std::string cost_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings) {
    return fill_template(embedded_file("cost.cpp.in"),
                         {{"NAMESPACE", header.name_space},
                          {"MODE_CALL", code.system.scene.modes.empty() ? "" : "static_cast<System::Mode>(mode), "},
                          {"MODE_COUNT", std::to_string(std::max<std::size_t>(1, code.system.scene.modes.size()))},
                          {"HEADER", header.file_name},
                          {"PARAMETERS", parameter_statements(code.system.symbols, values)},
                          {"START", start_statements(code.system, values)},
                          {"INPUTS", input_statements(code, settings.inputs)}});
}

std::string work_precision_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings,
                                  const std::vector<std::string>& arithmetics) {
    std::vector<std::string> outputs;
    for (std::size_t i = 0; i < code.system.outputs.size(); ++i) outputs.push_back(fmt::format("y[{}]", i));
    std::vector<std::string> types;
    for (const std::string& name : arithmetics)
        types.push_back(name == "long_double" ? "long double"
                        : name == "digits50"
                            ? "boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>"
                            : name);
    const InputSeriesTexts series = input_series_texts(code, settings, "p_ = system.parameters()", "Number");
    const bool has_digits = std::find(arithmetics.begin(), arithmetics.end(), "digits50") != arithmetics.end();
    return fill_template(embedded_file("work_precision.cpp.in"),
                         {{"NAMESPACE", header.name_space},
                          {"HEADER", header.file_name},
                          {"EXTRA_INCLUDES", has_digits ? "#include <boost/multiprecision/cpp_bin_float.hpp>\n" : ""},
                          {"ARITHMETICS", fmt::format("{}", fmt::join(types, ", "))},
                          {"PARAMETERS", parameter_statements(code.system.symbols, values)},
                          {"START", start_statements(code.system, values)},
                          {"INPUTS", input_statements(code, settings.inputs)},
                          {"INPUTS_BEGIN", series.before},
                          {"INPUTS_END", series.after},
                          {"UNTIL", double_literal(settings.until)},
                          {"KINKS", joined(settings.kinks)},
                          {"VALUES", outputs.empty() ? recorded_states(code.system).second : fmt::format("{}", fmt::join(outputs, ", "))}});
}

std::vector<std::string> compared_columns(const System& system) {
    std::vector<std::string> names;
    for (const OutputEquation& output : system.outputs) names.push_back(output.name);
    if (names.empty())
        for (const Variable* state : system.symbols.state_variables()) names.push_back(state->recorded_name());
    return names;
}

namespace {

/// The type of the system, in its mode where it has some.
std::string system_type(const Code& code, const Header& header) {
    const Scene& scene = code.system.scene;
    return scene.mode
               ? fmt::format("dalembert::OneMode<{0}::System<double>, {0}::Mode::{1}>", header.name_space, scene.modes[*scene.mode].name)
               : header.name_space + "::System<double>";
}

/// `rows` at the state `at`: G dx = 0 of the constraints that hold. The header knows them where it projects; else integration keeps the
/// constraints exactly, and the rows are numbers at `values`. Where these would change with the state, and may not, there are none.
std::string constraint_rows(const System& system, const Values& values, const std::string& at, bool may_change) {
    const Symbols& symbols = system.symbols;
    const bool any = std::any_of(system.constraints.begin(), system.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
    if (any && system.needs_projection()) return fmt::format("    const auto rows = dalembert::constraint_rows(system, {}, 0.0);\n", at);
    const std::size_t n = symbols.degrees();
    std::string entries;
    std::size_t row = 0;
    const auto set = [&](const char* matrix, std::size_t column, const ex& entry) {
        const auto number = value_at(symbols.without_definitions(entry), values.substitution(), 40);
        if (number && !cln::zerop(*number))
            entries += fmt::format("    rows.{}({}, {}) = {};\n", matrix, row, column, double_literal(cln::double_approx(*number)));
    };
    bool changes = false;
    for (const ConstraintEquation& c : system.constraints) {
        if (!c.holds || !symbols.attitudes().empty()) continue;
        for (std::size_t j = 0; j < n; ++j) {
            const ex by_q = symbols.along(c.whole_rate, j);
            changes = changes || !is_of_parameters(by_q, symbols);
            if (c.position) set("of_positions", j, c.rate.jacobian[j]);
            set("of_rates", j, by_q);
            set("of_rates", n + j, c.rate.jacobian[j]);
        }
        ++row;
    }
    if (row == 0 || (changes && !may_change)) return "    const dalembert::ConstraintRows<double> rows;\n";
    return fmt::format(
               "    dalembert::ConstraintRows<double> rows{{dalembert::Matrix<double>::Zero({0}, {1}), "
               "dalembert::Matrix<double>::Zero({0}, {2})}};\n",
               row, n, symbols.state_variables().size()) +
           entries;
}

}  // namespace

std::string modal_source(const Code& code, const Header& header, const Values& values, const std::vector<ex>& x,
                         const std::vector<ex>& inputs) {
    const System& system = code.system;
    const bool is_held =
        std::any_of(system.constraints.begin(), system.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
    return fill_template(
        embedded_file("modal.cpp.in"),
        {{"NAMESPACE", header.name_space},
         {"SYSTEM", system_type(code, header)},
         {"HEADER", header.file_name},
         {"PARAMETERS", parameter_statements(system.symbols, values)},
         {"START", joined(x)},
         {"INPUTS", joined(inputs)},
         {"INCLUDES", is_held ? "#include \"dalembert/reduced_motions.hpp\"\n" : ""},
         {"REDUCTION",
          is_held ? constraint_rows(system, values, "x", true) +
                        "    const auto reduced = dalembert::reduced_motions(system, x, u, 0.0, rows);\n    print_reduction(reduced);\n"
                        "    const dalembert::LinearSystem& linear = reduced.system;\n"
                  : "    const auto linear = dalembert::linear_system(system, x, u, 0.0);\n"},
         {"PRINT_REDUCTION", is_held ? std::string(embedded_file("reduction.cpp.in")) : ""}});
}

std::string equilibrium_source(const Code& code, const Header& header, const Values& values, const std::vector<GiNaC::ex>& x,
                               const std::vector<bool>& free_states, const std::vector<bool>& free_inputs,
                               const std::vector<bool>& moving) {
    return fill_template(embedded_file("equilibrium.cpp.in"), {{"NAMESPACE", header.name_space},
                                                               {"SYSTEM", system_type(code, header)},
                                                               {"HEADER", header.file_name},
                                                               {"PARAMETERS", parameter_statements(code.system.symbols, values)},
                                                               {"START", joined(x)},
                                                               {"INPUTS", joined(values.inputs())},
                                                               {"FREE_STATES", flags(free_states)},
                                                               {"FREE_INPUTS", flags(free_inputs)},
                                                               {"MOVING", flags(moving)},
                                                               {"ROWS", constraint_rows(code.system, values, "found.x", false)}});
}

}  // namespace dalembert

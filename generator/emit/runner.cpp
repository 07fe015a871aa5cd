// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "balance/steps.hpp"
#include "cpp/helpers.hpp"
#include "cpp/print.hpp"
#include "cpp/tables.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "emit/value_statements.hpp"
#include "form/jacobian.hpp"
#include "form/state_places.hpp"
#include "graph/lower.hpp"
#include "program/function_bodies.hpp"
#include "program/plant_tables.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/map_functions.hpp"
#include "text/diagnostic.hpp"
#include "text/template.hpp"

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

/// "m_W", or "phi[2]" of a family: the members of the struct of parameters.
std::vector<std::string> parameter_members(const Symbols& symbols) {
    std::vector<std::string> members;
    std::map<std::string, int> position;
    for (const Variable& p : symbols.all(SymbolKind::parameter))
        members.push_back(p.is_member ? fmt::format("{}[{}]", p.base, position[p.base]++) : p.base);
    return members;
}

std::string parameter_statements(const Symbols& symbols, const Values& values) {
    std::string text;
    const std::vector<std::string> members = parameter_members(symbols);
    for (std::size_t i = 0; i < members.size(); ++i)
        text += fmt::format("    p_.{} = {};\n", members[i], double_literal(values.parameter(i)));
    return text;
}

template <class Number>
std::string joined(const std::vector<Number>& values) {
    std::vector<std::string> texts;
    for (const Number& value : values) texts.push_back(double_literal(value));
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// u[i] = ... for every input that is not zero.
std::string input_statements(Code& code, const std::vector<ex>& inputs) { return cpp_body(value_statements(code, inputs, "u")); }

/// du/dx, a column of inputs for each state as it is stored, and behind it du/dp; empty where one has no derivative.
std::vector<ex> slopes_of_inputs(const System& system, const std::vector<ex>& inputs) {
    const std::vector<const Variable*> states = column_variables(system.symbols, By::state),
                                       parameters = column_variables(system.symbols, By::parameter);
    const StatePlaces places = place_states(system);
    std::vector<ex> slopes((states.size() + parameters.size()) * inputs.size(), 0);
    try {
        for (std::size_t j = 0; j < inputs.size(); ++j) {
            for (std::size_t i = 0; i < states.size(); ++i)
                slopes[places.positions[i] * inputs.size() + j] = by_column(system, inputs[j], *states[i]);
            for (std::size_t i = 0; i < parameters.size(); ++i)
                slopes[(states.size() + i) * inputs.size() + j] = by_column(system, inputs[j], *parameters[i]);
        }
    } catch (const NoDerivative&) {
        return {};
    }
    return slopes;
}

/// Tables of curves, as inputs find them. They must have been lowered.
std::string curves_of_inputs(const Code& code, const std::vector<ex>& inputs) {
    const auto calls = [](const ex& input) {
        bool found = false;
        for (auto part = input.preorder_begin(); part != input.preorder_end(); ++part) found = found || !points_of_call(*part).empty();
        return found;
    };
    if (std::none_of(inputs.begin(), inputs.end(), [&](const ex& input) { return calls(code.system.symbols.without_definitions(input)); }))
        return "";
    return "#include \"dalembert/curve_functions.hpp\"\n\nnamespace dalembert {\ninline namespace v1 {\nnamespace detail {\n\n" +
           cpp_curves(curve_tables({&code})) + "}  // namespace detail\n}  // namespace v1\n}  // namespace dalembert\n";
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

/// Values of the states as the model calls them: what is integrated as its root is recorded as itself.
std::string recorded_states(const System& system) {
    const StatePlaces places = place_states(system);
    std::vector<std::string> values;
    for (const Variable* variable : system.symbols.state_variables()) {
        const std::string x = fmt::format("x[{}]", places.positions[values.size()]);
        values.push_back(variable->is_root ? x + " * " + x : x);
    }
    return fmt::format("{}", fmt::join(values, ", "));
}

std::string start_statements(const System& system, const Values& values) {
    const StatePlaces places = place_states(system);
    const std::vector<ex> state = values.state();
    std::string text;
    for (std::size_t i = 0; i < state.size(); ++i)
        text += fmt::format("    start[{}] = {};\n", places.positions[i], double_literal(state[i]));
    return text;
}

}  // namespace

std::string controller_source(const System& controller, const Header& header) {
    const bool is_float = controller.scene.sampling->numbers == ControllerSampling::Numbers::floats;
    const char* numbers = is_float ? "float" : "double";
    std::string set;
    const std::vector<std::string> members = parameter_members(controller.symbols);
    for (std::size_t i = 0; i < members.size(); ++i) set += fmt::format("        p_.{} = {}(numbers[{}]);\n", members[i], numbers, i);
    return fill_template(
        embedded_file("controller_plant.cpp.in"),
        {{"NAMESPACE", header.name_space}, {"HEADER", header.file_name}, {"NUMBERS", numbers}, {"SET_PARAMETERS", set}});
}

std::string plant_source(Code& code, const Header& header, const SimulationSettings& settings) {
    std::string set, get;
    const std::vector<std::string> members = parameter_members(code.system.symbols);
    for (std::size_t i = 0; i < members.size(); ++i) {
        set += fmt::format("        p_.{} = numbers[{}];\n", members[i], i);
        get += fmt::format("        numbers[{}] = p_.{};\n", i, members[i]);
    }
    const bool has_inputs = !settings.inputs.empty();
    const InputSeriesTexts series = input_series_texts(code, settings, "&p_", "double");
    std::string inputs = has_inputs ? input_statements(code, settings.inputs) : "";
    if (!inputs.empty()) inputs = "        namespace detail = dalembert::detail;  // pi, sign, min and max of the inputs\n" + inputs;
    const std::vector<ex> slopes = has_inputs ? slopes_of_inputs(code.system, settings.inputs) : std::vector<ex>();
    std::string slopes_function;
    if (!slopes.empty())
        slopes_function = fmt::format(
            "    static void input_slopes([[maybe_unused]] const {}::Parameters<double>& p_, [[maybe_unused]] const System::State& x,\n"
            "                             [[maybe_unused]] double t, [[maybe_unused]] double* slopes) {{\n"
            "        namespace detail = dalembert::detail;\n        using Scalar = double;\n"
            "        [[maybe_unused]] const auto& parameters = p_;\n{}    }}\n",
            header.name_space, cpp_body(value_statements(code, slopes, "slopes")));
    std::string includes = has_inputs ? "#include \"dalembert/scalar_functions.hpp\"\n" : "";
    if (!series.before.empty()) includes += "#include \"dalembert/series.hpp\"\n";
    includes += curves_of_inputs(code, settings.inputs);
    return fill_template(embedded_file("plant.cpp.in"), {{"NAMESPACE", header.name_space},
                                                         {"HEADER", header.file_name},
                                                         {"INCLUDES", includes},
                                                         {"SET_PARAMETERS", set},
                                                         {"GET_PARAMETERS", get},
                                                         {"HAS_INPUTS", has_inputs ? "true" : "false"},
                                                         {"INPUTS", inputs},
                                                         {"INPUTS_BEGIN", series.before},
                                                         {"INPUTS_END", series.after},
                                                         {"INPUT_SLOPES", slopes_function}});
}

std::string cost_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings) {
    const std::string inputs = input_statements(code, settings.inputs);
    return fill_template(embedded_file("cost.cpp.in"),
                         {{"NAMESPACE", header.name_space},
                          {"EXTRA_INCLUDES", curves_of_inputs(code, settings.inputs)},
                          {"MODE_CALL", code.system.scene.modes.empty() ? "" : "static_cast<System::Mode>(mode), "},
                          {"MODE_COUNT", std::to_string(std::max<std::size_t>(1, code.system.scene.modes.size()))},
                          {"HEADER", header.file_name},
                          {"PARAMETERS", parameter_statements(code.system.symbols, values)},
                          {"START", start_statements(code.system, values)},
                          {"INPUTS", inputs}});
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
    const std::string inputs = input_statements(code, settings.inputs);
    return fill_template(embedded_file("work_precision.cpp.in"),
                         {{"NAMESPACE", header.name_space},
                          {"HEADER", header.file_name},
                          {"EXTRA_INCLUDES", (has_digits ? "#include <boost/multiprecision/cpp_bin_float.hpp>\n" : "") +
                                                 curves_of_inputs(code, settings.inputs)},
                          {"ARITHMETICS", fmt::format("{}", fmt::join(types, ", "))},
                          {"PARAMETERS", parameter_statements(code.system.symbols, values)},
                          {"START", start_statements(code.system, values)},
                          {"INPUTS", inputs},
                          {"INPUTS_BEGIN", series.before},
                          {"INPUTS_END", series.after},
                          {"UNTIL", double_literal(settings.until)},
                          {"KINKS", joined(settings.kinks)},
                          {"VALUES", outputs.empty() ? recorded_states(code.system) : fmt::format("{}", fmt::join(outputs, ", "))}});
}

std::vector<std::string> compared_columns(const System& system) {
    std::vector<std::string> names;
    for (const OutputEquation& output : system.outputs) names.push_back(output.name);
    if (names.empty())
        for (const Variable* state : system.symbols.state_variables()) names.push_back(state->recorded_name());
    return names;
}

}  // namespace dalembert

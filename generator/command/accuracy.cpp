// SPDX-License-Identifier: GPL-3.0-or-later
// How many digits the generated functions have.
#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "run/accuracy_measurement.hpp"
#include "report/json_output.hpp"
#include "run/shared.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

std::string written(double error) { return std::isinf(error) ? "infinite" : fmt::format("{:.3g}", error); }

/// Of all modes those lines that matter: a function is called by its mode where there are some.
std::string title(const FunctionAccuracy& f) { return f.mode.empty() ? f.name : f.name + " in " + f.mode; }

std::string exact_text(const cln::cl_R& value) { return cln::zerop(value) ? "0" : decimal(cln::rational(value), 25); }

std::string point_text(const std::vector<const Variable*>& inputs, const std::vector<double>& values) {
    std::string text;
    for (std::size_t i = 0; i < inputs.size(); ++i) text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", inputs[i]->name, values[i]);
    return text;
}

std::string worst_text(const std::vector<const Variable*>& inputs, const FunctionAccuracy& f, const Arithmetic& arithmetic) {
    return fmt::format("  {}, {} in {}: {} ulp beyond the condition\n    computed {}\n    exact    {}\n    at ({}) {}\n", title(f), f.worst->result, arithmetic.name, written(f.worst->error), f.worst->computed, exact_text(f.worst->exact),
                       f.worst->kind, point_text(inputs, f.worst->inputs));
}

nlohmann::ordered_json as_json(const FunctionAccuracy& f, const std::vector<const Variable*>& inputs) {
    // What is infinite has no number in JSON.
    const auto number = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(); };
    nlohmann::ordered_json json{{"measured", f.measured}, {"largest", number(f.largest())}, {"typical", number(f.typical)}, {"largest_plain", number(f.largest_plain)}, {"typical_plain", number(f.typical_plain)}};
    if (!f.worst) return json;
    json["worst"] = {{"result", f.worst->result}, {"kind", f.worst->kind}, {"computed", number(f.worst->computed)}, {"exact", exact_text(f.worst->exact)}};
    for (std::size_t i = 0; i < inputs.size(); ++i) json["worst"]["at"][inputs[i]->name] = f.worst->inputs[i];
    return json;
}

}  // namespace

ExitCode accuracy_command(const Options& options, Streams streams) {
    Machine machine = derived(options, streams);
    const System& system = *machine.system;
    refuse_fields(system, "accuracy");
    ask_of_code(machine, options);
    const Header header = generate(machine);
    const AccuracyMeasurement measurement(machine, header);
    std::vector<AccuracyReport> reports;
    for (const Arithmetic* arithmetic : {&float_arithmetic(), &double_arithmetic()}) reports.push_back(measurement.measure(*arithmetic, static_cast<std::size_t>(options.test_points), options.seed));
    const std::vector<const Variable*> inputs = ExactCode::inputs(system);
    const AccuracyReport &in_float = reports.front(), &in_double = reports.back();

    bool is_good = true;
    std::string rows, above;
    const FunctionAccuracy* worst = nullptr;
    for (std::size_t i = 0; i < in_double.functions.size(); ++i) {
        const FunctionAccuracy &d = in_double.functions[i], &f = in_float.functions[i];
        rows += fmt::format("  {:<40} {:>6}   {:>9} {:>9} {:>9}   {:>9} {:>9} {:>9}\n", title(d), d.results, written(d.largest()), written(d.typical), written(d.largest_plain), written(f.largest()), written(f.typical), written(f.largest_plain));
        if (worst == nullptr || d.largest() > worst->largest()) worst = &d;
        if (d.largest() <= options.ulp_limit) continue;
        is_good = false;
        above += worst_text(inputs, d, *in_double.arithmetic);
    }
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("accuracy", system.scene);
        json["seed"] = options.seed;
        json["digits"] = AccuracyMeasurement::digits;
        json["limit"] = options.ulp_limit;
        json["within_limit"] = is_good;
        for (const AccuracyReport& report : reports) json["points"][report.arithmetic->name] = {{"tried", report.points}, {"outside", report.outside}};
        json["functions"] = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < in_double.functions.size(); ++i) {
            const FunctionAccuracy& d = in_double.functions[i];
            nlohmann::ordered_json row{{"function", d.name}, {"mode", d.mode}, {"results", d.results}};
            row["errors"]["double"] = as_json(d, inputs);
            row["errors"]["float"] = as_json(in_float.functions[i], inputs);
            json["functions"].push_back(std::move(row));
        }
        streams.out << printed(json);
        return is_good ? ExitCode::good : ExitCode::check_failed;
    }
    std::string text = fmt::format("{}, scene {}: errors in ulp beyond the condition, against {} digits at {} points in double ({} outside of the model) and {} in float ({})\n", system.scene.sized_name(), system.scene.name,
                                   AccuracyMeasurement::digits, in_double.points, in_double.outside, in_float.points, in_float.outside);
    text += fmt::format("  {:<40} {:>6}   {:>9} {:>9} {:>9}   {:>9} {:>9} {:>9}\n", "", "", "double", "", "", "float", "", "");
    text += fmt::format("  {:<40} {:>6}   {:>9} {:>9} {:>9}   {:>9} {:>9} {:>9}\n", "function", "values", "largest", "typical", "plain", "largest", "typical", "plain");
    text += rows;
    if (!is_good) text += fmt::format("above {} ulp:\n{}", written(options.ulp_limit), above);
    else if (worst != nullptr && worst->worst) text += "worst input:\n" + worst_text(inputs, *worst, *in_double.arithmetic);
    if (options.explain) text += rewritten_text(machine);
    streams.out << text;
    return is_good ? ExitCode::good : ExitCode::check_failed;
}

}  // namespace dalembert

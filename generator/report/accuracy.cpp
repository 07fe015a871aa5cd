// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

std::string written(double error) { return std::isinf(error) ? "infinite" : fmt::format("{:.3g}", error); }

/// A function is called by its mode where there are some.
std::string title(const FunctionAccuracy& f) { return f.mode.empty() ? f.name : f.name + " in " + f.mode; }

std::string exact_text(const cln::cl_R& value) { return cln::zerop(value) ? "0" : decimal(cln::rational(value), 25); }

std::string worst_text(const std::vector<std::string>& inputs, const FunctionAccuracy& f, const Arithmetic& arithmetic) {
    const WorstInput& worst = *f.worst;
    std::string point;
    for (std::size_t i = 0; i < inputs.size(); ++i) point += fmt::format("{}{} = {}", i == 0 ? "" : ", ", inputs[i], worst.inputs[i]);
    return fmt::format("  {}, {} in {}: {} ulp beyond the condition\n    computed {}\n    exact    {}\n    at ({}) {}\n", title(f),
                       worst.result, arithmetic.name, written(worst.error), worst.computed, exact_text(worst.exact), worst.kind, point);
}

/// Function, values, then largest, typical and plain errors in double and in float.
template <class... Cells>
std::string table_line(const Cells&... cells) {
    return fmt::format("  {:<40} {:>6}   {:>9} {:>9} {:>9}   {:>9} {:>9} {:>9}\n", cells...);
}

std::string table(const AccuracyResult& result) {
    std::string text = table_line("", "", "double", "", "", "float", "", "");
    text += table_line("function", "values", "largest", "typical", "plain", "largest", "typical", "plain");
    for (std::size_t i = 0; i < result.in_double.functions.size(); ++i) {
        const FunctionAccuracy &d = result.in_double.functions[i], &f = result.in_float.functions[i];
        text += table_line(title(d), d.results, written(d.largest()), written(d.typical), written(d.largest_plain), written(f.largest()),
                           written(f.typical), written(f.largest_plain));
    }
    return text;
}

/// Every function above the limit, or else the worst of all.
std::string worst_inputs(const AccuracyResult& result) {
    std::string above;
    const FunctionAccuracy* worst = nullptr;
    for (const FunctionAccuracy& f : result.in_double.functions) {
        if (worst == nullptr || f.largest() > worst->largest()) worst = &f;
        if (!(f.largest() <= result.limit)) above += worst_text(result.inputs, f, *result.in_double.arithmetic);
    }
    if (!result.is_good()) return fmt::format("above {} ulp:\n{}", written(result.limit), above);
    if (worst == nullptr || !worst->worst) return "";
    return "worst input:\n" + worst_text(result.inputs, *worst, *result.in_double.arithmetic);
}

nlohmann::ordered_json as_json(const FunctionAccuracy& f, const std::vector<std::string>& inputs) {
    // What is infinite has no number in JSON.
    const auto number = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(); };
    nlohmann::ordered_json json{{"measured", f.measured}, {"largest", number(f.largest())}, {"typical", number(f.typical)},
                                {"largest_plain", number(f.largest_plain)}, {"typical_plain", number(f.typical_plain)}};
    if (!f.worst) return json;
    json["worst"] = {{"result", f.worst->result},
                     {"kind", f.worst->kind},
                     {"computed", number(f.worst->computed)},
                     {"exact", exact_text(f.worst->exact)}};
    for (std::size_t i = 0; i < inputs.size(); ++i) json["worst"]["at"][inputs[i]] = f.worst->inputs[i];
    return json;
}

}  // namespace

bool AccuracyResult::is_good() const {
    // NaN is above every limit.
    return std::all_of(in_double.functions.begin(), in_double.functions.end(),
                       [&](const FunctionAccuracy& f) { return f.largest() <= limit; });
}

std::string as_text(const AccuracyResult& result) {
    const AccuracyReport &d = result.in_double, &f = result.in_float;
    std::string text = fmt::format(
        "{}, scene {}: errors in ulp beyond the condition, against {} digits at {} points in double ({} outside of the model) "
        "and {} in float ({})\n",
        result.subject.sized_name, result.subject.scene, reference_digits, d.points, d.outside, f.points, f.outside);
    text += table(result) + worst_inputs(result);
    return result.explained ? text + rewritten_text(result.rewritten) : text;
}

nlohmann::ordered_json as_json(const AccuracyResult& result) {
    nlohmann::ordered_json json = json_result("accuracy", result.subject);
    json["seed"] = result.seed;
    json["digits"] = reference_digits;
    json["limit"] = result.limit;
    json["within_limit"] = result.is_good();
    for (const AccuracyReport* report : {&result.in_float, &result.in_double})
        json["points"][report->arithmetic->name] = {{"tried", report->points}, {"outside", report->outside}};
    json["functions"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < result.in_double.functions.size(); ++i) {
        const FunctionAccuracy& d = result.in_double.functions[i];
        nlohmann::ordered_json row{{"function", d.name}, {"mode", d.mode}, {"results", d.results}};
        row["errors"]["double"] = as_json(d, result.inputs);
        row["errors"]["float"] = as_json(result.in_float.functions[i], result.inputs);
        json["functions"].push_back(std::move(row));
    }
    return json;
}

}  // namespace dalembert

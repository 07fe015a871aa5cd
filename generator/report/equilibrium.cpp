// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/json_output.hpp"
#include "text/durations.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// The end of a sentence on what is left.
std::string restless_text(const std::optional<Restless>& state) {
    if (!state) return ", the violation of a constraint";
    if (!std::isfinite(state->rate))
        return fmt::format("; the rate of '{}' has no value, where it is {:.6g} {}", state->name, state->value, state->unit);
    const std::string unit = state->unit == "1" ? "" : " " + state->unit;
    return fmt::format(": '{}' changes by {:.6g}{} a second, where it is {:.6g}{}", state->name, state->rate, unit, state->value, unit);
}

/// What kind of point it is.
std::string headline(const EquilibriumResult& result) {
    if (!result.found())
        return fmt::format(
            "no equilibrium found ({}{}), largest |dx/dt| left {:.3g}{}\n  try another start with --state, keep a state with --hold, let "
            "an input change with --free, or let simulate show where it goes\n",
            result.status, result.status == "not finite" ? ": dx/dt or its Jacobian has no value" : "", result.residual,
            restless_text(result.restless));
    if (result.kind == "family") return fmt::format("one of a family of equilibria of dimension {}\n", result.dimension);
    return result.is_motion ? "a steady motion\n" : "an isolated equilibrium\n";
}

/// "21.8 h".
std::string duration_text(double seconds) {
    const TimeUnit& unit = readable_unit(seconds);
    return fmt::format("{:.4g} {}", seconds / unit.seconds, unit.name);
}

/// The time in which the motion decays, or grows, by the factor e, and its period; nothing for an eigenvalue that is only rounding.
std::string times_text(const Complex& value, double largest) {
    std::string text;
    const double rounding = 1e-12 * largest;
    if (std::abs(value.real()) > rounding)
        text += fmt::format("   {} {}", value.real() < 0 ? "time constant" : "grows with", duration_text(1 / std::abs(value.real())));
    if (std::abs(value.imag()) > rounding)
        text += fmt::format("{} period {}", text.empty() ? "  " : ",", duration_text(2 * std::numbers::pi / std::abs(value.imag())));
    return text;
}

std::string eigenvalues_text(const EquilibriumLinearisation& linear, std::size_t states) {
    std::string text;
    if (linear.free_states.size() < states) {
        text += fmt::format("free states under the constraints: {}; the other states follow from them\n", quoted_list(linear.free_states));
        if (!linear.ignorable.empty())
            text += fmt::format("nothing depends on {}: an eigenvalue 0 for each\n", quoted_list(linear.ignorable));
        text += "eigenvalues of the motions that constraints allow [1/s]\n";
    } else {
        text += "eigenvalues of A [1/s]\n";
    }
    double largest = 0;
    for (const Complex& value : linear.eigenvalues) largest = std::max(largest, std::abs(value));
    for (const Complex& value : linear.eigenvalues)
        text += fmt::format("  {:>12.6g} {:<16}{}\n", value.real() + 0.0, fmt::format("{:+.6g} i", value.imag() + 0.0),
                            times_text(value, largest));
    return text;
}

}  // namespace

std::string as_text(const EquilibriumResult& result) {
    std::string text = result.subject.title() + ": " + headline(result) + values_text(result.states) + values_text(result.inputs) +
                       values_text(result.outputs);
    if (!result.found()) return text;
    const EquilibriumLinearisation& linear = *result.linearisation;
    const auto add = [&](const char* title, const MatrixRows& rows, const std::vector<ResultValue>& of_rows, const char* rate_of,
                         const std::vector<ResultValue>& of_columns) {
        if (!rows.empty() && !of_columns.empty()) text += title + rows_text(rows, names_of(of_rows, rate_of), names_of(of_columns));
    };
    add("A\n", linear.A, result.states, "d/dt ", result.states);
    add("B\n", linear.B, result.states, "d/dt ", result.inputs);
    add("C\n", linear.C, result.outputs, "", result.states);
    add("D\n", linear.D, result.outputs, "", result.inputs);
    return text + eigenvalues_text(linear, result.states.size());
}

nlohmann::ordered_json as_json(const EquilibriumResult& result) {
    nlohmann::ordered_json json = json_result("equilibrium", result.subject);
    json["status"] = result.status;
    json["kind"] = result.kind;
    json["dimension"] = result.dimension;
    json["residual"] = result.residual;
    json["iterations"] = result.iterations;
    if (!result.subject.mode.empty()) json["mode"] = result.subject.mode;
    json["state"] = json_object(result.states);
    json["input"] = json_object(result.inputs);
    if (!result.found()) return json;
    json["output"] = json_object(result.outputs);
    const EquilibriumLinearisation& linear = *result.linearisation;
    json["A"] = linear.A;
    json["B"] = linear.B;
    json["C"] = linear.C;
    json["D"] = linear.D;
    json["free_states"] = linear.free_states;
    json["ignorable_states"] = linear.ignorable;
    json["eigenvalues"] = nlohmann::ordered_json::array();
    for (const Complex& value : linear.eigenvalues) json["eigenvalues"].push_back({{"real", value.real()}, {"imaginary", value.imag()}});
    return json;
}

}  // namespace dalembert

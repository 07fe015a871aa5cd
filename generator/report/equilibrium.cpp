// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/equilibrium.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/json_output.hpp"
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
    for (const Complex& value : linear.eigenvalues) text += fmt::format("  {:>12.6g} {:+.6g} i\n", value.real() + 0.0, value.imag() + 0.0);
    return text;
}

}  // namespace

std::string as_text(const EquilibriumResult& result) {
    std::string text = result.subject.title() + ": " + headline(result) + values_text(result.states) + values_text(result.inputs);
    if (!result.found()) return text;
    const EquilibriumLinearisation& linear = *result.linearisation;
    for (const auto& [name, rows] :
         {std::pair("A", &linear.A), std::pair("B", &linear.B), std::pair("C", &linear.C), std::pair("D", &linear.D)})
        if (!rows->empty()) text += fmt::format("{}\n", name) + rows_text(*rows);
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

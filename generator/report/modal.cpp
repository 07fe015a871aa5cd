// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/modal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "report/json_output.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// "0.1 - 2i", to so many significant digits of its size.
std::string written(const Complex& value, double size) {
    const auto clean = [&](double part) { return std::abs(part) < 1e-10 * size ? 0.0 : part; };  // what is only rounding
    const double re = clean(value.real()), im = clean(value.imag());
    if (im == 0) return fmt::format("{:.5g}", re);
    if (re == 0) return fmt::format("{:.5g}i", im);
    return fmt::format("{:.5g} {} {:.5g}i", re, im < 0 ? '-' : '+', std::abs(im));
}

std::string headline(const ModalResult& result) {
    if (result.is_linear) return "linear, M*ddot(q) + D*dot(q) + C*q = B*u\n";
    const std::string before =
        result.reduction ? "motions that constraints allow, " : fmt::format("not linear, since {}; ", result.not_linear);
    return before + fmt::format("linearised at the start, where the largest acceleration is {:.5g}\n", result.largest_acceleration);
}

std::string reduction_text(const ModalReduction& reduction) {
    if (!reduction.is_closed)
        return fmt::format(
            "no modal form: forces depend on a coordinate of {} whose speed follows from other coordinates, so equations of second order "
            "cannot contain it; `dalembert equilibrium` with --moving prints the eigenvalues\n",
            quoted_list(reduction.apart));
    if (reduction.coordinates.empty()) return "no modal form: constraints hold every motion\n";
    std::string text =
        fmt::format("independent coordinates: {}; M, D, C, B and the modes belong to them, and the others follow from them\n",
                    quoted_list(reduction.coordinates));
    if (reduction.apart.empty()) return text;
    text += "also free, with the eigenvalues";
    for (const Complex& value : reduction.of_apart) text += " " + written(value, std::abs(value));
    return text + fmt::format(" 1/s: {}\n", quoted_list(reduction.apart));
}

std::string matrix_text(const ModalMatrix& matrix, const std::vector<std::string>& coordinates, const std::vector<std::string>& inputs) {
    const std::vector<std::string>& columns = matrix.name == "B" ? inputs : coordinates;
    if (matrix.rows.empty() || columns.empty()) return "";
    const std::string title = fmt::format("{}{}\n", matrix.name, matrix.definiteness.empty() ? "" : ", " + matrix.definiteness);
    return matrix.definiteness == "zero" ? title : title + rows_text(matrix.rows, coordinates, columns);
}

std::string table_of_modes(const std::vector<ModalMode>& modes) {
    std::string text = fmt::format("modes  eigenvalue [1/s] {:9} {:>12} {:>12} {:>12}   alpha (2.134)\n", "", "[rad/s]", "[Hz]", "damping");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const ModalMode& mode = modes[k];
        const double frequency = mode.frequency();
        const std::string real = std::abs(mode.eigenvalue.real()) < 1e-10 * frequency ? "" : fmt::format("{:.5g} ", mode.eigenvalue.real());
        const std::string value =
            mode.is_real ? written(mode.eigenvalue, frequency) : fmt::format("{}+- {:.5g}i", real, mode.eigenvalue.imag());
        const auto ratio = mode.damping_ratio();
        text += fmt::format("  {:<4} {:<24} {:>12.5g} {:>12.5g} {:>12}   {}\n", k + 1, value, frequency,
                            frequency / (2 * std::numbers::pi),
                            ratio ? fmt::format("{:.5g}", std::abs(*ratio) < 1e-10 ? 0.0 : *ratio) : "-",
                            mode.size > 1 ? fmt::format("coupled, block {}", mode.block) : written(mode.alpha, std::abs(mode.alpha)));
    }
    return text;
}

std::string eigenvectors_text(const std::vector<ModalMode>& modes, const std::vector<std::string>& coordinates) {
    std::vector<std::string> states = coordinates;
    for (const std::string& name : coordinates) states.push_back("dot(" + name + ")");
    std::string text = fmt::format("eigenvectors [psi_a; lambda*psi_a], of length 1\n  {:<12}", "");
    for (std::size_t k = 0; k < modes.size(); ++k) text += fmt::format(" {:>22}", k + 1);
    text += "\n";
    for (std::size_t i = 0; i < states.size(); ++i) {
        text += fmt::format("  {:<12}", states[i]);
        for (const ModalMode& mode : modes) text += fmt::format(" {:>22}", written(mode.vector[i], 1));
        text += "\n";
    }
    return text;
}

std::string blocks_text(const std::vector<ModalMode>& modes) {
    std::string text;
    for (std::size_t k = 0; k < modes.size(); k += modes[k].size) {
        if (modes[k].size == 1) continue;
        text += fmt::format("block {}: dot(y) = matrix*y\n", modes[k].block);
        for (std::size_t i = k; i < k + modes[k].size; ++i) {
            text += " ";
            for (std::size_t j = k; j < k + modes[k].size; ++j)
                text += fmt::format(" {:>22}", written(modes[i].row[j], std::abs(modes[k].eigenvalue) + std::abs(modes[i].row[j])));
            text += "\n";
        }
    }
    return text;
}

nlohmann::ordered_json as_json(const ModalMode& mode) {
    const auto ratio = mode.damping_ratio();
    nlohmann::ordered_json json{{"eigenvalue", complex_json(mode.eigenvalue)},
                                {"angular_frequency", mode.frequency()},
                                {"damping_ratio", nullptr},
                                {"alpha", nullptr},
                                {"block", mode.block},
                                {"vector", complex_json(mode.vector)},
                                {"row", complex_json(mode.row)},
                                {"input", complex_json(mode.input)}};
    if (ratio) json["damping_ratio"] = *ratio + 0.0;
    if (mode.size == 1) json["alpha"] = complex_json(mode.alpha);
    return json;
}

}  // namespace

std::string as_text(const ModalResult& result) {
    std::string text = result.subject.title() + ": " + headline(result);
    if (!result.is_linear) text += values_text(result.states) + values_text(result.inputs);
    if (result.reduction) text += reduction_text(*result.reduction);
    for (const ModalMatrix& matrix : result.matrices) text += matrix_text(matrix, result.modal_coordinates(), names_of(result.inputs));
    if (result.found()) {
        text += table_of_modes(result.modes) + eigenvectors_text(result.modes, result.modal_coordinates()) + blocks_text(result.modes);
    } else if (!result.reduction || (result.reduction->is_closed && !result.reduction->coordinates.empty())) {
        text += fmt::format("no modal form: {}\n", result.status);  // else the reduction says why
    }
    return text;
}

nlohmann::ordered_json as_json(const ModalResult& result) {
    nlohmann::ordered_json json = json_result("modal", result.subject);
    if (!result.subject.mode.empty()) json["mode"] = result.subject.mode;
    json["status"] = result.status;
    json["linear"] = result.is_linear;
    json["reason"] = result.not_linear;
    json["coordinates"] = result.modal_coordinates();
    if (result.reduction) {
        json["apart"] = result.reduction->apart;
        json["eigenvalues_apart"] = complex_json(result.reduction->of_apart);
        json["free_states"] = result.reduction->free_states;
        json["N"] = result.reduction->N;
    }
    json["state"] = json_object(result.states);
    json["input"] = json_object(result.inputs);
    json["largest_acceleration"] = result.largest_acceleration;
    for (const ModalMatrix& matrix : result.matrices) {
        json[matrix.name] = matrix.rows;
        if (!matrix.definiteness.empty()) json["definiteness"][matrix.name] = matrix.definiteness;
    }
    json["modes"] = nlohmann::ordered_json::array();
    for (const ModalMode& mode : result.modes) json["modes"].push_back(as_json(mode));
    return json;
}

}  // namespace dalembert

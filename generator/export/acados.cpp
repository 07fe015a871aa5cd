// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/acados.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "export/casadi.hpp"
#include "export/derivatives_in_c.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

const std::vector<std::string> explicit_functions{"expl_ode_fun", "expl_vde_forw", "expl_vde_adj", "expl_vde_forw_p"};
const std::vector<std::string> implicit_functions{"impl_dae_fun",
                                                  "impl_dae_fun_jac_x_xdot_z",
                                                  "impl_dae_fun_jac_x_xdot_u_z",
                                                  "impl_dae_fun_jac_x_xdot_u",
                                                  "impl_dae_jac_x_xdot_u_z",
                                                  "impl_dae_jac_p"};

/// A list in Python.
template <class Range, class Text>
std::string listed(const Range& range, const Text& text) {
    std::vector<std::string> entries;
    for (const auto& one : range) entries.push_back(text(one));
    return fmt::format("[{}]", fmt::join(entries, ", "));
}
std::string names(const std::vector<PlantQuantity>& quantities) {
    return listed(quantities, [](const PlantQuantity& q) { return cpp_string(q.name); });
}
std::string numbers(const std::vector<double>& values) {
    return listed(values, [](double value) { return fmt::format("{}", value); });
}

/// Rows, columns, column starts and rows of the unit matrix.
std::string identity(std::size_t n) {
    std::vector<std::size_t> pattern{n, n};
    for (std::size_t i = 0; i <= n; ++i) pattern.push_back(i);
    for (std::size_t i = 0; i < n; ++i) pattern.push_back(i);
    return number_lines(pattern);
}

/// Rows, columns, column starts and rows of second derivatives by [x; xdot; u]: nothing by xdot, all else.
std::string hessian_pattern(std::size_t states, std::size_t inputs) {
    const std::size_t size = 2 * states + inputs;
    std::vector<std::size_t> rows, pattern{size, size, 0};
    const auto is_there = [&](std::size_t i) { return i < states || i >= 2 * states; };
    for (std::size_t i = 0; i < size; ++i)
        if (is_there(i)) rows.push_back(i);
    for (std::size_t i = 0; i < size; ++i) pattern.push_back(pattern.back() + (is_there(i) ? rows.size() : 0));
    for (std::size_t i = 0; i < rows.size(); ++i) pattern.insert(pattern.end(), rows.begin(), rows.end());
    return number_lines(pattern);
}

}  // namespace

Exported acados_files(const ExportSubject& subject, const ExportWish& wish) {
    const DerivativesInC derivatives = derivatives_in_c(subject, wish, "acados");
    Exported result = casadi_files(subject, wish);
    const std::size_t states = subject.plant.states.size();
    std::vector<std::string> functions = implicit_functions;
    if (derivatives.has_hessian) functions.push_back("impl_dae_hess");
    std::string explicit_text;
    std::map<std::string, std::string> values = derivatives.numbers;
    values["HAS_HESSIAN"] = derivatives.has_hessian ? "1" : "0";
    values.erase("HAS_TIME"), values.erase("OUTPUTS"), values.erase("IS_SMALL");
    if (!derivatives.has_time) {
        functions.insert(functions.begin(), explicit_functions.begin(), explicit_functions.end());
        if (derivatives.has_hessian) functions.push_back("expl_ode_hess");
        std::map<std::string, std::string> sizes = values;
        sizes.erase("TITLE");
        sizes["STATES_AND_INPUTS"] = std::to_string(states + subject.plant.inputs.size());
        explicit_text = fill_template(embedded_file("acados_explicit.c.in"), sizes);
    }
    values["EXPLICIT"] = explicit_text;
    values["FUNCTIONS"] = fmt::format("{}_expl_* and {}_impl_dae_*", subject.name, subject.name);
    if (derivatives.has_time) values["FUNCTIONS"] = subject.name + "_impl_dae_*";
    values["IDENTITY"] = identity(states);
    values["HESSIAN_PATTERN"] = derivatives.has_hessian ? hessian_pattern(states, subject.plant.inputs.size()) : "0";
    result.files.emplace_back(subject.name + "_acados.c", fill_template(embedded_file("acados.c.in"), values));
    const char* call = derivatives.has_time ? "f(result.x, result.u, result.p, result.t)" : "f(result.x, result.u, result.p)";
    std::string expressions =
        derivatives.has_time ? "    result.t = ca.MX.sym(\"t\")\n" : fmt::format("    result.f_expl_expr = {}\n", call);
    expressions += fmt::format("    result.f_impl_expr = result.xdot - {}\n", call);
    result.files.emplace_back(subject.name + "_acados_model.py",
                              fill_template(embedded_file("acados_model.py.in"),
                                            {{"NAME", subject.name},
                                             {"TITLE", derivatives.numbers.at("TITLE")},
                                             {"INTEGRATOR", derivatives.has_time ? "\"IRK\"" : "\"ERK\" or \"IRK\""},
                                             {"STATE_NAMES", names(subject.plant.states)},
                                             {"INPUT_NAMES", names(subject.plant.inputs)},
                                             {"PARAMETER_NAMES", names(subject.plant.parameters)},
                                             {"PARAMETER_VALUES", numbers(subject.parameter_defaults)},
                                             {"START_VALUES", numbers(subject.start_values)},
                                             {"FUNCTIONS", listed(functions, [](const std::string& f) { return cpp_string(f); })},
                                             {"EXPRESSIONS", expressions}}));
    if (derivatives.has_time)
        result.notes.push_back("the model depends on time, and explicit functions of acados do not know it: use the implicit ones, with "
                               "integrator_type = \"IRK\"");
    if (subject.plant.constraints && !subject.plant.constraints->list.empty())
        result.notes.push_back("accelerations and forces of constraints are solved for in f: for acados it is an ordinary differential "
                               "equation, without z; it starts where the constraints hold, and keeps them as well as the integrator does");
    return result;
}

}  // namespace dalembert

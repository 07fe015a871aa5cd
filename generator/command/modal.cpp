// SPDX-License-Identifier: GPL-3.0-or-later
// `dalembert modal`: (2.117) to (2.144) of a machine at its start.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <ostream>

#include "report/json_output.hpp"
#include "report/number_lists.hpp"
#include "run/run_header.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"
#include "emit/runner.hpp"
#include "form/linear_system.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Complex = std::complex<double>;
using MatrixRows = std::vector<std::vector<double>>;

/// Modal forms are of machines with coordinates, whose forces know no further states.
void refuse_other_machines(const System& system) {
    for (const ConstraintEquation& constraint : system.constraints)
        if (constraint.item->share)
            throw Failure(Diagnostic{Id::not_allowed_here, constraint.item->span, fmt::format("friction '{}' has a state in place of modes, so that there is no mode to linearise the machine in; with fewer frictions there is one", constraint.name)});
    const Scene& scene = system.scene;
    const auto refuse = [&](const Span& place, std::string why) { throw Failure(Diagnostic{Id::not_allowed_here, place, std::move(why)}); };
    const auto& q = system.symbols.all(SymbolKind::coordinate);
    if (q.empty()) refuse(scene.model->name_span, fmt::format("scene '{}' has no coordinates, so that it has no mass matrix and no modal form", scene.name));
    if (system.symbols.positions() != q.size())
        refuse(q[system.symbols.attitudes().front().coordinates[0]].declared->span, "an attitude is a quaternion, with more states than velocities; a modal form needs coordinates, such as angles");
    for (std::size_t i = 0; i < q.size(); ++i)
        for (const Variable& z : system.symbols.all(SymbolKind::state))
            if (system.residual[i].has(z.symbol))
                refuse(z.declared != nullptr ? z.declared->span : scene.model->name_span, fmt::format("the force on '{}' depends on the state '{}', which M*ddot(q) + D*dot(q) + C*q = B*u does not have; `dalembert equilibrium` has the eigenvalues", q[i].name, z.name));
}

struct PrintedMode {
    Complex eigenvalue, alpha;
    std::size_t block;  ///< counted from 1
    std::size_t size;   ///< of the block
    bool is_real;
    std::vector<Complex> vector, row, input;
};

std::vector<Complex> complex_row(const std::vector<double>& numbers) {
    std::vector<Complex> result;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) result.emplace_back(numbers[i], numbers[i + 1]);
    return result;
}

/// What the program printed.
std::vector<PrintedMode> modes_of(const std::map<std::string, std::string>& result) {
    const auto rows = [&](const char* name) {
        std::vector<std::vector<Complex>> complex;
        for (const auto& row : matrix(result.at(name))) complex.push_back(complex_row(row));
        return complex;
    };
    const auto eigenvalues = rows("eigenvalues"), alpha = rows("alpha"), vectors = rows("vectors"), matrix_rows = rows("matrix"), input = rows("input");
    std::vector<PrintedMode> modes;
    std::size_t number = 0;
    for (const auto& block : matrix(result.at("blocks"))) {
        ++number;
        for (std::size_t i = 0; i < static_cast<std::size_t>(block[0]); ++i) {
            const std::size_t k = modes.size();
            modes.push_back({eigenvalues[k][0], alpha[k][0], number, static_cast<std::size_t>(block[0]), block[1] != 0, {}, matrix_rows[k], input.empty() ? std::vector<Complex>{} : input[k]});
            for (const auto& row : vectors) modes.back().vector.push_back(row[k]);
        }
    }
    return modes;
}

/// "0.1 - 2i", to so many significant digits of its size.
std::string written(const Complex& value, double size) {
    const auto clean = [&](double part) { return std::abs(part) < 1e-10 * size ? 0.0 : part; };  // what is only rounding
    const double re = clean(value.real()), im = clean(value.imag());
    if (im == 0) return fmt::format("{:.5g}", re);
    if (re == 0) return fmt::format("{:.5g}i", im);
    return fmt::format("{:.5g} {} {:.5g}i", re, im < 0 ? '-' : '+', std::abs(im));
}

nlohmann::ordered_json as_json(const Complex& value) { return {{"real", value.real() + 0.0}, {"imaginary", value.imag() + 0.0}}; }
nlohmann::ordered_json as_json(const std::vector<Complex>& values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Complex& value : values) list.push_back(as_json(value));
    return list;
}

std::string matrix_text(const char* name, const MatrixRows& rows, const std::string& definiteness) {
    std::string text = fmt::format("{}{}\n", name, definiteness.empty() ? "" : ", " + definiteness);
    if (definiteness == "zero") return text;
    for (const auto& row : rows) {
        text += " ";
        for (const double value : row) text += fmt::format(" {:>12.5g}", value + 0.0);  // no -0
        text += "\n";
    }
    return text;
}

/// Names of coordinates, and behind them those of their velocities.
std::vector<std::string> with_velocities(const std::vector<std::string>& coordinates) {
    std::vector<std::string> names = coordinates;
    for (const std::string& name : coordinates) names.push_back("dot(" + name + ")");
    return names;
}

std::string modes_text(const std::vector<PrintedMode>& modes, const std::vector<std::string>& coordinates) {
    std::string text = fmt::format("modes{:26} {:>12} {:>12}   alpha\n", "", "rad/s", "damping");
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const PrintedMode& mode = modes[k];
        const double frequency = std::abs(mode.eigenvalue);
        const std::string real = std::abs(mode.eigenvalue.real()) < 1e-10 * frequency ? "" : fmt::format("{:.5g} ", mode.eigenvalue.real());
        const std::string value = mode.is_real ? written(mode.eigenvalue, frequency) : fmt::format("{}+- {:.5g}i", real, mode.eigenvalue.imag());
        const double ratio = -mode.eigenvalue.real() / frequency;
        text += fmt::format("  {:<3} {:<25} {:>12.5g} {:>12}   {}\n", k + 1, value, frequency, frequency > 0 ? fmt::format("{:.5g}", std::abs(ratio) < 1e-10 ? 0.0 : ratio) : "-",
                            mode.size > 1 ? fmt::format("coupled, block {}", mode.block) : written(mode.alpha, std::abs(mode.alpha)));
    }
    text += "eigenvectors [psi_a; lambda*psi_a], of length 1\n  ";
    const std::vector<std::string> states = with_velocities(coordinates);
    text += fmt::format("{:<12}", "");
    for (std::size_t k = 0; k < modes.size(); ++k) text += fmt::format(" {:>22}", k + 1);
    text += "\n";
    for (std::size_t i = 0; i < states.size(); ++i) {
        text += fmt::format("  {:<12}", states[i]);
        for (const PrintedMode& mode : modes) text += fmt::format(" {:>22}", written(mode.vector[i], 1));
        text += "\n";
    }
    for (std::size_t k = 0; k < modes.size(); k += modes[k].size) {
        if (modes[k].size == 1) continue;
        text += fmt::format("block {}: dot(y) = matrix*y\n", modes[k].block);
        for (std::size_t i = k; i < k + modes[k].size; ++i) {
            text += " ";
            for (std::size_t j = k; j < k + modes[k].size; ++j) text += fmt::format(" {:>22}", written(modes[i].row[j], std::abs(modes[k].eigenvalue) + std::abs(modes[i].row[j])));
            text += "\n";
        }
    }
    return text;
}

/// How constraints leave motions free.
struct Reduction {
    bool is_closed;
    std::vector<std::string> coordinates, apart, free_states;
    std::vector<Complex> of_apart;
    MatrixRows N;

    Reduction(const std::map<std::string, std::string>& result, const System& system) : is_closed(result.at("is_closed") == "1"), N(matrix(result.at("N"))) {
        const std::vector<const Variable*> states = system.symbols.state_variables();
        const auto names = [&](const char* key) {
            std::vector<std::string> list;
            for (const double place : number_list(result.at(key), ',')) list.push_back(states[static_cast<std::size_t>(place)]->name);
            return list;
        };
        coordinates = names("coordinates");
        apart = names("apart");
        free_states = names("free");
        for (const auto& row : matrix(result.at("of_apart"))) of_apart.emplace_back(row[0], row[1]);
    }

    std::string text() const {
        if (!is_closed) return fmt::format("no modal form: forces depend on a coordinate of {} whose speed follows from other coordinates, so that equations of second order do not have it; `dalembert equilibrium` with --moving has the eigenvalues\n", quoted_list(apart));
        if (coordinates.empty()) return "no modal form: constraints hold every motion\n";
        std::string text = fmt::format("independent coordinates: {}; M, D, C, B and modes are theirs, and the others follow from them\n", quoted_list(coordinates));
        if (apart.empty()) return text;
        text += "free besides, with the eigenvalues";
        for (const Complex& value : of_apart) text += " " + written(value, std::abs(value));
        return text + fmt::format(" 1/s: {}\n", quoted_list(apart));
    }

    void write(nlohmann::ordered_json& json) const {
        json["coordinates"] = coordinates;
        json["apart"] = apart;
        json["eigenvalues_apart"] = as_json(of_apart);
        json["free_states"] = free_states;
        json["N"] = N;
    }
};

}  // namespace

ExitCode modal_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    Machine machine = derive_machine(model, scene_for_run(model->model, options), options.choice.sizes);
    show_warnings(machine, streams);
    refuse_fields(*machine.system, "modal");
    refuse_other_machines(*in_chosen_mode(machine, options).system);
    const Header header = generate(machine);
    const Machine& chosen = in_chosen_mode(machine, options);
    const System& system = *chosen.system;
    const auto [values, inputs] = start_of_run(system, options);
    streams.err << doubts_of_start(values, system);
    const Linearity linearity = linear_system(system);
    const ScratchFolder scratch;
    const auto result = run_with_header(scratch, header, modal_source(*chosen.code, header, values, values.state(), inputs), {}, "-O0");  // compiling takes longer than running
    const bool is_held = result.contains("is_closed");
    const auto reduction = is_held ? std::optional<Reduction>(Reduction(result, system)) : std::nullopt;
    const bool found = result.at("status") == "success";
    const std::size_t n = system.symbols.degrees();
    const auto rates = number_list(result.at("rates"), ',');
    double largest = 0;
    for (std::size_t i = n; i < 2 * n; ++i) largest = std::max(largest, std::abs(rates[i]));

    nlohmann::ordered_json json = json_result("modal", system.scene);
    if (system.scene.mode) json["mode"] = system.scene.modes[*system.scene.mode].name;
    json["status"] = result.at("status");
    json["linear"] = linearity.system.has_value();
    json["reason"] = linearity.reason;
    std::vector<std::string> coordinates;
    for (const Variable& q : system.symbols.all(SymbolKind::coordinate)) coordinates.push_back(q.name);
    json["coordinates"] = coordinates;
    if (reduction) {
        reduction->write(json);
        coordinates = reduction->coordinates;
    }
    std::string text = title_of(system.scene) + ": ";
    text += linearity.system ? "linear, M*ddot(q) + D*dot(q) + C*q = B*u\n"
            : reduction      ? fmt::format("motions that constraints allow, linearised at the start, where the largest acceleration is {:.5g}\n", largest)
                             : fmt::format("not linear, since {}; linearised at the start, where the largest acceleration is {:.5g}\n", linearity.reason, largest);
    const auto list = [&](const char* key, const std::vector<const Variable*>& variables, const std::vector<GiNaC::ex>& numbers_of) {
        json[key] = nlohmann::ordered_json::object();
        for (std::size_t i = 0; i < variables.size(); ++i) {
            const double value = GiNaC::ex_to<GiNaC::numeric>(numbers_of[i].evalf()).to_double();
            json[key][variables[i]->name] = value;
            if (!linearity.system) text += fmt::format("  {:<16} {:>22} {}\n", variables[i]->name, value, variables[i]->unit);
        }
    };
    std::vector<const Variable*> input_variables;
    for (const Variable& v : system.symbols.all(SymbolKind::input)) input_variables.push_back(&v);
    list("state", system.symbols.state_variables(), values.state());
    list("input", input_variables, inputs);
    json["largest_acceleration"] = largest;
    if (reduction) text += reduction->text();
    for (const char* name : {"M", "D", "C", "B"}) {
        const MatrixRows rows = matrix(result.at(name));
        json[name] = rows;
        const auto kind = result.find(std::string("of_") + name);
        if (kind != result.end()) json["definiteness"][name] = kind->second;
        if (!rows.empty()) text += matrix_text(name, rows, kind == result.end() ? "" : kind->second);
    }
    if (!found && (!reduction || (reduction->is_closed && !reduction->coordinates.empty()))) text += fmt::format("no modal form: {}\n", result.at("status"));
    json["modes"] = nlohmann::ordered_json::array();
    if (found) {
        const auto modes = modes_of(result);
        for (const PrintedMode& mode : modes) {
            const double frequency = std::abs(mode.eigenvalue);
            json["modes"].push_back({{"eigenvalue", as_json(mode.eigenvalue)}, {"angular_frequency", frequency}, {"damping_ratio", nullptr}, {"alpha", nullptr}, {"block", mode.block},
                                     {"vector", as_json(mode.vector)}, {"row", as_json(mode.row)}, {"input", as_json(mode.input)}});
            if (frequency > 0) json["modes"].back()["damping_ratio"] = -mode.eigenvalue.real() / frequency + 0.0;
            if (mode.size == 1) json["modes"].back()["alpha"] = as_json(mode.alpha);
        }
        text += modes_text(modes, coordinates);
    }
    streams.out << (options.format == "json" ? printed(json) : text);
    return found ? ExitCode::good : ExitCode::run_stopped;
}

}  // namespace dalembert

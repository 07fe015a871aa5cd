// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <ostream>

#include "command/json_output.hpp"
#include "command/settings.hpp"
#include "command/shared.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Values of a system at one point, from the symbolic derivation.
class Evaluation {
public:
    Evaluation(const System& system, const Values& values, int digits) : system_(system), digits_(digits), point_(values.substitution()) {
        add_steps(point_, system.symbols, working_digits() + 20);
        solve();
    }

    std::string number(const ex& e) const {
        const auto v = value_at(e, point_, working_digits());
        if (!v) throw Failure(Diagnostic{Id::division_by_zero, system_.scene.model->name_span, "an expression has no value at this point"});
        return decimal(cln::rational(*v), digits_);
    }

private:
    /// Results are correct in all digits that are asked for as long as no more than twice as many cancel.
    int working_digits() const { return 3 * digits_ + 30; }

    /// Accelerations and state rates join the point.
    void solve() {
        const Symbols& symbols = system_.symbols;
        const std::size_t n = symbols.degrees();
        std::vector<std::vector<cln::cl_R>> m(n, std::vector<cln::cl_R>(n + 1));
        const auto entry = [&](const ex& e) {
            const auto v = value_at(e, point_, working_digits());
            if (!v) throw Failure(Diagnostic{Id::division_by_zero, system_.scene.model->name_span, "the equations of motion have no value at this point"});
            return *v;
        };
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t l = 0; l < n; ++l) m[j][l] = entry(system_.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)));
            m[j][n] = entry(system_.supplied[j] - system_.bias[j]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            if (cln::zerop(m[k][k]))
                throw Failure(Diagnostic{Id::singular_mass, symbols.all(SymbolKind::coordinate)[k].declared->span,
                                         fmt::format("the mass matrix is singular at this point: the acceleration of '{}' is not determined", symbols.all(SymbolKind::coordinate)[k].name)});
            for (std::size_t j = 0; j < n; ++j) {
                if (j == k) continue;
                const cln::cl_R factor = m[j][k] / m[k][k];
                for (std::size_t l = k; l <= n; ++l) m[j][l] = m[j][l] - factor * m[k][l];
            }
        }
        for (std::size_t j = 0; j < n; ++j) point_[symbols.get(SymbolKind::acceleration, j)] = GiNaC::numeric(m[j][n] / m[j][j]);
        for (std::size_t i = 0; i < system_.state_rates.size(); ++i)
            point_[symbols.get(SymbolKind::state_rate, i)] = GiNaC::numeric(entry(system_.state_rates[i]));
    }

    const System& system_;
    int digits_;
    GiNaC::exmap point_;
};

}  // namespace

ExitCode evaluate_command(const Options& options, Streams streams) {
    const Machine machine = derived(options, streams);
    const System& system = *machine.system;
    refuse_fields(system, "evaluate");
    Values values(system.scene, system.translate);
    apply_settings(values, parse_settings(options.parameters, "parameter"), on_parameters, system);
    apply_settings(values, parse_settings(options.states, "state"), on_states, system);
    apply_settings(values, parse_settings(options.inputs, "input"), on_inputs, system);
    const Evaluation at(system, values, options.digits);

    nlohmann::ordered_json json = json_result("evaluate", system.scene);
    json["digits"] = options.digits;
    std::string text = fmt::format("{}, scene {}\n", system.scene.sized_name(), system.scene.name);
    // Up to 17 digits are numbers in JSON; more would be lost there and are texts.
    const auto json_number = [&](const std::string& number) { return options.digits <= 17 ? nlohmann::ordered_json(std::stod(number)) : nlohmann::ordered_json(number); };
    const auto group = [&](const char* key, const char* title, const std::vector<std::pair<std::string, ex>>& entries) {
        json[key] = nlohmann::ordered_json::object();
        if (!entries.empty()) text += fmt::format("{}\n", title);
        for (const auto& [name, value] : entries) {
            const std::string number = at.number(value);
            json[key][name] = json_number(number);
            text += fmt::format("  {:<20} {}\n", name, number);
        }
    };
    const auto symbols_of = [&](std::initializer_list<SymbolKind> kinds) {
        std::vector<std::pair<std::string, ex>> entries;
        for (const SymbolKind kind : kinds)
            for (const Variable& variable : system.symbols.all(kind)) entries.emplace_back(variable.name, variable.symbol);
        return entries;
    };
    group("parameter", "parameters", symbols_of({SymbolKind::parameter}));
    group("state", "state x", symbols_of({SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state}));
    group("input", "inputs u", symbols_of({SymbolKind::input}));
    group("state_derivative", "state derivative dx/dt", symbols_of({SymbolKind::velocity, SymbolKind::acceleration, SymbolKind::state_rate}));
    std::vector<std::pair<std::string, ex>> outputs;
    for (const OutputEquation& output : system.outputs) outputs.emplace_back(output.name, output.value);
    group("output", "outputs y", outputs);
    text += "energies and powers\n";
    std::vector<std::pair<const char*, ex>> powers{{"kinetic_energy", system.kinetic_energy},
                                                   {"potential_energy", system.potential_energy},
                                                   {"supplied_power", system.supplied_power},
                                                   {"dissipated_power", system.dissipated_power},
                                                   {"prescribed_power", system.prescribed_power}};
    if (system.has_balances()) {
        powers.emplace_back("internal_energy", system.internal_energy);
        powers.emplace_back("exchanged_power", system.exchanged_power);
    }
    for (const auto& [name, value] : powers) {
        const std::string number = at.number(value);
        json[name] = json_number(number);
        text += fmt::format("  {:<20} {}\n", name, number);
    }
    streams.out << (options.format == "json" ? printed(json) : text);
    return ExitCode::good;
}

}  // namespace dalembert

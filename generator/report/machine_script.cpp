// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "elements/item.hpp"
#include "elements/model.hpp"
#include "emit/value_statements.hpp"
#include "form/seen_step.hpp"
#include "form/state_places.hpp"
#include "graph/notation.hpp"
#include "js/module.hpp"
#include "js/print.hpp"
#include "language/lexer.hpp"
#include "program/plant_tables.hpp"
#include "report/drawing_json.hpp"
#include "run/plant_run.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

namespace {

using Json = nlohmann::ordered_json;

/// JSON in a script: nothing in it ends the script.
std::string script_json(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

/// A file name as one word of a shell.
std::string shell_word(const std::string& name) {
    const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; };
    if (!name.empty() && name.front() != '-' && std::all_of(name.begin(), name.end(), is_plain)) return name;
    std::string word = name.starts_with("-") ? "'./" : "'";
    for (const char c : name) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

Json unit_json(const std::string& unit, double factor, double offset) { return {{"unit", unit}, {"factor", factor}, {"offset", offset}}; }

Json unit_json(const Unit& unit) {
    return unit_json(unit.written, cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power),
                     cln::double_approx(unit.offset));
}

bool calls_curves(const std::vector<GiNaC::ex>& values, const Symbols& symbols) {
    return std::any_of(values.begin(), values.end(), [&](const GiNaC::ex& value) {
        const GiNaC::ex whole = symbols.without_definitions(value);
        return std::any_of(whole.preorder_begin(), whole.preorder_end(),
                           [](const GiNaC::ex& part) { return !points_of_call(part).empty(); });
    });
}

/// A function with the parameters $p that writes into `target`; null where there is nothing to write.
std::string written_function(Code& code, const Plant& plant, const std::vector<GiNaC::ex>& values, const std::string& target,
                             const char* arguments) {
    if (values.empty()) return "null";
    JsPrinter print(plant);
    const std::string body = print.text(value_statements(code, values, target));
    // A curve may be called here and nowhere in the plant.
    const std::string tables = calls_curves(values, code.system.symbols) ? print.curves(curve_tables({&code})) : "";
    return fmt::format("(() => {{\n{}return ($p) => ({}) => {{\n        {}.fill(0);\n{}}};\n}})()",
                       js_helper_source(print.called()) + tables, arguments, target, body);
}

class ScriptMaker {
public:
    ScriptMaker(ScenePage& scene, const MachineDrawing& drawing)
        : run_(*scene.run), formulas_(scene.formulas), named_run_(scene.named_run), system_(*run_.machine.system), drawing_(drawing) {
        for (const ShownUnit& shown : shown_units(system_)) units_[shown.column] = unit_json(shown.unit, shown.factor, shown.offset);
    }

    SceneScript operator()(const std::string& file) {
        const std::string name = system_.scene.sized_name() + "_" + system_.scene.name;
        Json json;
        json["name"] = system_.scene.name;
        json["run"] = named_run_;
        json["command"] = command(file);
        add_run(json);
        add_quantities(json);
        json.update(drawing_json(drawing_, [&](const char* si) { return usual_unit(si); }));
        std::vector<std::vector<GiNaC::ex>> network_values;
        for (const NetworkDrawing& network : drawing_.networks) network_values.push_back(network.values);
        const std::string functions = fmt::format(
            "inputs: {}, place: {}, end_of_run: {}, start_values: {}, checked_values: {}, held: {}, switches: {}, network_values: {}, "
            "measures: {}, force_values: {}",
            written(run_.settings.inputs, "u", "t, x, u"), written(drawing_.coordinates, "points", "t, x, points"),
            formulas_.end ? written({*formulas_.end}, "end", "end") : "null", written(formulas_.start, "start", "start"), conditions(json),
            held(json), switches(),
            drawing_.networks.front().empty() ? "null" : by_modes(network_values), written(drawing_.measures, "values", "t, x, values"),
            drawing_.forces.empty() ? "null" : by_modes(drawing_.force_values));
        return {js_module(run_.header.plant, name, "// SPDX-License-Identifier: BSL-1.0"),
                fmt::format("{{ ...{}, make: {}, {} }}", script_json(json), name, functions)};
    }

private:
    std::string command(const std::string& file) const {
        std::string text = fmt::format("dalembert simulate {} --scene {}", shell_word(file), system_.scene.name);
        for (const auto& [name, value] : system_.scene.sizes) text += fmt::format(" --size {}={}", name, value);
        return text + (named_run_.empty() ? "" : " --run " + named_run_);
    }

    std::string written(const std::vector<GiNaC::ex>& values, const std::string& target, const char* arguments) {
        return written_function(*run_.machine.code, run_.header.plant, values, target, arguments);
    }

    /// What is asked of values, and these.
    std::string conditions(Json& json) {
        std::vector<GiNaC::ex> values;
        json["conditions"] = Json::array();
        for (const ValueCondition& one : formulas_.conditions) {
            json["conditions"].push_back({{"rule", to_string(one.rule)}, {"values", one.values.size()}, {"text", one.text}});
            values.insert(values.end(), one.values.begin(), one.values.end());
        }
        return written(values, "values", "t, x, values");
    }

    /// Which constraints a start must meet, with their positions and rates, and slopes of both by what they are of, constraint by
    /// constraint.
    std::string held(Json& json) {
        if (!formulas_.meets_constraints) return "null";
        std::vector<GiNaC::ex> positions, rates, of_positions, of_rates;
        json["constraints"] = Json::array();
        for (const ConstraintEquation& c : system_.constraints) {
            if (!c.holds) continue;
            json["constraints"].push_back(c.name);
            positions.push_back(c.position ? *c.position : 0);
            rates.push_back(c.whole_rate);
            for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) {
                of_positions.push_back(c.position && formulas_.free_positions[j] >= 0 ? system_.symbols.along(*c.position, j) : 0);
                of_rates.push_back(c.rate.jacobian[j]);
            }
        }
        json["free"] = {formulas_.free_positions, formulas_.free_rates};
        const auto function = [&](const std::vector<GiNaC::ex>& values) { return written(values, "values", "t, x, values"); };
        return fmt::format("[{}, {}, {}, {}]", function(positions), function(of_positions), function(rates), function(of_rates));
    }

    /// Functions of time with kinks and jumps where their signs change, and how fast their waves are, mode by mode.
    std::string switches() {
        std::string list;
        for (std::size_t i = 0; i < formulas_.switches.size(); ++i) {
            if (formulas_.switches[i].empty()) continue;
            Code& code = i == 0 ? *run_.machine.code : *run_.machine.other_modes[i - 1].code;
            std::vector<GiNaC::ex> functions, rates;
            std::vector<std::size_t> waves;
            for (const SwitchInTime& one : formulas_.switches[i]) {
                functions.push_back(one.function);
                waves.push_back(one.rates.size());
                rates.insert(rates.end(), one.rates.begin(), one.rates.end());
            }
            list += fmt::format("{{ waves: {}, functions: {}, rates: {} }}, ", Json(waves).dump(),
                                written_function(code, run_.header.plant, functions, "values", "t, values"),
                                written_function(code, run_.header.plant, rates, "values", "values"));
        }
        return "[" + list + "]";
    }

    /// That of the first quantity of the model that has the dimension and a unit other than SI, states before others. One of speeds of
    /// rotation counts turns or degrees, as 1/min alone may be anything, and of torques there is none, as energies have their dimension.
    Json usual_unit(const std::string& si) const {
        const Dimension wanted = parse_unit(excerpt_of(std::make_shared<const Source>("unit", si))).dimension;
        const auto fits = [&](const Unit& unit) {
            return unit.dimension == wanted && !unit.is_coherent() && si != "N*m" && (si != "rad/s" || unit.pi_power != 0);
        };
        for (const SymbolKind kind : {SymbolKind::state, SymbolKind::input, SymbolKind::parameter})
            for (const Variable& variable : system_.symbols.all(kind))
                if (variable.declared != nullptr && fits(variable.declared->unit)) return unit_json(variable.declared->unit);
        return unit_json(si, 1, 0);
    }

    /// Functions of the state, the time and inputs.
    std::string by_modes(const std::vector<std::vector<GiNaC::ex>>& values) {
        std::string list;
        for (std::size_t i = 0; i < values.size(); ++i)
            list += written_function(i == 0 ? *run_.machine.code : *run_.machine.other_modes[i - 1].code, run_.header.plant, values[i],
                                     "values", "t, x, u, values") +
                    ", ";
        return "[" + list + "]";
    }

    void add_run(Json& json) {
        const SimulationSettings& s = run_.settings;
        json["until"] = s.until;
        json["tolerance"] = s.tolerance;
        json["intervals"] = s.intervals;
        // Nothing: steps are as long as their errors allow.
        json["longest_step"] = std::isinf(seen_step(system_, s.inputs)) ? Json() : Json(s.until / s.intervals);
        json["stops"] = s.kinks;
        json["known_times"] = formulas_.known_times;
        const std::vector<double> values = numbers_of(run_.values.state());
        const StatePlaces places = place_states(system_);
        std::vector<double> start = run_.header.plant.start_values;
        for (std::size_t i = 0; i < values.size(); ++i) start[places.positions[i]] = values[i];
        json["start"] = start;
        json["fixed_inputs"] = formulas_.fixed_inputs;
        json["parameters"] = parameter_numbers(system_, run_.values);
        const Notation write(system_.symbols, Style::text);
        json["input_texts"] = Json::array();
        for (const GiNaC::ex& input : s.inputs) json["input_texts"].push_back(write(input));
        json["plots"] = Json::array();
        for (const Plot& plot : s.plots) json["plots"].push_back({{"x", plot.x}, {"y", plot.y}});
    }

    Json unit_of(const std::string& name, const std::string& si) const {
        const auto found = units_.find(name);
        return found == units_.end() ? unit_json(si, 1, 0) : found->second;
    }

    void add_quantities(Json& json) {
        json["states"] = Json::array();
        for (const Variable* variable : system_.symbols.state_variables()) {
            const std::string name = variable->recorded_name();
            Json one = unit_of(name, variable->unit);
            one["name"] = name;
            one["is_root"] = variable->is_root;
            json["states"].push_back(std::move(one));
        }
        json["outputs"] = Json::array();
        for (const OutputEquation& output : system_.outputs) {
            Json one = unit_of(output.name, output.unit);
            one["name"] = output.name;
            json["outputs"].push_back(std::move(one));
        }
        for (const auto& [key, kind] : {std::pair{"input_units", SymbolKind::input}, std::pair{"parameter_units", SymbolKind::parameter}}) {
            json[key] = Json::array();
            for (const Variable& variable : system_.symbols.all(kind))
                json[key].push_back(variable.declared != nullptr ? unit_json(variable.declared->unit) : unit_json(variable.unit, 1, 0));
        }
    }

    PreparedRun& run_;
    const RunFormulas& formulas_;
    const std::string named_run_;
    const System& system_;
    const MachineDrawing& drawing_;
    std::map<std::string, Json> units_;
};

}  // namespace

SceneScript scene_script(ScenePage& scene, const MachineDrawing& drawing, const std::string& file) {
    return ScriptMaker(scene, drawing)(file);
}

}  // namespace dalembert

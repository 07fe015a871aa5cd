// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/fmi_model.hpp"

#include <export/fmi_values.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "export/stored_entries.hpp"
#include "language/dimension.hpp"
#include "language/parser.hpp"
#include "run/run_preparation.hpp"
#include "symbolic/symbols.hpp"
#include "symbolic/values.hpp"

namespace dalembert {

namespace {

/// Exponents of "rad" in a unit: the dimension of an angle is none, but FMI counts radians.
int radians(const Expression& e) {
    using Kind = Expression::Kind;
    switch (e.kind) {
        case Kind::name: return e.name == "rad" ? 1 : 0;
        case Kind::multiply: return radians(*e.children[0]) + radians(*e.children[1]);
        case Kind::divide: return radians(*e.children[0]) - radians(*e.children[1]);
        case Kind::power: {
            const int inside = radians(*e.children[0]);
            const Expression& exponent = *e.children[1];
            if (inside == 0) return 0;
            if (exponent.kind == Kind::number) return inside * static_cast<int>(cln::double_approx(exponent.value));
            return exponent.kind == Kind::negate && exponent.children[0]->kind == Kind::number
                       ? -inside * static_cast<int>(cln::double_approx(exponent.children[0]->value))
                       : 0;
        }
        default: return 0;
    }
}

FmiUnit unit_of(const std::string& text) {
    static constexpr const char* names[Dimension::count] = {"m", "kg", "s", "A", "K", "mol", "cd"};
    const Excerpt excerpt = excerpt_of(std::make_shared<const Source>("unit", text));
    const Dimension dimension = parse_unit(excerpt).dimension;
    FmiUnit unit{text, {}, true};
    for (std::size_t i = 0; i < Dimension::count; ++i) {
        const Fraction exponent = dimension.exponent(i);
        if (exponent.denominator != 1) unit.has_exponents = false;
        if (exponent.numerator != 0) unit.exponents.emplace_back(names[i], exponent.numerator);
    }
    if (const int angle = radians(*parse_expression(excerpt)); angle != 0) unit.exponents.emplace_back("rad", angle);
    return unit;
}

class ModelMaker {
public:
    ModelMaker(const ExportSubject& subject, FmiVersion version)
        : subject_(subject),
          plant_(subject.plant),
          version_(version),
          indicators_(indicator_docs(plant_)),
          layout_(fmi_layout_of(plant_.states.size(), plant_.inputs.size(), plant_.outputs.size(), plant_.parameters.size(),
                                indicators_.size(), plant_.modes ? plant_.modes->modes.size() : 0)) {}

    FmiModel run() {
        const std::string scene = plant_.scene == "full" ? "" : ", scene " + plant_.scene;
        model_.identifier = subject_.name;
        model_.name = plant_.model + scene;
        model_.title = plant_.title;
        model_.indicator_count = indicators_.size();
        model_.is_projected = plant_.constraints.has_value();
        if (plant_.modes) model_.modes = plant_.modes->modes;
        add_time();
        add_states();
        add_inputs_and_outputs();
        add_parameters();
        if (version_ == FmiVersion::three) add_indicators();
        add_energies();
        if (plant_.modes) add_mode();
        add_structure();
        add_units();
        model_.stop = end_of_reference();
        return std::move(model_);
    }

private:
    /// What must be watched, as dalembert_modes.h orders it.
    static std::vector<std::pair<std::string, std::string>> indicator_docs(const Plant& plant) {
        std::vector<std::pair<std::string, std::string>> result;
        if (plant.modes)
            for (const PlantEvent& event : plant.modes->events)
                result.emplace_back(fmt::format("event({})", event.name), "falls through zero where the event happens");
        for (const PlantGuard& guard : plant.guards)
            result.emplace_back(fmt::format("{}({})", guard.ends ? "range" : "kink", guard.name), guard.doc);
        return result;
    }

    /// A name that no variable has yet: users must find what the model calls so under its own name, so what is added here gives way.
    std::string unique(const std::string& wanted, bool is_of_model) {
        std::string name = wanted;
        while (!names_.insert(name).second) name += "_";
        if (name != wanted && is_of_model)
            model_.notes.push_back(fmt::format("'{}' occurs twice: the second one is called '{}'.", wanted, name));
        return name;
    }

    FmiVariable& add(enum fmi_kind kind, std::size_t index, const std::string& name, const std::string& doc, const std::string& causality,
                     const std::string& variability, bool is_of_model = true) {
        FmiVariable variable;
        variable.name = unique(name, is_of_model);
        variable.reference = layout_.first[kind] + index;
        variable.doc = doc;
        variable.causality = causality;
        variable.variability = variability;
        if (index == 0) places_[kind] = model_.variables.size();
        model_.variables.push_back(std::move(variable));
        return model_.variables.back();
    }

    FmiVariable& add(enum fmi_kind kind, std::size_t index, const PlantQuantity& q, const std::string& causality,
                     const std::string& variability) {
        FmiVariable& variable = add(kind, index, q.name, q.doc, causality, variability);
        variable.unit = q.unit;
        variable.low = q.low;
        variable.high = q.high;
        return variable;
    }

    static void start_with(FmiVariable& variable, double value) {
        variable.start = value;
        // A start value that lies outside of its range by a rounding would make the range a contradiction.
        if (variable.low && value < *variable.low) variable.low = value;
        if (variable.high && value > *variable.high) variable.high = value;
    }

    void add_time() {
        // Names of the model come first: `t` is its only reserved letter.
        const bool is_taken =
            std::any_of(plant_.parameters.begin(), plant_.parameters.end(), [](const PlantQuantity& q) { return q.name == "time"; });
        add(fmi_time, 0, is_taken ? "t" : "time", "time", "independent", "continuous").unit = "s";
    }

    void add_states() {
        const std::vector<bool> computed = computed_starts();
        for (std::size_t i = 0; i < plant_.states.size(); ++i) {
            const PlantQuantity& q = plant_.states[i];
            FmiVariable& state = add(fmi_state, i, q, "local", "continuous");
            state.initial = computed[i] ? "approx" : "exact";
            start_with(state, subject_.start_values[i]);
            state.nominal = fmi_nominal(subject_.start_values[i], q.low.value_or(-INFINITY), q.high.value_or(INFINITY));
            state.can_jump = plant_.modes || plant_.constraints;
        }
        for (std::size_t i = 0; i < plant_.states.size(); ++i) {
            const PlantQuantity& q = plant_.states[i];
            FmiVariable& rate = add(fmi_derivative, i, "der(" + q.name + ")", "time derivative of " + q.name, "local", "continuous", false);
            rate.derivative_of = places_[fmi_state] + i;
            rate.unit = per_second(parse_unit(excerpt_of(std::make_shared<const Source>("unit", q.unit))));
        }
    }

    /// Whether the start value of a state may follow from others: from parameters, from constraints, or from a reset at the start.
    std::vector<bool> computed_starts() const {
        const bool all = subject_.machine.fields || (plant_.modes && std::any_of(plant_.modes->events.begin(), plant_.modes->events.end(),
                                                                               [](const PlantEvent& e) { return e.at_start; }));
        std::vector<bool> result(plant_.states.size(), all);
        const std::size_t moving = plant_.states.size() - plant_.plain_states;
        if (plant_.constraints)
            std::fill(result.begin(), plant_.constraints->list.empty() ? result.end() : result.begin() + long(moving), true);
        if (!all) mark_computed(plant_.start_state.statements, "x", result);
        return result;
    }

    void add_inputs_and_outputs() {
        for (std::size_t i = 0; i < plant_.inputs.size(); ++i) {
            const PlantQuantity& q = plant_.inputs[i];
            start_with(add(fmi_input, i, q, "input", "continuous"), fmi_input_start(q.low.value_or(-INFINITY), q.high.value_or(INFINITY)));
        }
        for (std::size_t i = 0; i < plant_.outputs.size(); ++i) add(fmi_output, i, plant_.outputs[i], "output", "continuous");
    }

    void add_parameters() {
        for (std::size_t i = 0; i < plant_.parameters.size(); ++i)
            start_with(add(fmi_parameter, i, plant_.parameters[i], "parameter", "tunable"), subject_.parameter_defaults[i]);
    }

    void add_indicators() {
        for (std::size_t i = 0; i < indicators_.size(); ++i)
            add(fmi_indicator, i, indicators_[i].first, indicators_[i].second, "local", "continuous", false);
    }

    void add_energies() {
        static constexpr const char* names[fmi_energies][3] = {{"kinetic_energy", "J", "kinetic energy"},
                                                               {"potential_energy", "J", "potential energy"},
                                                               {"internal_energy", "J", "internal energy"},
                                                               {"supplied_power", "W", "power that inputs and forces supply"},
                                                               {"dissipated_power", "W", "power that friction and dampers take"},
                                                               {"prescribed_power", "W", "power of prescribed motions"},
                                                               {"exchanged_power", "W", "power that flows and heat bring"}};
        for (std::size_t i = 0; i < fmi_energies; ++i)
            add(fmi_energy, i, names[i][0], names[i][2], "local", "continuous", false).unit = names[i][1];
    }

    void add_mode() {
        std::string doc = "mode of the machine:";
        for (std::size_t i = 0; i < model_.modes.size(); ++i) doc += fmt::format("{} {} {}", i == 0 ? "" : ",", i, model_.modes[i]);
        FmiVariable& mode = add(fmi_mode, 0, "mode", doc, "local", "discrete", false);
        mode.type = FmiVariable::Type::mode;
        mode.initial = "calculated";
    }

    // --- what depends on what -----------------------------------------------------------------------------------------------------------

    std::size_t place(enum fmi_kind kind, std::size_t index) const { return places_.at(kind) + index; }

    void depend(std::vector<std::vector<std::size_t>>& rows, const PlantPattern& pattern, enum fmi_kind kind) const {
        for (std::size_t j = 0; j < pattern.columns; ++j)
            for (std::size_t k = pattern.column_starts[j]; k < pattern.column_starts[j + 1]; ++k)
                rows[pattern.row_indices[k]].push_back(place(kind, j));
    }

    /// Outputs by columns of C or D. False if that cannot be told.
    bool depend(std::vector<std::vector<std::size_t>>& rows, const char* function, const char* matrix, std::size_t columns,
                enum fmi_kind kind) const {
        const std::size_t count = plant_.outputs.size();
        const auto is_it = [&](const PlantFunction& f) { return f.name == function; };
        const auto found = std::find_if(plant_.functions.begin(), plant_.functions.end(), is_it);
        if (columns == 0) return true;
        if (found == plant_.functions.end() || subject_.machine.fields) return false;
        const auto stored = stored_entries(found->body.statements, matrix, count * columns);
        for (std::size_t i = 0; stored && i < count; ++i)
            for (std::size_t j = 0; j < columns; ++j)
                if ((*stored)[j * count + i]) rows[i].push_back(place(kind, j));
        return stored.has_value();
    }

    void add_structure() {
        const std::size_t n = plant_.states.size();
        using Rows = std::vector<std::vector<std::size_t>>;
        Rows rates(n), starts(n), outputs(plant_.outputs.size());
        depend(rates, plant_.by_state, fmi_state);
        depend(rates, plant_.by_input, fmi_input);
        const auto is_approx = [](const FmiVariable& v) { return v.initial == "approx"; };
        const bool knows_starts = std::none_of(model_.variables.begin(), model_.variables.end(), is_approx);
        starts = rates;
        depend(starts, plant_.by_parameter, fmi_parameter);
        const bool knows_outputs = depend(outputs, "output_jacobian_x", "C", n, fmi_state) &&
                                   depend(outputs, "output_jacobian_u", "D", plant_.inputs.size(), fmi_input);
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            model_.outputs.push_back({place(fmi_output, i), {}});
            if (knows_outputs) model_.outputs.back().dependencies = std::move(outputs[i]);
        }
        for (std::size_t i = 0; i < n; ++i) model_.derivatives.push_back({place(fmi_derivative, i), std::move(rates[i])});
        // At the start states are known, unless they follow from others themselves. What outputs get from parameters is not told apart.
        for (std::size_t i = 0; i < n; ++i)
            if (is_approx(model_.variables[place(fmi_state, i)])) model_.initial.push_back({place(fmi_state, i), {}});
        for (std::size_t i = 0; i < n; ++i) {
            model_.initial.push_back({place(fmi_derivative, i), {}});
            if (knows_starts) model_.initial.back().dependencies = std::move(starts[i]);
        }
        for (std::size_t i = 0; i < plant_.outputs.size(); ++i) model_.initial.push_back({place(fmi_output, i), {}});
        if (version_ == FmiVersion::three)
            for (std::size_t i = 0; i < indicators_.size(); ++i) model_.indicators.push_back({place(fmi_indicator, i), {}});
    }

    void add_units() {
        std::set<std::string> names;
        for (const FmiVariable& variable : model_.variables)
            if (!variable.unit.empty()) names.insert(variable.unit);
        for (const std::string& name : names) model_.units.push_back(unit_of(name));
    }

    /// The end of the run that `simulate` makes of this scene, or else of the first run of it.
    std::optional<double> end_of_reference() const {
        const System& system = *subject_.machine.system;
        const Model& model = subject_.machine.loaded->model;
        const auto is_here = [&](const Run& run) { return run.scene.empty() || run.scene == plant_.scene; };
        const Run* run = find_run(model, "");
        if (run == nullptr || !is_here(*run)) {
            const auto first = std::find_if(model.runs.begin(), model.runs.end(), is_here);
            run = first == model.runs.end() ? nullptr : &*first;
        }
        if (run == nullptr || !run->until) return {};
        const Values values(system.scene, system.translate);
        const auto end = value_at(system.translate(*run->until, {}), values.substitution(), 20);
        return end ? std::optional(cln::double_approx(*end)) : std::nullopt;
    }

    const ExportSubject& subject_;
    const Plant& plant_;
    FmiVersion version_;
    std::vector<std::pair<std::string, std::string>> indicators_;
    fmi_layout layout_;
    std::map<int, std::size_t> places_;  ///< where the variables of a kind begin
    std::set<std::string> names_;
    FmiModel model_;
};

}  // namespace

FmiModel fmi_model(const ExportSubject& subject, FmiVersion version) { return ModelMaker(subject, version).run(); }

}  // namespace dalembert

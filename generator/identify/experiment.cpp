// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "check/written_values.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "language/parser.hpp"
#include "run/recorded_columns.hpp"
#include "run/run_preparation.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

class ExperimentReader {
public:
    ExperimentReader(const DataFile& file, const DataOptions& options, const System& system)
        : file_(file), options_(options), system_(system) {
        result_.name = std::filesystem::path(file.source->name()).filename().string();
    }

    Experiment operator()() {
        times();
        for (const DataColumn& column : file_.columns)
            if (!column.name.empty() && &column != time_) take(column);
        for (const std::string& name : options_.measured)
            if (!is_measured(name))
                throw Failure(Diagnostic{Id::unknown_name, Span{file_.source, 0, 0},
                                         fmt::format("the data have no column '{}' to compare with the run; their columns are {}", name,
                                                     quoted_list(file_.names()))});
        if (result_.measured.empty())
            throw Failure(Diagnostic{Id::missing_key, file_.columns.front().place,
                                     fmt::format("no column is an output, coordinate, velocity or state of scene '{}', so there is nothing "
                                                 "to compare; the columns are {}",
                                                 system_.scene.name, quoted_list(file_.names()))});
        return std::move(result_);
    }

private:
    void times() {
        for (const DataColumn& column : file_.columns)
            if (name_of(column) == "t" && measurement_of(column) != nullptr) time_ = &column;
        for (const char* name : {"t", "time"})
            if (time_ == nullptr) time_ = file_.find(name);
        if (time_ == nullptr)
            throw Failure(
                Diagnostic{Id::missing_key, file_.columns.front().place,
                           fmt::format("the data have no column 't' with the time; their columns are {}", quoted_list(file_.names()))});
        const Unit second{Dimension::time(), 1, 0, 0, "s"};
        const std::vector<double> t = in_si(*time_, second);
        for (std::size_t i = 0; i < t.size(); ++i) {
            if (!std::isfinite(t[i])) throw Failure(Diagnostic{Id::missing_key, file_.place(i), "the time is missing in this line"});
            if (i > 0 && !(t[i] > t[i - 1]))
                throw Failure(Diagnostic{Id::value_out_of_range, file_.place(i),
                                         fmt::format("the time {:.9g} s is not behind that of the line before, {:.9g} s", t[i], t[i - 1])});
            result_.t.push_back(t[i] - t.front());
        }
        if (t.size() < 2)
            throw Failure(
                Diagnostic{Id::missing_key, file_.place(0), "there is one line of numbers alone, and a run has a begin and an end"});
    }

    /// What the model says of a column; null where it says nothing.
    const Measurement* measurement_of(const DataColumn& column) const {
        for (const Measurement& one : system_.scene.model->measurements)
            if ((one.column.empty() ? quantity_of(one) : one.column) == column.name) return &one;
        return nullptr;
    }
    static const std::string& quantity_of(const Measurement& one) { return one.quantity.empty() ? one.name : one.quantity; }
    std::string name_of(const DataColumn& column) const {
        const Measurement* said = measurement_of(column);
        return said != nullptr ? quantity_of(*said) : column.name;
    }

    void take(const DataColumn& column) {
        const std::string name = name_of(column);
        for (const DataColumn& other : file_.columns)
            if (&other < &column && name_of(other) == name)
                throw Failure(Diagnostic{Id::doubly_defined, column.place,
                                         fmt::format("the columns '{}' and '{}' are both '{}'", other.name, column.name, name)});
        refuse_useless(column, name);
        const bool is_start = name.starts_with("start(") && name.ends_with(")");
        const std::string inside = is_start ? name.substr(6, name.size() - 7) : name;
        if (const Variable* parameter = find(SymbolKind::parameter, name)) return constant(column, *parameter, result_.parameters);
        if (is_start)
            for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state})
                if (const Variable* state = find(kind, inside)) return constant(column, *state, result_.starts);
        if (const Variable* input = find(SymbolKind::input, name)) return sampled(column, *input);
        const auto recorded = recorded_names(name, system_);
        const bool is_asked_for = std::find(options_.measured.begin(), options_.measured.end(), name) != options_.measured.end();
        // Energies are recorded, but not declared: hardly anybody measures them.
        if (recorded.size() != 1 || recorded.front() != name || (!is_asked_for && !unit_of(name))) {
            result_.unused.push_back(name);
            return;
        }
        if (!options_.measured.empty() && !is_asked_for) return;
        const std::optional<Unit> unit = unit_of(name);
        Measured measured{name, shown_of_column(name, system_), unit ? in_si(column, *unit) : column.values, noise_of(name, column)};
        if (std::all_of(measured.values.begin(), measured.values.end(), [](double v) { return std::isnan(v); }))
            throw Failure(Diagnostic{Id::missing_key, column.place, fmt::format("the column '{}' has no value at all", name)});
        result_.measured.push_back(std::move(measured));
    }

    /// What the model says of a column that has no use of it.
    void refuse_useless(const DataColumn& column, const std::string& name) const {
        const Measurement* said = measurement_of(column);
        if (said == nullptr) return;
        const bool is_input = find(SymbolKind::input, name) != nullptr, is_parameter = find(SymbolKind::parameter, name) != nullptr;
        if (said->hold && !is_input)
            throw Failure(Diagnostic{Id::not_allowed_here, said->span,
                                     fmt::format("measurement '{}' has hold = true, but '{}' is no input of the scene", said->name, name)});
        if (said->noise && (is_input || is_parameter))
            throw Failure(Diagnostic{Id::not_allowed_here, said->span,
                                     fmt::format("measurement '{}' has a noise, but '{}' is {}, which is not compared with the run",
                                                 said->name, name, is_input ? "an input" : "a parameter")});
    }

    const Variable* find(SymbolKind kind, const std::string& name) const {
        for (const Variable& variable : system_.symbols.all(kind))
            if (variable.recorded_name() == name) return &variable;
        return nullptr;
    }
    bool is_measured(const std::string& name) const {
        return std::any_of(result_.measured.begin(), result_.measured.end(), [&](const Measured& m) { return m.column == name; });
    }

    /// The unit that the model declares, or that it has in SI.
    std::optional<Unit> unit_of(const std::string& name) const {
        const auto declared = declared_unit(*parse_expression(excerpt_of(std::make_shared<const Source>("column", name))), system_.names);
        if (declared) return declared;
        for (const OutputEquation& output : system_.outputs)
            if (output.name == name && !output.unit.empty())
                return parse_unit(excerpt_of(std::make_shared<const Source>("unit", output.unit)));
        return std::nullopt;
    }

    /// Values without a unit count in the declared one.
    std::vector<double> in_si(const DataColumn& column, const Unit& declared) const {
        const Measurement* said = measurement_of(column);
        Unit unit = said != nullptr && said->unit ? *said->unit : declared;
        if (!(unit.dimension == declared.dimension))
            throw Failure(Diagnostic{Id::unit_mismatch, said->span,
                                     fmt::format("the measurement '{}' is in {}, but the model has '{}' in {}", said->name, unit.written,
                                                 quantity_of(*said), declared.written == "1" ? "no unit" : declared.written)});
        if (said != nullptr && said->unit) return converted(column, unit);
        if (!column.unit.empty() && column.unit != declared.written) {
            const std::string& text = column.place.source->text();
            const std::size_t at = text.find(column.unit, text.find('[', column.place.begin));
            unit = parse_unit(excerpt_of(column.place.source, at, at + column.unit.size()));
            if (!(unit.dimension == declared.dimension))
                throw Failure(Diagnostic{Id::unit_mismatch, column.place,
                                         fmt::format("the column '{}' is in {}, but the model has it in {}", column.name, column.unit,
                                                     declared.written == "1" ? "no unit" : declared.written)});
        }
        return converted(column, unit);
    }
    static std::vector<double> converted(const DataColumn& column, const Unit& unit) {
        const ShownNumber shown = shown_in(unit);
        std::vector<double> values = column.values;
        for (double& value : values) value = (value + shown.offset) * shown.of_declared;
        return values;
    }

    void constant(const DataColumn& column, const Variable& variable, std::vector<Setting>& settings) const {
        for (std::size_t i = 0; i < column.values.size(); ++i)
            if (!(column.values[i] == column.values.front()))
                throw Failure(
                    Diagnostic{Id::value_out_of_range, file_.place(i),
                               fmt::format("'{}' must have one value in an experiment, but has {:.9g} here and {:.9g} in the first line",
                                           column.name, column.values[i], column.values.front())});
        const std::string name = variable.recorded_name();
        const double value = in_si(column, *unit_of(name)).front();
        const std::string unit = unit_of(name)->si();
        const std::string text = fmt::format("{}={}{}", name, value, unit == "1" ? "" : " " + unit);
        for (Setting& setting : parse_settings({text}, column.name)) settings.push_back(setting);
    }

    void sampled(const DataColumn& column, const Variable& input) {
        const std::vector<double> values = in_si(column, *unit_of(input.name));
        SampledInput one;
        one.input = input.position;
        const Measurement* said = measurement_of(column);
        one.is_held =
            (said != nullptr && said->hold) || std::find(options_.held.begin(), options_.held.end(), input.name) != options_.held.end();
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isnan(values[i])) continue;
            one.times.push_back(result_.t[i]);
            one.values.push_back(values[i]);
        }
        if (std::isnan(values.front()) || std::isnan(values.back()))
            throw Failure(Diagnostic{
                Id::missing_key, column.place,
                fmt::format("the input '{}' is missing where the data {}", input.name, std::isnan(values.front()) ? "begin" : "end")});
        result_.inputs.push_back(std::move(one));
    }

    /// Of the command line, or else of the model.
    double noise_of(const std::string& name, const DataColumn& column) const {
        for (const Setting& setting : options_.noise)
            if (setting.variable->written() == name) return noise_in_si(setting.value, name, unit_of(name).value_or(Unit{}));
        const Measurement* said = measurement_of(column);
        if (said == nullptr || !said->noise) return 0;
        return noise_in_si(said->noise, name, said->unit ? *said->unit : unit_of(name).value_or(Unit{}));
    }
    double noise_in_si(const ExpressionPtr& written, const std::string& name, const Unit& unit) const {
        return deviation_in_si(written, unit, fmt::format("the noise of '{}'", name), system_);
    }

    const DataFile& file_;
    const DataOptions& options_;
    const System& system_;
    const DataColumn* time_ = nullptr;
    Experiment result_;
};

}  // namespace

Experiment experiment_of(const DataFile& file, const DataOptions& options, const System& system) {
    return ExperimentReader(file, options, system)();
}

}  // namespace dalembert

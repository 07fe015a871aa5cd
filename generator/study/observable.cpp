// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/observable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "language/parser.hpp"
#include "run/recorded_columns.hpp"
#include "run/settings.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr std::array of_runs{
    ObserverSpec{"end(x)", "value of an expression at the end of the run; x alone means the same"},
    ObserverSpec{"start(x)", "its value where the run begins"},
    ObserverSpec{"max(x)", "its largest value at the samples of the run"},
    ObserverSpec{"min(x)", "its smallest value there"},
    ObserverSpec{"time(EVENT)", "time at which an event happens first"},
    ObserverSpec{"count(EVENT)", "number of times that it happens"},
};

struct NumberFunction {
    const char* name;
    double (*of)(double);
    bool is_of_any_unit;  ///< and keeps it
};

constexpr std::array of_numbers{
    NumberFunction{"abs", [](double x) { return std::fabs(x); }, true},
    NumberFunction{"exp", [](double x) { return std::exp(x); }, false},
    NumberFunction{"log", [](double x) { return std::log(x); }, false},
    NumberFunction{"sin", [](double x) { return std::sin(x); }, false},
    NumberFunction{"cos", [](double x) { return std::cos(x); }, false},
    NumberFunction{"tan", [](double x) { return std::tan(x); }, false},
    NumberFunction{"asin", [](double x) { return std::asin(x); }, false},
    NumberFunction{"acos", [](double x) { return std::acos(x); }, false},
    NumberFunction{"atan", [](double x) { return std::atan(x); }, false},
};

/// A value with its dimension, of a row or of a whole run.
template <class From>
struct Measured {
    std::function<double(const From&)> value;
    Dimension dimension;
    std::string unit = {};  ///< of a column alone
};

using Row = ReadRow;

class ObservableReader {
public:
    explicit ObservableReader(const System& system) : system_(system), columns_(recorded_columns(system)) {}

    void read(const ExpressionPtr& e) {
        const auto whole = of<ObservedRun>(*e);
        std::string unit = whole.unit;
        if (unit.empty() && !whole.dimension.is_none()) unit = whole.dimension.in_base_units();
        result_.list.push_back({column_of(*e) ? "end(" + e->written() + ")" : e->written(), unit == "1" ? "" : unit, whole.value});
    }
    Observables take() { return std::move(result_); }

private:
    [[noreturn]] static void refuse(const Expression& e, std::string sentence, Id id = Id::bad_option) {
        throw Failure(Diagnostic{id, e.span, std::move(sentence)});
    }

    template <class From>
    Measured<From> of(const Expression& e) {
        using Kind = Expression::Kind;
        switch (e.kind) {
            case Kind::number: {
                const double value = cln::double_approx(e.value);
                const Dimension dimension = e.name.empty() ? Dimension() : dimension_of(e.name);
                return {[value](const From&) { return value; }, dimension};
            }
            case Kind::negate: {
                auto a = of<From>(*e.children[0]);
                return {[v = a.value](const From& from) { return -v(from); }, a.dimension, a.unit};
            }
            case Kind::add:
                return sum<From>(e, [](double a, double b) { return a + b; });
            case Kind::subtract:
                return sum<From>(e, [](double a, double b) { return a - b; });
            case Kind::multiply: {
                auto [a, b] = both<From>(e);
                return {[v = a.value, w = b.value](const From& from) { return v(from) * w(from); }, a.dimension * b.dimension};
            }
            case Kind::divide: {
                auto [a, b] = both<From>(e);
                return {[v = a.value, w = b.value](const From& from) { return v(from) / w(from); }, a.dimension / b.dimension};
            }
            case Kind::power:
                return power<From>(e);
            case Kind::call:
            case Kind::name:
                break;
            case Kind::sum:
                refuse(e, "a study observes no sums over an index");
        }
        if constexpr (std::is_same_v<From, Row>) {
            if (const auto column = column_of(e)) return *column;
        } else {
            if (const auto of_run = observed(e)) return *of_run;
            if (const auto column = column_of(e)) return at_end(*column);
        }
        return function<From>(e);
    }

    template <class From>
    std::pair<Measured<From>, Measured<From>> both(const Expression& e) {
        return {of<From>(*e.children[0]), of<From>(*e.children[1])};
    }

    template <class From, class Operation>
    Measured<From> sum(const Expression& e, Operation operation) {
        auto [a, b] = both<From>(e);
        if (!(a.dimension == b.dimension))
            refuse(e,
                   fmt::format("'{}' is in {}, but '{}' is in {}", e.children[0]->written(), a.dimension.usual_unit(),
                               e.children[1]->written(), b.dimension.usual_unit()),
                   Id::unit_mismatch);
        return {[v = a.value, w = b.value, operation](const From& from) { return operation(v(from), w(from)); }, a.dimension,
                a.unit == b.unit ? a.unit : ""};
    }

    template <class From>
    Measured<From> power(const Expression& e) {
        auto [a, b] = both<From>(e);
        Dimension dimension;
        if (!a.dimension.is_none()) {
            const bool is_negative = e.children[1]->kind == Expression::Kind::negate;
            const Expression& number = is_negative ? *e.children[1]->children[0] : *e.children[1];
            const bool is_number = number.kind == Expression::Kind::number;
            const double exponent = (is_negative ? -1 : 1) * (is_number ? cln::double_approx(number.value) : 0);
            if (!is_number || 2 * exponent != std::floor(2 * exponent) || std::fabs(exponent) > 100)
                refuse(e, fmt::format("'{}' has a unit, so its exponent must be a whole or half number", e.children[0]->written()),
                       Id::unit_mismatch);
            dimension = a.dimension.raised(Fraction::reduced(static_cast<long long>(2 * exponent), 2));
        }
        return {[v = a.value, w = b.value](const From& from) { return std::pow(v(from), w(from)); }, dimension};
    }

    template <class From>
    Measured<From> function(const Expression& e) {
        if (e.kind == Expression::Kind::name) unknown(e);
        std::vector<Measured<From>> arguments;
        const auto known = std::find_if(of_numbers.begin(), of_numbers.end(), [&](const NumberFunction& f) { return f.name == e.name; });
        const bool is_of_two = e.name == "max" || e.name == "min";
        if (known == of_numbers.end() && e.name != "sqrt" && !is_of_two) unknown(e);
        if (e.children.size() != (is_of_two ? 2 : 1))
            refuse(e, fmt::format("'{}' takes {} here", e.name, is_of_two ? "two arguments" : "one argument"), Id::wrong_arguments);
        for (const ExpressionPtr& child : e.children) arguments.push_back(of<From>(*child));
        const auto a = arguments[0].value;
        const Dimension& dimension = arguments[0].dimension;
        if (is_of_two) {
            const bool is_largest = e.name == "max";
            return sum<From>(e, [is_largest](double x, double y) { return is_largest ? std::max(x, y) : std::min(x, y); });
        }
        if (e.name == "sqrt") return {[a](const From& from) { return std::sqrt(a(from)); }, dimension.raised({1, 2})};
        if (!known->is_of_any_unit && !dimension.is_none())
            refuse(*e.children[0],
                   fmt::format("'{}' is in {}, but '{}' takes a number without a unit", e.children[0]->written(), dimension.usual_unit(),
                               e.name),
                   Id::unit_mismatch);
        return {[a, f = known->of](const From& from) { return f(a(from)); }, known->is_of_any_unit ? dimension : Dimension(),
                known->is_of_any_unit ? arguments[0].unit : ""};
    }

    [[noreturn]] void unknown(const Expression& e) const {
        std::vector<std::string> known;
        for (const RecordedColumn& column : columns_) known.push_back(column.name);
        const std::string family = e.written() + "[";
        for (const std::string& name : known)
            if (name.starts_with(family)) refuse(e, fmt::format("'{}' is a family; name a member, as in '{}'", e.written(), name));
        std::string forms;
        for (const ObserverSpec& one : of_runs) forms += fmt::format("{}{}", forms.empty() ? "" : ", ", one.written);
        refuse(e,
               fmt::format("'{}' is not recorded in scene '{}'{}; a study observes {} and expressions of these", e.written(),
                           system_.scene.name, did_you_mean(e.written(), known), forms),
               Id::unknown_name);
    }

    static Dimension dimension_of(const std::string& unit) {
        return unit.empty() ? Dimension() : parse_unit(excerpt_of(std::make_shared<const Source>("unit", unit))).dimension;
    }

    std::optional<Measured<Row>> column_of(const Expression& e) {
        std::string written = e.written();
        written.erase(std::remove(written.begin(), written.end(), ' '), written.end());
        for (std::size_t i = 0; i < columns_.size(); ++i)
            if (columns_[i].name == written) {
                return Measured<Row>{[k = read_column(written)](const Row& row) { return row[k]; }, dimension_of(columns_[i].unit),
                                     columns_[i].unit};
            }
        return std::nullopt;
    }

    /// Its place in the rows that observables see.
    std::size_t read_column(const std::string& name) {
        const auto is_one_of = [&](const auto& list) {
            return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
        };
        result_.read_outputs = result_.read_outputs || is_one_of(system_.outputs);
        const bool is_energy = std::find(recorded_energies.begin(), recorded_energies.end(), name) != recorded_energies.end();
        result_.read_energies = result_.read_energies || is_energy;
        const auto found = std::find(result_.columns.begin(), result_.columns.end(), name);
        const auto place = static_cast<std::size_t>(found - result_.columns.begin());
        if (found == result_.columns.end()) result_.columns.push_back(name);
        return place;
    }

    static Measured<ObservedRun> at_end(const Measured<Row>& of_row) {
        return {[v = of_row.value](const ObservedRun& run) { return run.end.empty() ? none : v(run.end); }, of_row.dimension, of_row.unit};
    }
    Measured<ObservedRun> of_rows(RowObserver::Kind kind, const Measured<Row>& of_row) {
        const std::size_t number = result_.of_rows.size();
        result_.of_rows.push_back({kind, of_row.value});
        return {[number](const ObservedRun& run) { return run.of_rows[number]; }, of_row.dimension, of_row.unit};
    }

    std::optional<Measured<ObservedRun>> observed(const Expression& e) {
        if (e.kind != Expression::Kind::call || e.children.size() != 1) return std::nullopt;
        const Expression& argument = *e.children[0];
        if (e.name == "time" || e.name == "count") return of_event(e, argument);
        if (e.name == "end") return at_end(of<Row>(argument));
        if (e.name == "start") return of_rows(RowObserver::first, of<Row>(argument));
        if (e.name == "max") return of_rows(RowObserver::largest, of<Row>(argument));
        if (e.name == "min") return of_rows(RowObserver::smallest, of<Row>(argument));
        return std::nullopt;
    }

    Measured<ObservedRun> of_event(const Expression& e, const Expression& named) const {
        std::vector<std::string> known;
        for (const EventEquation& event : system_.events) known.push_back(event.name);
        const std::string name = named.written();
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end())
            refuse(named,
                   system_.scene.modes.empty()
                       ? fmt::format("scene '{}' does not switch, so no event '{}' is recorded", system_.scene.name, name)
                       : fmt::format("scene '{}' has no event '{}'; its events are {}", system_.scene.name, name, quoted_list(known)),
                   Id::unknown_name);
        const auto number = static_cast<std::size_t>(found - known.begin());
        if (e.name == "count")
            return {[number](const ObservedRun& run) {
                        const auto& events = run.events;
                        return static_cast<double>(
                            std::count_if(events.begin(), events.end(), [&](const EventOfRun& event) { return event.event == number; }));
                    },
                    Dimension()};
        return {[number](const ObservedRun& run) {
                    const auto& events = run.events;
                    const auto first =
                        std::find_if(events.begin(), events.end(), [&](const EventOfRun& event) { return event.event == number; });
                    return first == events.end() ? none : first->t;
                },
                Dimension::time(), "s"};
    }

    const System& system_;
    std::vector<RecordedColumn> columns_;
    Observables result_;
};

}  // namespace

std::span<const ObserverSpec> observers() { return of_runs; }

Observables read_observables(const std::vector<std::string>& texts, const System& system) {
    std::vector<std::string> wanted = texts;
    if (wanted.empty()) {
        for (const Variable* state : system.symbols.state_variables()) wanted.push_back(state->recorded_name());
        for (const OutputEquation& output : system.outputs) wanted.push_back(output.name);
    }
    ObservableReader reader(system);
    for (const std::string& text : wanted) {
        const auto source = std::make_shared<const Source>("--observe", text);
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = end_of_part(text, begin);
            reader.read(parse_expression(excerpt_of(source, begin, end)));
            begin = end + 1;
        }
    }
    return reader.take();
}

PlantRunResult Observables::observe(const dalembert_plant& plant, PlantRun run, std::vector<double>& values) const {
    std::vector<std::size_t> places;
    ReadRow read(columns.size());
    const auto read_last = [&](const Recording& recording) {
        if (places.empty())
            for (const std::string& column : columns) places.push_back(recording.find(column));
        for (std::size_t k = 0; k < places.size(); ++k) read[k] = recording.rows.back().at(places[k]);
    };
    std::vector<double> kept(of_rows.size(), none);
    run.keeps_all = false;
    run.asks_outputs = read_outputs;
    run.asks_energies = read_energies;
    if (!of_rows.empty())
        run.see_row = [&, is_first = true](const Recording& recording) mutable {
            read_last(recording);
            for (std::size_t i = 0; i < kept.size(); ++i) {
                const RowObserver& one = of_rows[i];
                if (one.kind == RowObserver::first && !is_first) continue;
                const double value = one.value(read);
                const bool is_further = one.kind == RowObserver::smallest ? value >= kept[i] : value <= kept[i];
                if (one.kind == RowObserver::first || !is_further) kept[i] = value;
            }
            is_first = false;
        };
    const PlantRunResult result = simulate_plant(plant, run);
    if (result.recording.rows.empty()) read.clear();
    else read_last(result.recording);
    for (std::size_t i = 0; i < list.size(); ++i) values[i] = list[i].value({result.events, read, kept});
    return result;
}

}  // namespace dalembert

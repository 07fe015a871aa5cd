// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/written_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/units.hpp"
#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/model.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

const Unit second{Dimension::time(), 1, 0, 0, "s"};

Unit in_si_of(const Dimension& dimension) { return {dimension, 1, 0, 0, dimension.in_base_units()}; }

/// An angle in rad, whatever it is made of.
bool is_angle(const Expression& e) {
    return e.kind == Kind::call && (e.name == "asin" || e.name == "acos" || e.name == "atan" || e.name == "atan2");
}

/// The value of a curve, in SI, whatever its argument is made of.
bool is_of_curve(const Expression& e) {
    return e.kind == Kind::call && find_function(e.name) == nullptr && find_quantity(e.name) == nullptr;
}

/// What is declared in deg or percent has no dimension that would tell a number of these from an angle in rad or a share.
class Share {
public:
    enum Sort { number, unclear, measured };  ///< a number that counts in the declared unit; neither clearly; SI

    explicit Share(const Names& names) : names_(names) {}

    Sort operator()(const Expression& e) {
        switch (e.kind) {
            case Kind::number: return e.name.empty() ? number : measured;
            case Kind::name: return name(e);
            case Kind::call: return call(e);
            case Kind::power: return (*this)(*e.children[0]);
            case Kind::sum: return (*this)(*e.children[2]);
            default: break;
        }
        Sort result = number;
        for (const ExpressionPtr& child : e.children) result = std::max(result, (*this)(*child));
        if (e.kind != Kind::add && e.kind != Kind::subtract) return result;
        // beta + 10 is neither in deg nor in rad; beta + pi/2 is in rad.
        for (const ExpressionPtr& child : e.children)
            if (result == measured && is_plain_number(*child) && !mentions_pi(*child) &&
                !(child->kind == Kind::number && is_zero(child->value)))
                return unclear;
        return result;
    }

private:
    static bool mentions_pi(const Expression& e) {
        bool found = false;
        for_each(e, [&](const Expression& part) { found = found || (part.kind == Kind::name && part.name == "pi"); });
        return found;
    }

    Sort name(const Expression& e) {
        const Named* named = names_.find(e.name);
        if (e.name == "pi" || e.name == "t" || (named == nullptr && find_quantity(e.name) == nullptr)) return number;
        if (named == nullptr) return measured;
        if (named->kind == Named::Kind::size || named->kind == Named::Kind::mode) return number;
        if (named->kind == Named::Kind::definition && !named->definition().unit)
            return depth_++ > 50 ? unclear : (*this)(*named->definition().value);
        const auto unit = declared_unit(e, names_);
        return unit && unit->written == "1" ? unclear : measured;
    }

    Sort call(const Expression& e) {
        const FunctionSpec* function = find_function(e.name);
        if (function == nullptr) return measured;
        if (is_angle(e)) return measured;
        if (function->units == UnitRule::dimensionless || function->units == UnitRule::sign) return number;
        Sort result = number;
        for (const ExpressionPtr& child : e.children) result = std::max(result, (*this)(*child));
        return result;
    }

    const Names& names_;
    int depth_ = 0;
};

bool mentions_time(const Expression& e) {
    bool found = false;
    for_each(e, [&](const Expression& part) { found = found || (part.kind == Kind::name && part.name == "t"); });
    return found;
}

/// Gives a number alone the declared unit.
void give_unit(ExpressionPtr& value, const std::optional<Unit>& unit) {
    if (!value || !unit || (unit->is_coherent() && unit->dimension.is_none()) || !is_plain_number(*value)) return;
    const Span span = value->span;
    value = to_si(value, *unit);
    Expression one{Kind::number, span, 1, unit->si()};
    if (value->kind == Kind::number) one.value = value->value;
    const auto measured = std::make_shared<const Expression>(std::move(one));
    value = value->kind == Kind::number ? measured : make_binary(Kind::multiply, value, measured);
}

/// Visits every value of a model that has a declared unit.
class Conversion {
public:
    Conversion(Model& model, Diagnostics& diagnostics) : model_(model), names_(model), diagnostics_(diagnostics) {}

    void run() {
        for (Parameter& parameter : model_.parameters) {
            values_of(parameter.values, parameter.unit, "the value", "parameter", parameter);
            range(parameter, "parameter");
        }
        for (Coordinate& coordinate : model_.coordinates) {
            values_of(coordinate.start, coordinate.unit, "the start", "coordinate", coordinate);
            values_of(coordinate.start_rate, rate_of(coordinate.unit), "the start rate", "coordinate", coordinate);
            range(coordinate, "coordinate");
        }
        for (Input& input : model_.inputs) range(input, "input");
        for (State& state : model_.states) {
            values_of(state.start, state.unit, "the start", "state", state);
            range(state, "state");
        }
        for (Attitude& attitude : model_.attitudes) {
            for (ExpressionPtr& part : attitude.start) value_of(part, {}, "the start", "attitude", attitude);
            for (ExpressionPtr& rate : attitude.start_rate)
                value_of(rate, in_si_of(Dimension::none() / Dimension::time()), "the start rate", "attitude", attitude);
        }
        for (PotentialTerm& term : model_.potentials)
            for (CoordinateEntry& entry : term.reference)
                if (const Named* named = names_.find(entry.coordinate); named != nullptr)
                    written(entry.value, named->quantity().unit, fmt::format("the reference of potential '{}'", term.name));
        for (Run& run : model_.runs) convert(run);
    }

    void formulas() {
        for (Definition& definition : model_.definitions) give_unit(definition.value, definition.unit);
        for (Output& output : model_.outputs) give_unit(output.value, output.unit);
        for (Event& event : model_.events) {
            resets(event.reset);
            resets(event.rest_reset);
        }
        for (Profile& profile : model_.profiles)
            for (Phase& phase : profile.phases) resets(phase.reset);
        for (PrintedEquation& printed : model_.printed) convert_numbers(printed.at, names_);
    }

private:
    static Unit rate_of(Unit unit) {
        unit.dimension = unit.dimension / Dimension::time();
        unit.offset = 0;
        return unit;
    }

    void written(ExpressionPtr& value, const Unit& unit, const std::string& what) {
        if (value) value = in_si(value, unit, what, names_, diagnostics_);
    }

    /// What is a plain number was converted when it was read.
    void value_of(ExpressionPtr& value, const Unit& unit, const char* part, const char* kind, const Item& item) {
        if (value && !is_plain_number(*value)) written(value, unit, fmt::format("{} of {} '{}'", part, kind, item.name));
    }

    void values_of(MemberValues& values, const Unit& unit, const char* part, const char* kind, const Item& item) {
        for (ExpressionPtr& value : values) value_of(value, unit, part, kind, item);
    }

    void range(Quantity& quantity, const char* kind) {
        if (!quantity.range) return;
        value_of(quantity.range->low, quantity.unit, "the range", kind, quantity);
        value_of(quantity.range->high, quantity.unit, "the range", kind, quantity);
    }

    void resets(std::vector<RunEntry>& entries) const {
        for (RunEntry& entry : entries) give_unit(entry.value, declared_unit(*entry.variable, names_));
    }

    void convert(Run& run) {
        for (const auto& [value, part] : {std::pair{&run.until, "end"}, {&run.period, "period"}, {&run.step, "step"}})
            if (*value && !is_plain_number(**value)) written(*value, second, fmt::format("the {} of run '{}'", part, run.name));
        for (auto* entries : {&run.start, &run.inputs, &run.parameters, &run.exact})
            for (RunEntry& entry : *entries)
                if (const auto unit = declared_unit(*entry.variable, names_))
                    written(entry.value, *unit, fmt::format("the value of '{}' in run '{}'", entry.variable->written(), run.name));
    }

    Model& model_;
    Names names_;
    Diagnostics& diagnostics_;
};

}  // namespace

bool is_plain_number(const Expression& expression) {
    bool plain = true;
    for_each(expression, [&](const Expression& e) {
        if ((e.kind == Kind::name && e.name != "pi") || (e.kind == Kind::number && !e.name.empty()) || is_angle(e) || is_of_curve(e))
            plain = false;
    });
    return plain;
}

std::optional<Unit> declared_unit(const Expression& variable, const Names& names) {
    if (variable.kind == Kind::call && (variable.name == "dot" || variable.name == "ddot") && variable.children.size() == 1) {
        auto unit = declared_unit(*variable.children[0], names);
        if (!unit) return unit;
        for (int i = variable.name == "dot" ? 1 : 2; i > 0; --i) {
            unit->dimension = unit->dimension / Dimension::time();
            unit->written = unit->written.find('/') == std::string::npos ? unit->written + "/s" : "(" + unit->written + ")/s";
        }
        unit->offset = 0;
        return unit;
    }
    const Named* named = variable.kind == Kind::name ? names.find(variable.name) : nullptr;
    if (named == nullptr || named->kind == Named::Kind::size || named->kind == Named::Kind::mode) return std::nullopt;
    if (named->kind == Named::Kind::output && static_cast<const Output*>(named->item)->unit)
        return static_cast<const Output*>(named->item)->unit;
    if (named->kind == Named::Kind::definition && named->definition().unit) return named->definition().unit;
    if (named->kind != Named::Kind::output && named->kind != Named::Kind::definition) return named->quantity().unit;
    Diagnostics silent;
    const Measure measure = Units(names, silent).of(variable, {});
    return measure.fits_all ? std::nullopt : std::optional(in_si_of(measure.dimension));
}

ExpressionPtr in_si(const ExpressionPtr& value, const Unit& declared, const std::string& what, const Names& names,
                    Diagnostics& diagnostics) {
    if (is_plain_number(*value)) return to_si(value, declared);
    // The time is 1 s or the number 1, whichever fits: v*t is a length, and sin(3*t) a number.
    bool disagrees = false;
    for (const bool is_time_plain : {false, true}) {
        if (is_time_plain && !mentions_time(*value)) break;
        Diagnostics silent;
        const Measure measure = Units(names, silent, is_time_plain).of(*value, {});
        if (silent.has_errors()) {
            disagrees = disagrees || !is_time_plain;
            continue;
        }
        if (measure.dimension == declared.dimension && !measure.dimension.is_none()) return value;
        if (!measure.dimension.is_none() && !measure.fits_all) continue;
        const Share::Sort sort = declared.is_coherent()                             ? Share::number
                                 : declared.dimension.is_none() || measure.fits_all ? Share(names)(*value)
                                                                                    : Share::number;
        if (sort == Share::number) return to_si(value, declared);
        if (sort == Share::measured || measure.fits_all) return value;
        diagnostics.error(Id::unit_mismatch, value->span,
                          fmt::format("{} is declared in '{}', so '{}' could be in this unit or in '{}'; multiply it by (1 {}) or (1 {})",
                                      what, declared.written, value->written(), declared.si(), declared.written, declared.si()));
        return value;
    }
    const std::size_t before = diagnostics.all().size();
    Units(names, diagnostics, disagrees && mentions_time(*value)).expect(*value, declared.dimension, what);
    if (diagnostics.all().size() == before) Units(names, diagnostics).expect(*value, declared.dimension, what);
    return value;
}

ExpressionPtr in_si(const ExpressionPtr& value, const Unit& declared, const std::string& what, const Names& names) {
    Diagnostics diagnostics;
    ExpressionPtr result = in_si(value, declared, what, names, diagnostics);
    diagnostics.stop_on_errors();
    return result;
}

void convert_numbers(std::vector<AtPoint>& points, const Names& names) {
    for (AtPoint& point : points) give_unit(point.value, declared_unit(*point.variable, names));
}

void convert_numbers(Model& model) {
    Diagnostics none;
    Conversion(model, none).formulas();
}

void convert_values(Model& model, Diagnostics& diagnostics) { Conversion(model, diagnostics).run(); }

}  // namespace dalembert

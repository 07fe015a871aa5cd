// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fitted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "check/written_values.hpp"
#include "language/parser.hpp"
#include "run/recorded_columns.hpp"
#include "run/run_preparation.hpp"
#include "run/settings.hpp"
#include "run/varied.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

struct FitWord {
    const char* name;
    Fitted::What what;
};
constexpr FitWord fit_words[] = {{"start", Fitted::What::start}, {"offset", Fitted::What::offset}, {"delay", Fitted::What::delay}};

/// The name inside of "start(phi)", and what it is.
std::pair<Fitted::What, ExpressionPtr> read_part(const Excerpt& part) {
    for (const FitWord& function : fit_words) {
        const std::string head = std::string(function.name) + "(";
        if (!part.text.starts_with(head) || !part.text.ends_with(")")) continue;
        const Span inside = part.span(head.size(), part.text.size() - 1);
        return {function.what, parse_expression(excerpt_of(inside.source, inside.begin, inside.end))};
    }
    return {Fitted::What::parameter, parse_expression(part)};
}

class FittedReader {
public:
    explicit FittedReader(const System& system) : system_(system) {}

    void read(const Excerpt& part, std::vector<Fitted>& all) const {
        const auto [what, name] = read_part(part);
        switch (what) {
            case Fitted::What::offset:
                return offsets(*name, all);
            case Fitted::What::delay:
                return delays(*name, all);
            default:
                break;
        }
        for (const Variable* variable : variables_to_vary(*name, system_)) {
            const bool is_parameter = variable->kind == SymbolKind::parameter;
            if (is_parameter != (what == Fitted::What::parameter))
                throw Failure(Diagnostic{Id::bad_option, name->span,
                                         is_parameter ? fmt::format("'{0}' is a parameter; write --fit {0}", variable->name)
                                                      : fmt::format("'{0}' is no parameter; for its value at the start write start({0})",
                                                                    variable->recorded_name())});
            Fitted one = named(what, is_parameter ? variable->name : fmt::format("start({})", variable->recorded_name()), name->span);
            one.variable = variable;
            one.shown = shown_of_column(variable->recorded_name(), system_);
            if (variable->declared != nullptr && variable->declared->range) bound(one, *variable->declared->range);
            add(std::move(one), all);
        }
    }

private:
    static Fitted named(Fitted::What what, std::string name, const Span& place) {
        Fitted one{what, nullptr, {}, std::move(name), {}, -infinite, infinite, {}, place};
        return one;
    }
    void add(Fitted one, std::vector<Fitted>& all) const {
        const auto same = [&](const Fitted& other) { return other.name == one.name; };
        if (std::any_of(all.begin(), all.end(), same))
            throw Failure(Diagnostic{Id::bad_option, one.place, fmt::format("'{}' is named twice", one.name)});
        all.push_back(std::move(one));
    }
    void bound(Fitted& one, const Range& range) const {
        const Values defaults(system_.scene, system_.translate);
        const auto number = [&](const ExpressionPtr& e) {
            return double_of(system_.translate(*e, {}).subs(defaults.substitution(), GiNaC::subs_options::no_pattern), e->span);
        };
        if (range.low) one.low = number(range.low);
        if (range.high) one.high = number(range.high);
    }

    void offsets(const Expression& name, std::vector<Fitted>& all) const {
        const std::vector<std::string> columns = recorded_names(name.written(), system_);
        if (columns.empty() || columns.front() == "t")
            throw Failure(
                Diagnostic{Id::unknown_name, name.span,
                           fmt::format("scene '{}' records no '{}' that could have an offset", system_.scene.name, name.written())});
        for (const std::string& column : columns) {
            Fitted one = named(Fitted::What::offset, fmt::format("offset({})", column), name.span);
            one.of = column;
            one.shown = shown_of_column(column, system_);
            one.shown.offset = 0;  // of a difference
            one.start = 0;
            add(std::move(one), all);
        }
    }

    void delays(const Expression& name, std::vector<Fitted>& all) const {
        bool found = false;
        std::vector<std::string> known;
        for (const Variable& input : system_.symbols.all(SymbolKind::input)) {
            known.push_back(input.name);
            if (input.name != name.written() && input.base != name.written()) continue;
            found = true;
            Fitted one = named(Fitted::What::delay, fmt::format("delay({})", input.name), name.span);
            one.variable = &input;
            one.shown.unit = "s";
            one.low = 0;
            add(std::move(one), all);
        }
        if (!found)
            throw Failure(Diagnostic{
                Id::unknown_name, name.span,
                fmt::format("scene '{}' has no input '{}'{}", system_.scene.name, name.written(), did_you_mean(name.written(), known))});
    }

    const System& system_;
};

}  // namespace

double double_of(const GiNaC::ex& value, const Span& place) {
    const auto number = value_at(value, {}, 40);
    if (!number) throw Failure(Diagnostic{Id::division_by_zero, place, "the expression has no value"});
    return cln::double_approx(*number);
}

ShownNumber shown_in(const Unit& unit) {
    ShownNumber shown{unit.si() == "1" ? "" : unit.si()};
    if (unit.is_coherent()) return shown;
    shown.declared_unit = unit.written;
    shown.of_declared = cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power);
    shown.offset = cln::double_approx(unit.offset);
    return shown;
}

ShownNumber shown_of_column(const std::string& name, const System& system) {
    const auto unit = declared_unit(*parse_expression(excerpt_of(std::make_shared<const Source>("recording", name))), system.names);
    if (unit) return shown_in(*unit);
    for (const OutputEquation& output : system.outputs)
        if (output.name == name) return {output.unit == "1" ? "" : output.unit};
    return {};
}

std::vector<Fitted> fitted_of(const std::string& list, const System& system) {
    std::vector<Fitted> all;
    const FittedReader reader(system);
    for (const Excerpt& part : parts_of_list(std::make_shared<const Source>("--fit", list))) {
        if (part.text.empty()) throw Failure(Diagnostic{Id::bad_option, part.whole(), "a name is missing in the list of --fit"});
        reader.read(part, all);
    }
    return all;
}

}  // namespace dalembert

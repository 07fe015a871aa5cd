// SPDX-License-Identifier: GPL-3.0-or-later
// The start of a run, and times of kinks, are expressions of parameters, and constraints may determine some start values: their derivatives
// are central differences with far more digits than a double has.
#include "run/varied.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "form/state_places.hpp"
#include "language/parser.hpp"
#include "prove/constraint_validity.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr int digits = 40;

/// The part of a value by which it is moved: the rest of the series is below a rounding of a double.
ex step_of(const ex& value) {
    const ex number = value.evalf();
    const ex size = GiNaC::is_a<GiNaC::numeric>(number) && !number.is_zero() ? GiNaC::abs(number) : ex(1);
    return size * GiNaC::pow(GiNaC::numeric(10), -8);
}

std::size_t state_number(const Variable& variable, const Symbols& symbols) {
    const auto all = symbols.state_variables();
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const Variable* one) { return one->name == variable.name; }) - all.begin());
}

class Differentiation {
public:
    Differentiation(const System& system, const Values& values, const KinksOfRun& kinks)
        : system_(system), values_(values), kinks_(kinks), kinks_now_(kinks([](const System&, Values&) {})) {}

    VariedOfRun by(const Variable& variable, const Span& place) const {
        refuse_quaternion(variable, place);
        const bool is_parameter = variable.kind == SymbolKind::parameter;
        const std::size_t at_state = is_parameter ? 0 : state_number(variable, system_.symbols);
        const ex value = varied_value(variable, values_, system_);
        const ex step = step_of(value);
        const auto move = [&](Values& values, int steps) { set_varied(variable, values, value + steps * step); };
        VariedOfRun result{is_parameter ? Varied::parameter(variable.position) : Varied::start(place_states(system_).positions[at_state]),
                           variable.recorded_name(),
                           variable.is_root ? variable.declared->unit.si() : variable.unit,
                           {},
                           {}};
        const cln::cl_R distance = *value_at(2 * step, {}, digits);
        const auto slopes = [&](const auto& ahead, const auto& behind) {
            std::vector<double> all;
            for (std::size_t i = 0; i < ahead.size(); ++i) all.push_back(cln::double_approx((ahead[i] - behind[i]) / distance));
            return all;
        };
        const auto start_at = [&](int sign) {
            Values there = values_;
            move(there, sign);
            return start_of(there, place);
        };
        result.start = slopes(start_at(1), start_at(-1));
        if (!is_parameter && std::fabs(result.start[at_state]) < 1e-12)  // else 1, or that of a root by its square
            throw Failure(
                Diagnostic{Id::bad_option, place,
                           fmt::format("the start of '{}' cannot be varied: constraints determine it", variable.recorded_name())});
        const auto kinks_at = [&](int steps) { return kinks_([&](const System&, Values& values) { move(values, steps); }); };
        result.kinks = kink_slopes(kinks_at(1), kinks_at(-1), cln::double_approx(distance), variable, place);
        refine(result.kinks, kinks_at, cln::double_approx(distance) / 2);
        return result;
    }

private:
    /// Each kink has its slope only where no two meet that move differently: there the run has a derivative to either side, but no one.
    std::vector<double> kink_slopes(const std::vector<double>& ahead, const std::vector<double>& behind, double distance,
                                    const Variable& variable, const Span& place) const {
        if (ahead.size() != kinks_now_.size() || behind.size() != kinks_now_.size())
            throw Failure(Diagnostic{
                Id::bad_option, place,
                fmt::format(
                    "the run has no derivative by '{}': it has {} kinks and jumps at known times, but {} with a larger value and {} "
                    "with a smaller one, since some fall together or lie at the end of the run",
                    variable.recorded_name(), kinks_now_.size(), ahead.size(), behind.size())});
        std::vector<double> slopes;
        for (std::size_t k = 0; k < kinks_now_.size(); ++k) {
            slopes.push_back((ahead[k] - behind[k]) / distance);
            if (k == 0 || kinks_now_[k] - kinks_now_[k - 1] > 1e-7 * kinks_now_[k]) continue;
            if (std::fabs(slopes[k] - slopes[k - 1]) * distance > 1e-12 * kinks_now_[k])
                throw Failure(Diagnostic{Id::bad_option, place,
                                         fmt::format("the run has no derivative by '{}', which moves two kinks or jumps apart that fall "
                                                     "together at {:.6g} s",
                                                     variable.recorded_name(), kinks_now_[k])});
        }
        return slopes;
    }

    /// Times of kinks are doubles, which leave a short step half of their digits. Differences of order four at a longer one have all of
    /// them, where the same kinks are still there and move as they do nearby.
    template <class KinksAt>
    void refine(std::vector<double>& slopes, const KinksAt& kinks_at, double step) const {
        constexpr int longer = 10000;
        if (std::all_of(slopes.begin(), slopes.end(), [](double slope) { return slope == 0; })) return;
        std::array<std::vector<double>, 4> times;
        try {
            times = {kinks_at(-2 * longer), kinks_at(-longer), kinks_at(longer), kinks_at(2 * longer)};
        } catch (const Failure&) {
            return;  // nearby the parameter lies beyond what it may be
        }
        if (std::any_of(times.begin(), times.end(), [&](const auto& list) { return list.size() != slopes.size(); })) return;
        for (std::size_t k = 0; k < slopes.size(); ++k) {
            const double near = times[2][k] - times[1][k], far = times[3][k] - times[0][k], slope = (8 * near - far) / (12 * longer * step);
            if (std::fabs(slope - slopes[k]) * step <= 1e-15 * std::fabs(kinks_now_[k])) slopes[k] = slope;
        }
    }

    /// Alone they leave the norm one.
    void refuse_quaternion(const Variable& variable, const Span& place) const {
        for (const Symbols::AttitudeSymbols& attitude : system_.symbols.attitudes())
            if (variable.kind == SymbolKind::state && std::count(attitude.parts.begin(), attitude.parts.end(), variable.position) > 0)
                throw Failure(
                    Diagnostic{Id::bad_option, place,
                               fmt::format("the start of '{}' cannot be varied alone: it is a part of a quaternion, whose norm is "
                                           "one; vary a parameter that the attitude at the start is made of",
                                           variable.name)});
    }

    std::vector<cln::cl_R> start_of(Values& values, const Span& place) const {
        meet_constraints(system_, values);
        std::vector<cln::cl_R> numbers;
        for (const ex& value : values.state()) {
            const auto number = value_at(value, {}, digits);
            if (!number) throw Failure(Diagnostic{Id::division_by_zero, place, "a start value has no derivative by this"});
            numbers.push_back(*number);
        }
        return numbers;
    }

    const System& system_;
    const Values& values_;
    const KinksOfRun& kinks_;
    std::vector<double> kinks_now_;
};

}  // namespace

std::vector<const Variable*> variables_to_vary(const Expression& name, const System& system) {
    const std::string written = name.written();
    std::vector<std::string> known;
    std::vector<const Variable*> found;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : system.symbols.all(kind)) {
            const std::string own = variable.recorded_name();
            const auto bracket = own.find('[');
            const std::string family = bracket == std::string::npos ? own : own.substr(0, bracket) + (own.back() == ')' ? ")" : "");
            known.push_back(own);
            if (own == written || family == written) found.push_back(&variable);
        }
    if (found.empty())
        throw Failure(Diagnostic{Id::unknown_name, name.span,
                                 fmt::format("scene '{}' has no parameter, coordinate, velocity or state '{}'{}", system.scene.name,
                                             written, did_you_mean(written, known))});
    return found;
}

VariedOfRun varied_by(const Variable& variable, const Span& place, const System& system, const Values& values, const KinksOfRun& kinks) {
    return Differentiation(system, values, kinks).by(variable, place);
}

std::vector<NamedVariable> named_variables(const std::vector<std::string>& names, const System& system) {
    std::vector<NamedVariable> named;
    for (const std::string& name : names) {
        const ExpressionPtr written = parse_expression(excerpt_of(std::make_shared<const Source>("--sensitivities", name)));
        for (const Variable* variable : variables_to_vary(*written, system)) {
            const auto same = [&](const NamedVariable& other) { return other.variable == variable; };
            if (std::any_of(named.begin(), named.end(), same))
                throw Failure(Diagnostic{Id::bad_option, written->span, fmt::format("'{}' is named twice", variable->recorded_name())});
            named.push_back({variable, written->span});
        }
    }
    return named;
}

std::vector<VariedOfRun> varied_of_run(const std::vector<NamedVariable>& named, const System& system, const Values& values,
                                       const KinksOfRun& kinks) {
    std::vector<VariedOfRun> varied;
    const Differentiation differentiation(system, values, kinks);
    for (const NamedVariable& one : named) varied.push_back(differentiation.by(*one.variable, one.place));
    return varied;
}

ex varied_value(const Variable& variable, const Values& values, const System& system) {
    const ex value = variable.kind == SymbolKind::parameter ? values.parameter(variable.position)
                                                            : values.state()[state_number(variable, system.symbols)];
    return variable.is_root ? ex(value * value) : value;
}

void set_varied(const Variable& variable, Values& values, const ex& value) {
    values.find(variable.kind, variable.position, variable.is_root ? GiNaC::sqrt(value) : value);
}

}  // namespace dalembert

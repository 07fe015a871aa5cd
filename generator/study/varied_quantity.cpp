// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/varied_quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "check/written_values.hpp"
#include "elements/dependence.hpp"
#include "language/parser.hpp"
#include "run/settings.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

constexpr std::array kinds{SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input};
constexpr std::size_t most_on_axis = 1000000;

std::string list_of_distributions() {
    std::string text;
    for (const DistributionSpec& one : distributions()) text += fmt::format("{}{}({})", text.empty() ? "" : ", ", one.name, one.arguments);
    return text;
}

class VariationReader {
public:
    VariationReader(const SourcePtr& source, const System& system, const Values& values)
        : source_(source), system_(system), values_(values) {}

    VariedQuantity read(std::size_t begin, std::size_t end) {
        whole_ = trimmed(begin, end);
        const std::size_t equals = source_->text().find('=', begin);
        if (equals == std::string::npos || equals >= end)
            refuse(whole_, fmt::format("'--vary {}' is not of the form NAME=LOW:HIGH:COUNT or NAME=DISTRIBUTION", whole_.text()));
        name_ = parse_expression(excerpt_of(source_, begin, equals));
        const Variable& variable = find();
        value_place_ = trimmed(equals + 1, end);
        const std::string_view written = value_place_.text();
        const bool is_grid = written.find(':') != std::string_view::npos;
        return {&variable, is_grid ? Variation(axis()) : Variation(distribution(variable)), whole_};
    }

private:
    [[noreturn]] void refuse(const Span& place, std::string sentence, Id id = Id::bad_option) const {
        throw Failure(Diagnostic{id, place, std::move(sentence)});
    }

    Span trimmed(std::size_t begin, std::size_t end) const {
        const std::string& text = source_->text();
        while (begin < end && text[begin] == ' ') ++begin;
        while (end > begin && text[end - 1] == ' ') --end;
        return {source_, begin, end};
    }

    const Variable& find() const {
        const std::string written = spelled(*name_);
        std::vector<std::string> known;
        for (const SymbolKind kind : kinds)
            for (const Variable& variable : system_.symbols.all(kind)) {
                const std::string own = variable.recorded_name();
                if (kind == SymbolKind::coordinate && !system_.symbols.has_value(variable.position)) continue;
                if (own == written) {
                    refuse_quaternion(variable);
                    return variable;
                }
                const bool is_rate = kind == SymbolKind::velocity;
                if (variable.is_member && written == (is_rate ? "dot(" + variable.base + ")" : variable.base))
                    refuse(name_->span, fmt::format("'{}' is a family; name the member to vary, as in '{}'", written, own));
                known.push_back(own);
            }
        refuse(name_->span,
               fmt::format("scene '{}' has no parameter, coordinate, velocity, state or input '{}'{}", system_.scene.name, written,
                           did_you_mean(written, known)),
               Id::unknown_name);
    }

    /// Without blanks.
    static std::string spelled(const Expression& name) {
        std::string text = name.written();
        text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
        return text;
    }

    void refuse_quaternion(const Variable& variable) const {
        for (const Symbols::AttitudeSymbols& attitude : system_.symbols.attitudes())
            if (variable.kind == SymbolKind::state && std::count(attitude.parts.begin(), attitude.parts.end(), variable.position) > 0)
                refuse(name_->span, fmt::format("'{}' cannot be varied alone: it is a part of a quaternion, whose norm is one; vary a "
                                                "parameter that the attitude at the start is made of",
                                                variable.name));
    }

    /// The places between `separator`, outside of brackets.
    std::vector<Span> pieces(std::size_t begin, std::size_t end, char separator) const {
        std::vector<Span> result;
        int depth = 0;
        std::size_t from = begin;
        for (std::size_t i = begin; i <= end; ++i) {
            const char c = i < end ? source_->text()[i] : separator;
            if (c == '(' || c == '[') ++depth;
            if (c == ')' || c == ']') --depth;
            if (c != separator || (depth > 0 && i < end)) continue;
            result.push_back(trimmed(from, i));
            from = i + 1;
        }
        return result;
    }

    double number_of(const ExpressionPtr& e) const {
        const auto value = value_at(system_.translate(*e, {}).subs(values_.substitution(), GiNaC::subs_options::no_pattern), {}, 40);
        if (!value) refuse(e->span, "the expression has no value", Id::division_by_zero);
        return cln::double_approx(*value);
    }

    /// In SI, as a value of the quantity.
    double value(const Span& place) const {
        const Setting setting{name_, parse_expression(excerpt_of(source_, place.begin, place.end))};
        return number_of(value_of(setting, nothing, system_.names));
    }

    /// The same, inside its range.
    double allowed(const Span& place) const {
        const double number = value(place);
        Values(values_).set(*name_, *make_number(cln::rational(cln::cl_DF(number)), place), on_parameters | on_states | on_inputs);
        return number;
    }

    GridAxis axis() const {
        const std::vector<Span> parts = pieces(value_place_.begin, value_place_.end, ':');
        if (parts.size() != 3)
            refuse(value_place_, fmt::format("a grid is written LOW:HIGH:COUNT, as in 0.1:1:10, not '{}'", value_place_.text()));
        GridAxis axis{allowed(parts[0]), allowed(parts[1]), 0};
        const std::string_view count = parts[2].text();
        const auto end = std::from_chars(count.data(), count.data() + count.size(), axis.count);
        if (end.ec != std::errc() || end.ptr != count.data() + count.size() || axis.count == 0 || axis.count > most_on_axis)
            refuse(parts[2], fmt::format("'{}' is no number of grid points; give a whole number from 1 to {}", count, most_on_axis));
        if (axis.count == 1 ? axis.low != axis.high : !(axis.low < axis.high))
            refuse(value_place_, axis.count == 1 ? "a grid of one point has no two ends; give the value twice, or more points"
                                                 : "the first value of a grid must be smaller than the last one");
        return axis;
    }

    Distribution distribution(const Variable& variable) const {
        const std::string_view written = value_place_.text();
        const std::size_t open = written.find('(');
        const auto names = distributions();
        const auto found =
            std::find_if(names.begin(), names.end(), [&](const DistributionSpec& d) { return written.substr(0, open) == d.name; });
        if (found == names.end() || open == std::string_view::npos || !written.ends_with(')'))
            refuse(value_place_,
                   fmt::format("'{}' is neither a grid LOW:HIGH:COUNT nor a distribution; there are {}", written, list_of_distributions()));
        const std::vector<Span> of = pieces(value_place_.begin + open + 1, value_place_.end - 1, ',');
        const auto kind = static_cast<Distribution::Kind>(found - names.begin());
        const std::size_t count = kind == Distribution::Kind::triangular ? 3 : 2;
        if (of.size() != count)
            refuse(value_place_,
                   fmt::format("{} takes {} numbers, {}({}), not {}", found->name, count, found->name, found->arguments, of.size()));
        Distribution result;
        result.kind = kind;
        result.a = allowed(of[0]);
        if (kind == Distribution::Kind::normal || kind == Distribution::Kind::lognormal) {
            result.b = deviation_in_si(of[1], result.a, declared_unit(*name_, system_.names).value_or(Unit{}),
                                       fmt::format("the standard deviation of '{}'", name_->written()), system_);
            if (kind == Distribution::Kind::lognormal && !(result.a > 0))
                refuse(of[0], fmt::format("the mean of a lognormal distribution is positive, not {:.6g}", result.a));
        } else {
            result.b = allowed(of.back());
            result.mode = allowed(of[1]);
            if (!(result.a < result.b)) refuse(value_place_, fmt::format("{} needs two ends, the smaller one first", found->name));
            if (result.mode < result.a || result.mode > result.b) refuse(of[1], "the most likely value lies outside of the ends");
        }
        cut_off(result, variable);
        return result;
    }

    /// By the range of the model, and where a root is integrated, by zero.
    void cut_off(Distribution& result, const Variable& variable) const {
        if (variable.is_root) result.low = 0;
        const bool has_range = variable.declared != nullptr && variable.declared->range && !variable.declared->range->is_guess;
        if (has_range) {
            const Range& range = *variable.declared->range;
            if (range.low) result.low = std::max(result.low, number_of(range.low));
            if (range.high) result.high = number_of(range.high);
        }
        constexpr double least = 0.01;
        const double kept = result.kept();
        if (!(kept >= least))
            refuse(value_place_,
                   fmt::format("only {:.2g} % of the distribution of '{}' lies within its range from {:.6g} to {:.6g}; at least {:g} % "
                               "must, because values outside are drawn again",
                               100 * kept, variable.recorded_name(), result.low, result.high, 100 * least),
                   Id::value_out_of_range);
    }

    SourcePtr source_;
    const System& system_;
    const Values& values_;
    Span whole_, value_place_;
    ExpressionPtr name_;
};

}  // namespace

std::string VariedQuantity::unit() const {
    const std::string unit = variable->is_root ? variable->declared->unit.si() : variable->unit;
    return unit == "1" ? "" : unit;
}

std::vector<VariedQuantity> read_varied(const std::vector<std::string>& texts, const System& system, const Values& values) {
    std::vector<VariedQuantity> result;
    for (const std::string& text : texts) {
        const auto source = std::make_shared<const Source>("--vary", text);
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = end_of_part(text, begin);
            VariedQuantity one = VariationReader(source, system, values).read(begin, end);
            if (std::any_of(result.begin(), result.end(), [&](const VariedQuantity& other) { return other.variable == one.variable; }))
                throw Failure(Diagnostic{Id::bad_option, one.place, fmt::format("'{}' is varied twice", one.name())});
            result.push_back(std::move(one));
            begin = end + 1;
        }
    }
    return result;
}

}  // namespace dalembert

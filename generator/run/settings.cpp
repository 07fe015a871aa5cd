// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "language/parser.hpp"
#include "read/document.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

Setting parse_setting(const SourcePtr& source, std::size_t begin, std::size_t end, const std::string& option) {
    const std::size_t equals = source->text().find('=', begin);
    if (equals == std::string::npos || equals >= end)
        throw Failure(
            Diagnostic{Id::bad_option, Span{source, begin, end},
                       fmt::format("'--{} {}' is not of the form NAME=VALUE", option, source->text().substr(begin, end - begin))});
    return {parse_expression(excerpt_of(source, begin, equals)), parse_expression(excerpt_of(source, equals + 1, end))};
}

}  // namespace

std::size_t end_of_part(const std::string& text, std::size_t from) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (text[i] == '(' || text[i] == '[') ++depth;
        if (text[i] == ')' || text[i] == ']') --depth;
        if (text[i] == ',' && depth <= 0) return i;
    }
    return text.size();
}

std::vector<Excerpt> parts_of_list(const SourcePtr& source) {
    std::vector<Excerpt> parts;
    const std::string& text = source->text();
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = end_of_part(text, begin);
        const std::size_t first = std::min(text.find_first_not_of(' ', begin), end);
        const std::size_t last = end > first ? text.find_last_not_of(' ', end - 1) + 1 : first;
        parts.push_back(excerpt_of(source, first, last));
        begin = end + 1;
    }
    return parts;
}

std::vector<Setting> parse_settings(const std::vector<std::string>& texts, const std::string& option) {
    std::vector<Setting> settings;
    for (const std::string& text : texts) {
        const auto source = std::make_shared<const Source>("--" + option, text);
        for (std::size_t begin = 0; begin <= text.size();) {
            const std::size_t end = end_of_part(text, begin);
            settings.push_back(parse_setting(source, begin, end, option));
            begin = end + 1;
        }
    }
    return settings;
}

namespace {

/// [parameters] of a file.
void read_parameter_file(const std::string& file, std::vector<Setting>& settings) {
    const DocumentNode root = parse_document(read_text_file(file));
    const DocumentNode* table = nullptr;
    for (const DocumentNode::Member& member : root.members) {
        if (member.key != "parameters")
            throw Failure(Diagnostic{Id::unknown_key, member.key_span,
                                     fmt::format("a parameter file has the table [parameters] alone, and no '{}'", member.key)});
        table = &member.value;
    }
    if (table == nullptr)
        throw Failure(Diagnostic{Id::missing_key, root.span, "a parameter file has a table [parameters], which is missing"});
    if (table->kind != DocumentNode::Kind::table)
        throw Failure(
            Diagnostic{Id::wrong_type, table->span, fmt::format("'parameters' is {}, but must be a table", describe(table->kind))});
    for (const DocumentNode::Member& member : table->members) {
        const DocumentNode& value = member.value;
        const auto name = std::make_shared<const Source>("--parameters " + file, member.key);
        if (value.kind == DocumentNode::Kind::string)
            settings.push_back({parse_expression(excerpt_of(name)), parse_expression(value.string)});
        else if (value.kind == DocumentNode::Kind::number)
            settings.push_back(
                {parse_expression(excerpt_of(name)), parse_expression(excerpt_of(value.span.source, value.span.begin, value.span.end))});
        else
            throw Failure(Diagnostic{
                Id::wrong_type, value.span,
                fmt::format("the value of '{}' is {}, but must be a number, or a text as \"5 bar\"", member.key, describe(value.kind))});
    }
}

}  // namespace

std::vector<Setting> parameter_settings(const Options& options) {
    std::vector<Setting> settings;
    for (const std::string& file : options.parameter_files) read_parameter_file(file, settings);
    for (Setting& setting : parse_settings(options.parameters, "parameter")) settings.push_back(std::move(setting));
    return settings;
}

FixWish parse_fixed(const std::string& text, const Names& names) {
    FixWish wish{text, text == "parameters", {}};
    if (wish.all || text.empty()) return wish;
    const auto source = std::make_shared<const Source>("--fix", text);
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = end_of_part(text, begin);
        if (const std::size_t equals = text.find('=', begin); equals == std::string::npos || equals >= end) {
            wish.some.push_back({parse_expression(excerpt_of(source, begin, end)), nullptr});
        } else {
            const Setting setting = parse_setting(source, begin, end, "fix");
            wish.some.push_back({setting.variable, value_of(setting, nothing, names)});
        }
        begin = end + 1;
    }
    return wish;
}

ExpressionPtr value_of(const Setting& setting, unsigned may_depend, const Names& names) {
    const std::string what = fmt::format("the value of '{}'", setting.variable->written());
    check_dependence(*setting.value, may_depend, what, names);
    const auto unit = declared_unit(*setting.variable, names);
    return unit ? in_si(setting.value, *unit, what, names) : setting.value;
}

double deviation_in_si(const ExpressionPtr& written, Unit unit, const std::string& what, const System& system) {
    check_dependence(*written, nothing, what, system.names);
    unit.offset = 0;
    const auto number = value_at(system.translate(*in_si(written, unit, what, system.names), {}), {}, 40);
    if (!number || !cln::plusp(*number))
        throw Failure(Diagnostic{Id::value_out_of_range, written->span, fmt::format("{} must be above zero", what)});
    return cln::double_approx(*number);
}

double deviation_in_si(const Span& written, double mean, const Unit& unit, const std::string& what, const System& system) {
    const auto percent = written.text().rfind('%');
    const auto parsed = [&](std::size_t end) { return parse_expression(excerpt_of(written.source, written.begin, end)); };
    if (percent == std::string_view::npos) return deviation_in_si(parsed(written.end), unit, what, system);
    const double deviation = deviation_in_si(parsed(written.begin + percent), Unit{}, what, system) * std::fabs(mean) / 100;
    if (!(deviation > 0)) throw Failure(Diagnostic{Id::value_out_of_range, written, fmt::format("{} must be above zero", what)});
    return deviation;
}

void check_dependence(const Expression& value, unsigned may_depend, const std::string& what, const Names& names) {
    for_each(value, [&](const Expression& part) {
        const bool is_leaf =
            part.kind == Expression::Kind::name || (part.kind == Expression::Kind::call && (part.name == "dot" || part.name == "ddot"));
        if (is_leaf && (dependence(part, names) & ~may_depend) != 0)
            throw Failure(Diagnostic{Id::not_allowed_here, part.span, fmt::format("{} must not depend on '{}'", what, part.written())});
    });
}

void check_inputs_given(const std::vector<bool>& is_given, const System& system) {
    for (const Variable& input : system.symbols.all(SymbolKind::input)) {
        if (is_given[input.position] || input.declared == nullptr) continue;
        const auto bound = [&](const ExpressionPtr& e) { return e ? value_at(system.translate(*e, {}), {}, 20) : std::nullopt; };
        const auto low = input.declared->range ? bound(input.declared->range->low) : std::nullopt;
        const auto high = input.declared->range ? bound(input.declared->range->high) : std::nullopt;
        const Dimension& dimension = input.declared->unit.dimension;
        const bool is_absolute =
            (dimension == Dimension::temperature() || dimension == Dimension::pressure()) && !(low && cln::minusp(*low));
        const bool has_zero = !(low && cln::plusp(*low)) && !(high && cln::minusp(*high));
        if (has_zero && !is_absolute) continue;
        const std::string why = has_zero ? fmt::format("zero {} is not a usual {}", input.declared->unit.si(),
                                                       dimension == Dimension::pressure() ? "pressure" : "temperature")
                                         : "zero is outside its range";
        throw Failure(Diagnostic{
            Id::missing_key, input.declared->span,
            fmt::format("the input '{0}' has no value, and {1}; give it in the run, inputs = {{ {0} = ... }}, or as --input {0}=...",
                        input.name, why)});
    }
}

namespace {

/// Something in the model that is at an absolute temperature or pressure.
class Doubts {
public:
    /// Start values were written by somebody; others were computed.
    enum class Occasion { start, found };

    Doubts(const Values& values, const System& system, Occasion occasion, bool knows_inputs, Diagnostics& diagnostics)
        : at_(values.substitution()), system_(system), occasion_(occasion), diagnostics_(diagnostics) {
        if (!knows_inputs)
            for (const Variable& input : system.symbols.all(SymbolKind::input)) at_.erase(input.symbol);
    }

    void temperature(const ExpressionPtr& e, const char* kind, const Item& item) {
        constexpr double coldest = 100;
        const auto kelvin = number(e);
        if (occasion_ == Occasion::found) {
            if (kelvin && *kelvin < 0) warn(*e, fmt::format("{} '{}' is at {:.6g} K, below absolute zero", kind, item.name, *kelvin));
            return;
        }
        if (!kelvin || *kelvin >= coldest || is_in_range(*e, *kelvin)) return;
        warn(*e, fmt::format("{} '{}' begins at {:.6g} K; did you mean {:.6g} degC?", kind, item.name, *kelvin, *kelvin));
    }

    void pressure(const ExpressionPtr& e, const char* kind, const Item& item) {
        constexpr double least = 100;
        const auto pascal = number(e);
        if (occasion_ == Occasion::found) {
            if (pascal && *pascal < 0)
                warn(*e,
                     fmt::format("{} '{}' is at {:.6g} Pa; pressures are absolute, so that a vacuum is at 0 Pa", kind, item.name, *pascal));
            return;
        }
        if (!pascal || *pascal >= least || is_in_range(*e, *pascal)) return;
        warn(*e, *pascal > 0 ? fmt::format("{} '{}' begins at {:.6g} Pa; did you mean {:.6g} bar?", kind, item.name, *pascal, *pascal)
                             : fmt::format("{} '{}' begins at {:.6g} Pa; pressures are absolute, so ambient air is at 1 bar. Did you mean "
                                           "{:.6g} bar, above ambient?",
                                           kind, item.name, *pascal, *pascal / 1e5 + 1));
    }

private:
    std::optional<double> number(const ExpressionPtr& e) const {
        if (!e) return std::nullopt;
        try {
            const auto value =
                value_at(system_.symbols.without_definitions(system_.translate(*e, {})).subs(at_, GiNaC::subs_options::no_pattern), {}, 20);
            return value ? std::optional(cln::double_approx(*value)) : std::nullopt;
        } catch (const Failure&) {  // of a family, or of what the scene leaves out
            return std::nullopt;
        } catch (const GiNaC::pole_error&) {  // told where the value is needed
            return std::nullopt;
        }
    }

    /// A declared range that reaches there says that it is meant.
    bool is_in_range(const Expression& e, double value) const {
        const Named* named = e.kind == Expression::Kind::name ? system_.names.find(e.name) : nullptr;
        if (named == nullptr || (named->kind != Named::Kind::parameter && named->kind != Named::Kind::state &&
                                 named->kind != Named::Kind::input && named->kind != Named::Kind::coordinate))
            return false;
        const auto& range = named->quantity().range;
        const auto low = range ? number(range->low) : std::nullopt;
        return low && *low > 0 && *low <= value;
    }

    /// Once a place: a value outside of its range has been told.
    void warn(const Expression& e, std::string message) {
        const Named* named = e.kind == Expression::Kind::name ? system_.names.find(e.name) : nullptr;
        const Span& place = named != nullptr ? named->item->span : e.span;
        const auto& told = diagnostics_.all();
        const auto is_here = [&](const Diagnostic& d) { return d.span.source == place.source && d.span.begin == place.begin; };
        if (occasion_ == Occasion::found && std::any_of(told.begin(), told.end(), is_here)) return;
        diagnostics_.warning(Id::value_out_of_range, place, std::move(message));
    }

    GiNaC::exmap at_;
    const System& system_;
    Occasion occasion_;
    Diagnostics& diagnostics_;
};

void doubt_media(Doubts& doubts, const System& system) {
    for (const auto& member : system.scene.volumes) {
        const Volume& volume = *member.item;
        doubts.pressure(volume.pressure, "volume", volume);
        doubts.temperature(volume.temperature ? volume.temperature : volume.isothermal, "volume", volume);
    }
    for (const auto& member : system.scene.reservoirs) {
        doubts.pressure(member.item->pressure, "reservoir", *member.item);
        doubts.temperature(member.item->temperature, "reservoir", *member.item);
    }
    for (const auto& member : system.scene.nodes)
        if (member.item->capacity) doubts.temperature(member.item->temperature, "node", *member.item);
}

std::string rendered(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& doubt : diagnostics.all()) text += render(doubt);
    return text;
}

}  // namespace

std::string doubts_of_start(const Values& values, const System& system, bool knows_inputs) {
    Diagnostics diagnostics;
    Doubts doubts(values, system, Doubts::Occasion::start, knows_inputs, diagnostics);
    doubt_media(doubts, system);
    return rendered(diagnostics);
}

std::string doubts_of_found(const Values& values, const System& system, const std::vector<double>& x, const std::vector<double>& u) {
    constexpr double rounding = 1e-9;  // of a search that ends on a bound
    Diagnostics diagnostics;
    Values found = values;
    std::set<const Quantity*> told;
    const auto take = [&](const Variable& variable, double number) {
        if (!std::isfinite(number)) return;
        found.find(variable.kind, variable.position, GiNaC::numeric(number));
        const bool is_guess = variable.declared != nullptr && variable.declared->range && variable.declared->range->is_guess;
        if (variable.declared == nullptr || is_guess) return;
        if (told.contains(variable.declared)) return;  // of another member of its family
        const GiNaC::ex value = GiNaC::numeric(variable.is_root ? number * number : number);
        const auto outside = found.outside_range(variable, value, variable.declared->span, rounding);
        if (!outside) return;
        diagnostics.warning(outside->id, outside->span, outside->message);
        told.insert(variable.declared);
    };
    const std::vector<const Variable*> states = system.symbols.state_variables();
    for (std::size_t i = 0; i < states.size() && i < x.size(); ++i) take(*states[i], x[i]);
    const auto& inputs = system.symbols.all(SymbolKind::input);
    for (std::size_t i = 0; i < inputs.size() && i < u.size(); ++i) take(inputs[i], u[i]);
    Doubts doubts(found, system, Doubts::Occasion::found, true, diagnostics);
    doubt_media(doubts, system);
    return rendered(diagnostics) + doubts_of_curves(found, system);
}

void apply_settings(Values& values, const std::vector<Setting>& settings, unsigned allowed, const System& system) {
    for (const Setting& setting : settings) {
        values.set(*setting.variable, *value_of(setting, allowed == on_parameters ? nothing : on_parameters, system.names), allowed);
    }
}

}  // namespace dalembert

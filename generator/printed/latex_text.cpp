// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "language/expression_text.hpp"
#include "language/vocabulary.hpp"
#include "printed/latex_letter.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// What no text is made for.
struct NotSpelled {};

enum Binding : int { as_sum, as_product, as_primary };

Binding binding(const Expression& e) {
    switch (e.kind) {
        case Kind::add:
        case Kind::subtract:
        case Kind::negate: return as_sum;
        case Kind::multiply:
        case Kind::sum: return as_product;
        case Kind::call: return e.name == "integral" || e.name == "limit" || e.name == "diff" ? as_product : as_primary;
        case Kind::number: return is_negative(e.value) ? as_sum : as_primary;
        default: return as_primary;
    }
}

/// Of LaTeX, for a function of the model language; empty where it has none.
std::string command_of(std::string_view function) {
    const FunctionSpec* known = find_function(function);
    return known != nullptr && known->latex != nullptr ? known->latex : "";
}

/// Line breaks, comments, repeated blanks, and the alignment of lines say nothing; '&' and '\\\\' of a matrix or of cases do.
std::string on_one_line(std::string_view text) {
    std::string line;
    int environments = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
            continue;
        }
        if (text.substr(i).starts_with("\\begin{")) ++environments;
        if (text.substr(i).starts_with("\\end{")) --environments;
        if (c == '\\' && i + 1 < text.size() && (text[i + 1] != '\\' || environments > 0)) {  // a command, or the end of a row
            line += c;
            c = text[++i];
            line += c == '\n' ? ' ' : c;
            continue;
        }
        if (c == '\\') ++i;
        const bool is_alignment = c == '&' && environments == 0;
        if (c == '\\' || is_alignment || c == '\n' || c == '\t' || c == '\r') c = ' ';
        if (c != ' ' || (!line.empty() && line.back() != ' ')) line += c;
    }
    while (line.ends_with(' ') && !line.ends_with("\\ ")) line.pop_back();
    return line;
}

bool is_letter_of_command(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// "\\alpha" and "x" are not "\\alphax".
std::string beside(const std::string& left, const std::string& right) {
    const bool is_number_beside_number =
        !left.empty() && !right.empty() && left.back() >= '0' && left.back() <= '9' && right.front() >= '0' && right.front() <= '9';
    return left + (is_number_beside_number ? " \\cdot " : " ") + right;
}

/// Sums and products as lists, so that brackets that say nothing make no difference.
class Flat {
public:
    static std::string of(const Equation& equation) {
        std::string text;
        for (const ExpressionPtr& side : equation.sides) text += of(*side) + "\n";
        return text;
    }

private:
    static std::string of(const Expression& e) {
        std::vector<std::string> terms;
        add_terms(e, false, terms);
        return fmt::format("{}", fmt::join(terms, ""));
    }

    static void add_terms(const Expression& e, bool is_negative, std::vector<std::string>& terms) {
        if (e.kind == Kind::negate) return add_terms(*e.children[0], !is_negative, terms);
        if (e.kind == Kind::add || e.kind == Kind::subtract) {
            add_terms(*e.children[0], is_negative, terms);
            return add_terms(*e.children[1], is_negative != (e.kind == Kind::subtract), terms);
        }
        std::vector<std::string> above, below;
        add_factors(e, false, is_negative, above, below);
        terms.push_back(
            fmt::format("{}{}{}{}", is_negative ? "-" : "+", fmt::join(above, "*"), below.empty() ? "" : "/", fmt::join(below, "/")));
    }

    static void add_factors(const Expression& e, bool is_below, bool& is_negative, std::vector<std::string>& above,
                            std::vector<std::string>& below) {
        if (e.kind == Kind::negate) {
            is_negative = !is_negative;
            return add_factors(*e.children[0], is_below, is_negative, above, below);
        }
        if (e.kind == Kind::multiply || e.kind == Kind::divide) {
            add_factors(*e.children[0], is_below, is_negative, above, below);
            return add_factors(*e.children[1], is_below != (e.kind == Kind::divide), is_negative, above, below);
        }
        if (e.kind == Kind::number && e.value == 1 && e.name.empty()) return;
        (is_below ? below : above).push_back(factor(e));
    }

    static std::string factor(const Expression& e) {
        if (e.kind == Kind::number) return to_string(e.value) + (e.name == "rounded" ? "" : e.name);
        if (e.kind == Kind::add || e.kind == Kind::subtract) return "(" + of(e) + ")";
        if (e.children.empty()) return e.name;
        std::vector<std::string> children;
        for (const ExpressionPtr& child : e.children) children.push_back(of(*child));
        return fmt::format("{}{}({})", e.name, e.kind == Kind::power ? "^" : "", fmt::join(children, ","));
    }
};

/// Without blanks and braces around it.
Span trimmed(Span place) {
    const std::string_view text = place.source->text();
    const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
    while (place.begin < place.end && is_blank(text[place.begin])) ++place.begin;
    while (place.begin < place.end && is_blank(text[place.end - 1])) --place.end;
    if (place.end < place.begin + 2 || text[place.begin] != '{' || text[place.end - 1] != '}') return place;
    int depth = 0;
    for (std::size_t i = place.begin; i + 1 < place.end; ++i) {
        depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
        if (depth == 0) return place;  // two groups
    }
    return trimmed({place.source, place.begin + 1, place.end - 1});
}

/// One pair of brackets around all of it.
bool is_bracketed(std::string_view text) {
    const std::size_t open = text.find('(');
    if (open == std::string_view::npos || !text.ends_with(')') || (open != 0 && text.substr(0, open) != "\\left")) return false;
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
        if (depth == 0) return i + 1 == text.size();
    }
    return false;
}

/// The place of the one sign between two places; nothing where there is none or more.
std::optional<std::size_t> sign_between(std::string_view text, std::size_t from, std::size_t to) {
    std::optional<std::size_t> found;
    for (std::size_t i = from; i < to; ++i) {
        if (text[i] != '+' && text[i] != '-') continue;
        if (found) return std::nullopt;
        found = i;
    }
    return found;
}

}  // namespace

LatexText::LatexText(const Catalogue& catalogue, const CatalogueEntry& entry, const Model* model, const PrintedEquation& read)
    : catalogue_(catalogue), entry_(entry), model_(model), equations_(read.shown) {
    const Span whole = entry.latex->whole();
    const auto is_inside = [&](const Span& place) {
        return place.source == whole.source && place.begin >= whole.begin && place.end <= whole.end;
    };
    for (const auto* meanings : {&catalogue.notation, &entry.notation})
        for (const LatexMeaning& meaning : *meanings)
            if (meaning.value->kind == Kind::name && meaning.value->children.empty()) letters_[meaning.value->name] = meaning.letter.text;
    for (const Equation& equation : equations_)
        for (const ExpressionPtr& side : equation.sides)
            for_each(*side, [&](const Expression& e) {
                if (!is_inside(e.span)) return;
                originals_.insert(&e);
                const bool is_letter = e.kind == Kind::name && e.children.empty() &&
                                       e.span.text().find_first_of("(+-") == std::string_view::npos && !e.span.text().starts_with("\\d");
                if (is_letter) letters_.emplace(e.name, on_one_line(e.span.text()));
            });
}

std::string LatexText::letter(const std::string& name) const {
    if (const auto known = letters_.find(name); known != letters_.end()) return known->second;
    const std::size_t end = name.find('_');
    const auto part = [](const std::string& word) {
        return is_greek("\\" + word) ? "\\" + word : word.size() > 1 ? "\\mathrm{" + word + "}" : word;
    };
    std::string text = part(name.substr(0, end));
    if (end == std::string::npos) return text;
    std::vector<std::string> indices;
    for (std::size_t at = end; at != std::string::npos;) {
        const std::size_t behind = name.find('_', at + 1);
        const std::string word = name.substr(at + 1, behind == std::string::npos ? behind : behind - at - 1);
        indices.push_back(is_greek("\\" + word) ? "\\" + word : word == "inf" ? "\\infty" : word);
        at = behind;
    }
    const std::string index = fmt::format("{}", fmt::join(indices, ","));
    return text + "_" + (index.size() == 1 ? index : "{" + index + "}");
}

Span LatexText::with_brackets(const Span& place) const {
    const std::string_view text = place.source->text();
    const Span whole = entry_.latex->whole();
    std::size_t begin = place.begin, end = place.end;
    while (begin > whole.begin && text[begin - 1] == ' ') --begin;
    while (end < whole.end && text[end] == ' ') ++end;
    if (begin == whole.begin || text[begin - 1] != '(') return place;
    --begin;
    const auto skip = [&](std::string_view command) {
        if (text.substr(end).starts_with(command)) end += command.size();
    };
    skip("\\right");
    if (end >= whole.end || text[end] != ')') return place;
    ++end;
    constexpr std::string_view left = "\\left";
    if (begin >= whole.begin + left.size() && text.substr(begin - left.size(), left.size()) == left) begin -= left.size();
    return {place.source, begin, end};
}

std::string LatexText::text_of(const Expression& e, int least) const {
    if (!is_printed(e)) return binding(e) < least ? "\\left(" + made(e) + "\\right)" : made(e);
    const Span place = trimmed(e.span);
    if (binding(e) >= least || is_bracketed(place.text())) return std::string(place.text());
    const Span wide = with_brackets(place);
    return wide.begin < place.begin ? std::string(wide.text()) : "\\left(" + std::string(place.text()) + "\\right)";
}

std::string LatexText::made(const Expression& e) const {
    const auto part = [&](std::size_t i, int least) { return text_of(*e.children[i], least); };
    switch (e.kind) {
        case Kind::number:
            if (!is_integer(e.value))
                return fmt::format("{}\\frac{{{}}}{{{}}}", is_negative(e.value) ? "-" : "",
                                   to_string(cln::abs(Rational(cln::numerator(e.value)))), to_string(Rational(cln::denominator(e.value))));
            return to_string(e.value);
        case Kind::name:
            if (!e.children.empty()) throw NotSpelled();
            return e.name == "infinity" ? "\\infty" : letter(e.name);
        case Kind::negate: return "-" + part(0, as_product);
        case Kind::add: return part(0, as_sum) + " + " + part(1, as_product);
        case Kind::subtract: return part(0, as_sum) + " - " + part(1, as_product);
        case Kind::multiply: return beside(part(0, as_product), part(1, as_product));
        case Kind::divide: return "\\frac{" + part(0, as_sum) + "}{" + part(1, as_sum) + "}";
        case Kind::power: {
            const Expression& base = *e.children[0];
            const bool is_rate = base.kind == Kind::call && (base.name == "dot" || base.name == "ddot");
            const bool is_letter =
                is_rate || base.kind == Kind::name || (base.kind == Kind::number && is_integer(base.value) && !is_negative(base.value));
            const std::string exponent = part(1, as_sum);
            return (is_letter ? part(0, as_primary) : text_of(base, as_primary + (is_printed(base) ? 1 : 0))) + "^" +
                   (exponent.size() == 1 ? exponent : "{" + exponent + "}");
        }
        case Kind::call: {
            if (e.name == "dot" || e.name == "ddot") return "\\" + e.name + "{" + part(0, as_primary) + "}";
            if (e.name == "sqrt") return "\\sqrt{" + part(0, as_sum) + "}";
            const std::string command = command_of(e.name);
            if (command.empty() || e.children.size() != 1) throw NotSpelled();
            const Expression& x = *e.children[0];
            const bool is_short = x.kind == Kind::name || x.kind == Kind::number;
            return is_short ? command + " " + part(0, as_primary) : command + text_of(x, as_primary + 1);
        }
        case Kind::sum: break;
    }
    throw NotSpelled();
}

std::string LatexText::spelled(const Expression& e) const {
    try {
        return on_one_line(text_of(e, as_sum));
    } catch (const NotSpelled&) {
        return in_model_language(e);
    }
}

std::string LatexText::printed(std::size_t which) const { return on_one_line(equations_[which].span.text()); }

LatexMacros LatexText::macros() const {
    LatexMacros macros;
    if (catalogue_.preamble) define_macros(macros, *catalogue_.preamble);
    for (const auto& [name, body] : catalogue_.macros) define_macro(macros, name, body);
    define_macros(macros, *entry_.latex);
    return macros;
}

bool LatexText::reads_as(const std::string& latex, std::size_t which, const Equation& meant) const {
    CatalogueEntry other = entry_;
    other.latex = excerpt_of(std::make_shared<const Source>("mended", latex));
    try {
        const std::string text = Flat::of(meant);
        for (const CatalogueEntry& one : with_equations(catalogue_, other, model_))
            if (which < one.equations.size() && Flat::of(one.equations[which]) == text) return true;
    } catch (const Failure&) {  // no text of that
    }
    return false;
}

std::optional<std::string> LatexText::mended(std::size_t which, const Slip& slip) const {
    const Expression &from = *slip.printed, &to = *slip.mended;
    const Excerpt& latex = *entry_.latex;
    const Span own = trimmed(from.span);
    const Span whole = latex.whole(), equation = equations_[which].span;
    if (!is_printed(from) || !is_plain()) return std::nullopt;
    const std::string_view text = from.span.source->text();
    const auto with = [&](const Span& place, const std::string& instead) -> std::optional<std::string> {
        const auto between = [&](std::size_t begin, std::size_t end) { return std::string(text.substr(begin, end - begin)); };
        if (!reads_as(between(whole.begin, place.begin) + instead + between(place.end, whole.end), which, slip.equation))
            return std::nullopt;
        return on_one_line(between(std::min(equation.begin, place.begin), place.begin) + instead +
                           between(place.end, std::max(equation.end, place.end)));
    };
    const auto has_same_children = [&] { return from.children == to.children; };
    const bool is_other_sign =
        (from.kind == Kind::add && to.kind == Kind::subtract) || (from.kind == Kind::subtract && to.kind == Kind::add);
    if (is_other_sign && has_same_children() && is_printed(*from.children[0]) && is_printed(*from.children[1]))
        if (const auto sign = sign_between(text, from.children[0]->span.end, from.children[1]->span.begin))
            if (auto result = with({from.span.source, *sign, *sign + 1}, to.kind == Kind::add ? "+" : "-")) return result;
    if (from.kind == Kind::call && to.kind == Kind::call && has_same_children()) {
        for (const auto& [old_dots, new_dots] : {std::pair("\\dot", "\\ddot"), std::pair("\\ddot", "\\dot")})
            if (from.name == old_dots + 1 && to.name == new_dots + 1 && own.text().starts_with(old_dots))
                if (auto result = with({own.source, own.begin, own.begin + std::string_view(old_dots).size()}, new_dots)) return result;
        const std::string old_name = command_of(from.name), new_name = command_of(to.name);
        if (!old_name.empty() && !new_name.empty() && own.text().starts_with(old_name))
            if (auto result = with({own.source, own.begin, own.begin + old_name.size()}, new_name)) return result;
    }
    // The minus stands before all that the first factor begins: before "\frac" for that above it.
    if (from.kind == Kind::negate && from.children[0] == slip.mended && own.text().starts_with('-'))
        if (auto result = with({own.source, own.begin, own.begin + 1}, "")) return result;
    try {
        const std::string instead = text_of(to, as_sum);
        const Span wide = with_brackets(own);
        const std::string bracketed = "\\left(" + instead + "\\right)";
        for (const auto& [place, replacement] : {std::pair(wide, instead), std::pair(own, instead), std::pair(own, bracketed),
                                                 std::pair(wide, bracketed), std::pair(own, "{" + instead + "}")}) {
            const bool needs_space =
                is_letter_of_command(replacement.front()) && place.begin > 0 && is_letter_of_command(text[place.begin - 1]);
            if (auto result = with(place, (needs_space ? " " : "") + replacement)) return result;
        }
    } catch (const NotSpelled&) {
    }
    return std::nullopt;
}

}  // namespace dalembert

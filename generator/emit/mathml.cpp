// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/mathml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "language/expression_text.hpp"
#include "language/parser.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

constexpr auto greek = std::to_array<std::pair<const char*, const char*>>({
    {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"},  {"epsilon", "ε"},  {"zeta", "ζ"}, {"eta", "η"},
    {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},       {"nu", "ν"},   {"xi", "ξ"},
    {"pi", "π"},    {"rho", "ρ"},   {"sigma", "σ"}, {"tau", "τ"},    {"phi", "φ"},      {"chi", "χ"},  {"psi", "ψ"},
    {"omega", "ω"}, {"Gamma", "Γ"}, {"Delta", "Δ"}, {"Theta", "Θ"},  {"Lambda", "Λ"},   {"Xi", "Ξ"},   {"Pi", "Π"},
    {"Sigma", "Σ"}, {"Phi", "Φ"},   {"Psi", "Ψ"},   {"Omega", "Ω"},  {"infinity", "∞"},
});

std::string letter(std::string_view word) {
    const auto found = std::find_if(greek.begin(), greek.end(), [&](const auto& entry) { return word == entry.first; });
    return found == greek.end() ? html_text(word) : found->second;
}

std::string row(const std::string& inside) { return "<mrow>" + inside + "</mrow>"; }
std::string sign(const char* text) { return fmt::format("<mo>{}</mo>", text); }
std::string bracketed(const std::string& inside) { return row("<mo>(</mo>" + inside + "<mo>)</mo>"); }
std::string fraction(const std::string& above, const std::string& below) {
    return fmt::format("<mfrac>{}{}</mfrac>", row(above), row(below));
}

/// "phi_1" with the indices of a member behind its own.
std::string name_of(const Expression& e, const char* accent = nullptr) {
    std::string word = e.name;
    std::string below;
    if (find_quantity(word) != nullptr) {
        std::replace(word.begin(), word.end(), '_', ' ');
    } else if (const std::size_t at = word.find('_'); at != std::string::npos) {
        for (std::size_t from = at + 1; from <= word.size();) {
            const std::size_t to = std::min(word.find('_', from), word.size());
            below +=
                (below.empty() ? "" : "<mo>,</mo>") + fmt::format("<mi>{}</mi>", letter(std::string_view(word).substr(from, to - from)));
            from = to + 1;
        }
        word.resize(at);
    }
    for (const ExpressionPtr& index : e.children) below += (below.empty() ? "" : "<mo>,</mo>") + mathml(*index);
    std::string base =
        word.find(' ') == std::string::npos ? fmt::format("<mi>{}</mi>", letter(word)) : fmt::format("<mtext>{}</mtext>", html_text(word));
    if (accent != nullptr) base = fmt::format("<mover>{}<mo>{}</mo></mover>", base, accent);
    return below.empty() ? base : fmt::format("<msub>{}{}</msub>", base, row(below));
}

bool is_sum(const Expression& e) { return e.kind == Kind::add || e.kind == Kind::subtract; }

/// A factor: sums in brackets.
std::string factor(const Expression& e) {
    return is_sum(e) || e.kind == Kind::negate || (e.kind == Kind::number && is_negative(e.value)) ? bracketed(mathml(e)) : mathml(e);
}

/// Whether it begins with a minus, as the first factor of "-m*l" does.
bool is_negative_first(const Expression& e) {
    if (e.kind == Kind::negate || (e.kind == Kind::number && is_negative(e.value))) return true;
    return e.kind == Kind::multiply && is_negative_first(*e.children[0]);
}

std::string list(const Expression& e, std::size_t from = 0) {
    std::string text;
    for (std::size_t i = from; i < e.children.size(); ++i) text += (text.empty() ? "" : "<mo>,</mo>") + mathml(*e.children[i]);
    return text;
}

std::string number(const Expression& e) {
    const std::string_view written = e.span.text();
    const bool is_plain =
        !written.empty() && std::all_of(written.begin(), written.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
    if (is_plain && read_decimal(written) == e.value) return fmt::format("<mn>{}</mn>", written);
    if (is_integer(e.value)) return fmt::format("<mn>{}</mn>", to_string(e.value));
    return fraction(fmt::format("<mn>{}</mn>", to_string(cln::numerator(e.value))),
                    fmt::format("<mn>{}</mn>", to_string(cln::denominator(e.value))));
}

std::string power(const Expression& e) {
    const Expression &base = *e.children[0], &exponent = *e.children[1];
    // sin(x)^2 as sin²(x), x[1]^2 with both behind the letter.
    const bool is_simple = base.kind == Kind::name || (base.kind == Kind::number && is_integer(base.value)) ||
                           (base.kind == Kind::call && (base.name == "dot" || base.name == "ddot"));
    const std::string below = is_simple                                                        ? mathml(base)
                              : base.kind == Kind::call && find_function(base.name) != nullptr ? row(mathml(base))
                                                                                               : bracketed(mathml(base));
    if (base.kind == Kind::call && base.children.size() == 1 &&
        (base.name == "sin" || base.name == "cos" || base.name == "tan" || base.name == "sinh" || base.name == "cosh" ||
         base.name == "tanh"))
        return fmt::format("<msup><mi>{}</mi>{}</msup>{}", base.name, row(mathml(exponent)), bracketed(mathml(*base.children[0])));
    return fmt::format("<msup>{}{}</msup>", row(below), row(mathml(exponent)));
}

std::string table(const std::vector<const Expression*>& rows, bool are_rows) {
    std::string text;
    for (const Expression* one : rows) {
        std::string cells;
        if (are_rows)
            for (const ExpressionPtr& cell : one->children) cells += "<mtd>" + mathml(*cell) + "</mtd>";
        else cells = "<mtd>" + mathml(*one) + "</mtd>";
        text += "<mtr>" + cells + "</mtr>";
    }
    return row("<mo>[</mo><mtable>" + text + "</mtable><mo>]</mo>");
}

std::string condition(const Expression& e) {
    const auto part = [&](std::size_t i) { return condition(*e.children[i]); };
    if (e.name == "both" || e.name == "either")
        return part(0) + fmt::format("<mtext> {} </mtext>", e.name == "both" ? "and" : "or") + part(1);
    const char* text = e.name == "less" ? "&lt;" : e.name == "less_equal" ? "≤" : e.name == "greater" ? "&gt;" : "≥";
    return mathml(*e.children[0]) + sign(text) + mathml(*e.children[1]);
}

/// Values, each with where it holds.
std::string alternatives(const std::vector<std::pair<std::string, std::string>>& values) {
    std::string rows;
    for (const auto& [value, where] : values) rows += "<mtr><mtd>" + value + "</mtd><mtd>" + where + "</mtd></mtr>";
    return row("<mo>{</mo><mtable columnalign=\"left\">" + rows + "</mtable>");
}

std::string cases(const Expression& e) {
    std::vector<std::pair<std::string, std::string>> rows;
    for (std::size_t i = 0; i < e.children.size(); i += 2)
        rows.emplace_back(mathml(*e.children[i]), i + 1 == e.children.size() ? "<mtext>otherwise</mtext>" : condition(*e.children[i + 1]));
    return alternatives(rows);
}

std::string dots(const Expression& e) {
    const char* accent = e.name == "dot" ? "˙" : "¨";
    const Expression& of = *e.children[0];
    if (of.kind == Kind::name && find_quantity(of.name) == nullptr) return name_of(of, accent);
    const std::string d = e.name == "dot" ? fraction("<mi>d</mi>", "<mi>d</mi><mi>t</mi>")
                                          : fraction("<msup><mi>d</mi><mn>2</mn></msup>", "<mi>d</mi><msup><mi>t</mi><mn>2</mn></msup>");
    return d + factor(of);
}

std::string call(const Expression& e) {
    const auto part = [&](std::size_t i) { return mathml(*e.children[i]); };
    const std::size_t count = e.children.size();
    if ((e.name == "dot" || e.name == "ddot") && count == 1) return dots(e);
    if (e.name == "sqrt" && count == 1) return "<msqrt>" + part(0) + "</msqrt>";
    if (e.name == "abs" && count == 1) return row("<mo>|</mo>" + part(0) + "<mo>|</mo>");
    if (e.name == "exp" && count == 1) return fmt::format("<msup><mi>e</mi>{}</msup>", row(part(0)));
    if (e.name == "diff" && count == 2) return fraction("<mo>∂</mo>", "<mo>∂</mo>" + part(1)) + factor(*e.children[0]);
    if (e.name == "integral" && count == 4)
        return fmt::format("<msubsup><mo>∫</mo>{}{}</msubsup>{}<mi>d</mi>{}", row(part(2)), row(part(3)), factor(*e.children[0]),
                           part(1));
    if (e.name == "limit" && count >= 3) {
        const std::string place =
            count == 3 ? part(2) : fmt::format("<msup>{}{}</msup>", row(part(2)), sign(e.children[3]->kind == Kind::negate ? "−" : "+"));
        return fmt::format("<munder><mo>lim</mo>{}</munder>{}", row(part(1) + sign("→") + place), factor(*e.children[0]));
    }
    if (e.name == "at" && count == 3)
        return fmt::format("<msub>{}{}</msub>", row("<mo stretchy=\"false\">[</mo>" + part(0) + "<mo stretchy=\"false\">]</mo>"),
                           row(part(1) + sign("=") + part(2)));
    if (e.name == "quantity" && count == 2)
        return part(0) + "<mspace width=\"0.3em\"></mspace>" +
               fmt::format("<mtext>{}</mtext>", html_text(in_model_language(*e.children[1])));
    if (e.name == "transpose" && count == 1) return fmt::format("<msup>{}<mi>T</mi></msup>", row(factor(*e.children[0])));
    if (e.name == "inverse" && count == 1)
        return fmt::format("<msup>{}{}</msup>", row(factor(*e.children[0])), row("<mo>−</mo><mn>1</mn>"));
    if (e.name == "cross" && count == 2) return factor(*e.children[0]) + sign("×") + factor(*e.children[1]);
    if (e.name == "cases") return cases(e);
    if (e.name == "if" && count == 3)
        return alternatives({{part(1), part(0) + sign("≥") + "<mn>0</mn>"}, {part(2), "<mtext>otherwise</mtext>"}});
    if (e.name == "matrix" || e.name == "vector") {
        std::vector<const Expression*> rows;
        for (const ExpressionPtr& child : e.children) rows.push_back(child.get());
        return table(rows, e.name == "matrix");
    }
    const std::string name = e.name == "log" ? "ln" : e.name;
    return fmt::format("<mi>{}</mi><mo>&#8289;</mo>{}", html_text(name), bracketed(list(e)));
}

}  // namespace

std::string letter_text(std::string_view word) { return letter(word); }

std::string html_text(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

std::string mathml(const Expression& e) {
    const auto part = [&](std::size_t i) { return mathml(*e.children[i]); };
    switch (e.kind) {
        case Kind::number: return number(e);
        case Kind::name: return name_of(e);
        case Kind::call: return call(e);
        case Kind::negate: return sign("−") + factor(*e.children[0]);
        case Kind::add: return part(0) + sign("+") + (is_negative_first(*e.children[1]) ? bracketed(part(1)) : part(1));
        case Kind::subtract:
            return part(0) + sign("−") + (is_sum(*e.children[1]) || is_negative_first(*e.children[1]) ? bracketed(part(1)) : part(1));
        case Kind::multiply: {
            const bool are_numbers = e.children[1]->kind == Kind::number;
            return (is_negative_first(*e.children[0]) ? part(0) : factor(*e.children[0])) + (are_numbers ? sign("·") : sign("&#8290;")) +
                   factor(*e.children[1]);
        }
        case Kind::divide: return fraction(part(0), part(1));
        case Kind::power: return power(e);
        case Kind::sum: break;
    }
    return fmt::format("<munderover><mo>∑</mo>{}{}</munderover>{}", row(fmt::format("<mi>{}</mi>", letter(e.name)) + sign("=") + part(0)),
                       row(part(1)), factor(*e.children[2]));
}

std::string mathml(const Equation& equation) {
    std::string text;
    for (const ExpressionPtr& side : equation.sides) text += (text.empty() ? "" : sign("=")) + mathml(*side);
    return text;
}

std::string mathml_of_text(const std::string& text) {
    const auto source = std::make_shared<const Source>("formula", text);
    try {
        return text.find('=') == std::string::npos ? mathml(*parse_expression(excerpt_of(source)))
                                                   : mathml(parse_equation(excerpt_of(source)));
    } catch (const Failure&) {
        return text.empty() ? "" : fmt::format("<mtext>{}</mtext>", html_text(text));
    }
}

std::string math_element(const std::string& inside) { return inside.empty() ? "" : "<math display=\"block\">" + row(inside) + "</math>"; }

}  // namespace dalembert

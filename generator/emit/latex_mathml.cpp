// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/latex_mathml.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "emit/mathml.hpp"
#include "printed/latex_lexer.hpp"
#include "printed/latex_letter.hpp"

namespace dalembert {

namespace {

/// What is not shown.
struct NotShown {};

using Texts = std::map<std::string, const char*, std::less<>>;

const Texts operators{{"\\cdot", "·"},   {"\\times", "×"},  {"\\approx", "≈"}, {"\\le", "≤"},     {"\\ge", "≥"},          {"\\neq", "≠"},
                      {"\\pm", "±"},     {"\\mp", "∓"},     {"\\in", "∈"},     {"\\dots", "…"},   {"\\rightarrow", "→"},  {"\\propto", "∝"},
                      {"\\equiv", "≡"},  {"\\sim", "∼"},    {"\\ll", "≪"},     {"\\gg", "≫"},     {"\\Rightarrow", "⇒"},  {"\\langle", "⟨"},
                      {"\\rangle", "⟩"}, {"\\otimes", "⊗"}, {"\\circ", "∘"},   {"\\wedge", "∧"},  {"\\land", "∧"},        {"\\vee", "∨"},
                      {"\\lor", "∨"},    {"\\dagger", "†"}, {"\\star", "⋆"},   {"\\prime", "′"},  {"\\partial", "∂"},     {"\\nabla", "∇"},
                      {"-", "−"},        {"\\{", "{"},      {"\\}", "}"},      {"\\|", "‖"},      {"*", "∗"},             {":=", ":="}};
const Texts letters{{"\\infty", "∞"}, {"\\ell", "ℓ"}, {"\\hbar", "ℏ"}, {"\\intercal", "⊤"}};
const Texts large{{"\\int", "∫"}, {"\\sum", "∑"}, {"\\prod", "∏"}};
const Texts accents{{"\\dot", "˙"}, {"\\ddot", "¨"},  {"\\hat", "^"},      {"\\bar", "¯"},
                    {"\\vec", "→"}, {"\\tilde", "~"}, {"\\overline", "¯"}, {"\\underline", "_"}};
const std::set<std::string, std::less<>> functions{"\\sin",    "\\cos",    "\\tan",    "\\cot",  "\\sinh", "\\cosh", "\\tanh", "\\coth",
                                                   "\\arcsin", "\\arccos", "\\arctan", "\\exp",  "\\ln",   "\\log",  "\\lg",   "\\min",
                                                   "\\max",    "\\det",    "\\lim",    "\\sup",  "\\inf",  "\\arg"};
const std::map<std::string, std::pair<const char*, const char*>, std::less<>> matrices{
    {"matrix", {"", ""}},  {"array", {"", ""}},   {"smallmatrix", {"", ""}}, {"pmatrix", {"(", ")"}}, {"bmatrix", {"[", "]"}},
    {"Bmatrix", {"{", "}"}}, {"vmatrix", {"|", "|"}}, {"Vmatrix", {"‖", "‖"}},   {"cases", {"{", ""}},    {"dcases", {"{", ""}}};

constexpr const char* thin_space = "<mspace width=\"0.17em\"></mspace>";

std::string math_row(const std::string& inside) { return "<mrow>" + inside + "</mrow>"; }
std::string fence(std::string_view text, bool stretches) {
    return text.empty() ? "" : fmt::format("<mo{}>{}</mo>", stretches ? "" : " stretchy=\"false\"", html_text(text));
}

class Shown {
public:
    explicit Shown(std::vector<LatexToken> tokens) : tokens_(std::move(tokens)) {}

    std::string all() {
        std::string text = until_end(0);
        if (token().kind != Kind::end) throw NotShown();
        return text;
    }

private:
    using Kind = LatexToken::Kind;
    using Side = LatexToken::Side;

    const LatexToken& token() const { return tokens_[at_]; }
    bool is(std::string_view text) const { return token().is(text); }
    void next() {
        if (token().kind == Kind::end) throw NotShown();
        ++at_;
    }
    void expect(std::string_view text) {
        if (!is(text)) throw NotShown();
        next();
    }

    /// Up to what closes it. `environments` around it: within one '&' and '\\' end a cell, elsewhere they only align lines.
    std::string until_end(int environments) {
        const int outer = std::exchange(environments_, environments);
        std::string text;
        while (token().kind != Kind::end && token().kind != Kind::end_of && !is("}") && token().side != Side::right && !is_end_of_cell()) {
            if (is("&") || is("\\\\")) {
                next();
                continue;
            }
            const bool is_beside = !text.empty() && !text.ends_with("</mo>");
            text += (is_function() && is_beside ? thin_space : "") + with_scripts();
        }
        environments_ = outer;
        return text;
    }
    bool is_function() const { return token().kind == Kind::command && functions.contains(token().text); }
    bool is_end_of_cell() const { return environments_ > 0 && (is("&") || is("\\\\")); }

    std::string with_scripts() {
        const bool has_limits = large.contains(token().text) || is("\\lim");
        const bool is_integral = is("\\int");
        const bool has_argument = is_function();
        const std::string space = token().space == LatexToken::Space::quad ? "<mspace width=\"1em\"></mspace>" : "";
        const bool stands_alone = is("^") || is("_");  // of {}^A x
        std::string base = stands_alone ? "<mrow></mrow>" : atom();
        std::string below, above;
        for (;;) {
            if (is("_") && below.empty()) next(), below = argument();
            else if (is("^") && above.find('<') == std::string::npos) next(), above += argument();
            else if (is("'")) next(), above += "<mo>′</mo>";
            else break;
        }
        const char* kind = has_limits && !is_integral ? (below.empty() ? "mover" : above.empty() ? "munder" : "munderover")
                                                      : (below.empty() ? "msup" : above.empty() ? "msub" : "msubsup");
        if (!below.empty() || !above.empty())
            base = fmt::format("<{0}>{1}{2}{3}</{0}>", kind, math_row(base), below.empty() ? "" : math_row(below),
                               above.empty() ? "" : math_row(above));
        const bool is_bracket = is("(") || is("[") || is("{") || token().side == Side::left;
        return space + base + (has_argument ? "<mo>&#8289;</mo>" + std::string(is_bracket ? "" : thin_space) : "");
    }

    /// A group, or one token; of a number one digit.
    std::string argument() {
        if (token().kind == Kind::number && token().text.size() > 1) {
            std::string& digits = tokens_[at_].text;
            const std::string first = digits.substr(0, 1);
            digits.erase(0, 1);
            return fmt::format("<mn>{}</mn>", first);
        }
        if (token().kind == Kind::end || is("}")) throw NotShown();
        return atom();
    }

    std::string atom() {
        const LatexToken t = token();
        next();
        if (t.side == Side::left) return between(t);
        switch (t.kind) {
            case Kind::number: return fmt::format("<mn>{}</mn>", html_text(without_layout(t.text)));
            case Kind::letter: return fmt::format("<mi{}>{}</mi>", font_, t.text);
            case Kind::upright: return upright(t.text);
            case Kind::begin: return environment(t.text);
            case Kind::sign: return sign(t.text);
            case Kind::command: return command(t.text);
            default: throw NotShown();
        }
    }

    std::string between(const LatexToken& open) {
        const std::string inside = until_end(0);
        if (token().side != Side::right) throw NotShown();
        const LatexToken close = token();
        next();
        return math_row(fence(fence_text(open), true) + inside + fence(fence_text(close), true));
    }
    static std::string fence_text(const LatexToken& t) {
        if (t.is(".")) return "";
        const auto known = operators.find(t.text);
        return known != operators.end() ? known->second : t.text;
    }

    /// 0{,}55 and 1\,000.
    static std::string without_layout(std::string text) {
        std::erase_if(text, [](char c) { return c == '{' || c == '}'; });
        for (std::size_t at; (at = text.find("\\,")) != std::string::npos;) text.replace(at, 2, "\u2009");
        return text;
    }

    static std::string upright(const std::string& text) {
        if (text.find_first_of("\\$^_{}") != std::string::npos) throw NotShown();
        if (text.find(' ') != std::string::npos) return fmt::format("<mtext>{}</mtext>", html_text(text));
        return fmt::format("<mi mathvariant=\"normal\">{}</mi>", html_text(text));
    }

    std::string sign(const std::string& text) {
        if (text == "{") {
            const std::string inside = until_end(0);
            expect("}");
            return math_row(inside);
        }
        if (text == "^" || text == "_" || text == "&" || text == "\\\\" || text == "}" || text == "#") throw NotShown();
        const auto known = operators.find(text);
        static const std::set<std::string, std::less<>> fences{"(", ")", "[", "]", "|", "\\|", "\\{", "\\}"};
        return fence(known != operators.end() ? known->second : text, !fences.contains(text));
    }

    std::string command(const std::string& name) {
        if (name == "\\frac" || name == "\\binom") {
            const std::string above = math_row(argument());
            const std::string fraction =
                fmt::format("<mfrac{}>{}{}</mfrac>", name == "\\binom" ? " linethickness=\"0\"" : "", above, math_row(argument()));
            return name == "\\frac" ? fraction : math_row("<mo>(</mo>" + fraction + "<mo>)</mo>");
        }
        if (name == "\\sqrt") {
            if (!is("[")) return "<msqrt>" + argument() + "</msqrt>";
            next();
            std::string degree;
            while (!is("]")) degree += with_scripts();
            next();
            return fmt::format("<mroot>{}{}</mroot>", math_row(argument()), math_row(degree));
        }
        if (name == "\\differential") return "<mi mathvariant=\"normal\">d</mi>";
        if (name == "\\mathbf" || name == "\\mathcal") {
            const std::string outer = font_;
            if (name == "\\mathbf") font_ = " mathvariant=\"normal\" style=\"font-weight:bold\"";
            std::string inside = argument();
            font_ = outer;
            return inside;
        }
        if (const auto accent = accents.find(name); accent != accents.end()) {
            const char* kind = name == "\\underline" ? "munder" : "mover";
            return fmt::format("<{0} accent=\"true\">{1}<mo stretchy=\"false\">{2}</mo></{0}>", kind, math_row(argument()), accent->second);
        }
        if (functions.contains(name)) return fmt::format("<mi>{}</mi>", name.substr(1));
        if (const auto known = large.find(name); known != large.end()) return fmt::format("<mo>{}</mo>", known->second);
        if (const auto known = letters.find(name); known != letters.end()) return fmt::format("<mi>{}</mi>", known->second);
        if (const auto known = operators.find(name); known != operators.end()) return fmt::format("<mo>{}</mo>", known->second);
        if (is_greek(name)) return fmt::format("<mi{}>{}</mi>", font_, letter_text(greek_name(name)));
        throw NotShown();
    }

    std::string environment(const std::string& name) {
        const auto found = matrices.find(name);
        if (found == matrices.end()) throw NotShown();
        const bool is_cases = name == "cases" || name == "dcases";
        std::string rows, cells;
        for (;;) {
            cells += "<mtd>" + until_end(1) + "</mtd>";
            if (is("&")) {
                next();
                continue;
            }
            rows += "<mtr>" + cells + "</mtr>";
            cells.clear();
            if (is("\\\\")) {
                next();
                if (token().kind != Kind::end_of) continue;
            }
            if (token().kind != Kind::end_of || token().text != name) throw NotShown();
            next();
            break;
        }
        const auto [open, close] = found->second;
        const std::string table = fmt::format("<mtable{}>{}</mtable>", is_cases ? " columnalign=\"left\"" : "", rows);
        return math_row(fence(open, true) + table + fence(close, true));
    }

    std::vector<LatexToken> tokens_;
    std::size_t at_ = 0;
    int environments_ = 0;
    std::string font_;
};

}  // namespace

std::string mathml_of_latex(const std::string& latex, const LatexMacros& macros) {
    try {
        const Excerpt text = without_macros(excerpt_of(std::make_shared<const Source>("formula", latex)), macros);
        return Shown(latex_tokens(text, 0, text.text.size(), '.')).all();
    } catch (const NotShown&) {
        return {};
    } catch (const Failure&) {  // no LaTeX that the lexer knows
        return {};
    }
}

}  // namespace dalembert

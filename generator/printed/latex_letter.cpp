// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_letter.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace dalembert {

namespace {

constexpr auto greek_letters = std::to_array<std::string_view>(
    {"alpha",    "beta",    "gamma",   "delta",  "epsilon", "varepsilon", "zeta",  "eta",   "theta", "vartheta", "iota",   "kappa",
     "varkappa", "lambda",  "mu",      "nu",     "xi",      "omicron",    "pi",    "varpi", "rho",   "varrho",   "sigma",  "varsigma",
     "tau",      "upsilon", "phi",     "varphi", "chi",     "psi",        "omega", "Gamma", "Delta", "Theta",    "Lambda", "Xi",
     "Pi",       "Sigma",   "Upsilon", "Phi",    "Psi",     "Omega",      "ell",   "hbar",  "imath", "jmath"});

const std::map<std::string, std::string, std::less<>> mark_names{
    {"\\mathbf", "bold"},   {"\\vec", "vec"},         {"\\mathcal", "cal"}, {"\\mathfrak", "frak"}, {"\\mathbb", "bb"},
    {"\\mathsf", "sf"},     {"\\mathtt", "tt"},       {"\\bar", "bar"},     {"\\hat", "hat"},       {"\\tilde", "tilde"},
    {"\\overline", "over"}, {"\\underline", "under"}, {"\\check", "check"}, {"\\breve", "breve"},   {"\\acute", "acute"},
    {"\\grave", "grave"},   {"\\mathring", "ring"}};

const std::map<std::string, std::string, std::less<>> sign_names{
    {"*", "star"},           {"+", "plus"},        {"-", "minus"},          {"\\infty", "inf"},     {"\\circ", "circ"},
    {"°", "circ"},           {"\\max", "max"},     {"\\min", "min"},        {"\\perp", "perp"},     {"\\parallel", "par"},
    {"'", "prime"},          {"\\prime", "prime"}, {"\\differential", "d"}, {"\\times", "times"},   {"\\dagger", "dagger"},
    {"\\partial", "border"}, {"=", "is"},          {"\\star", "star"},      {"\\rightarrow", "to"}, {"\\Sigma", "Sigma"},
    {"\\lim", "lim"},        {"\\sup", "sup"},     {"\\odot", "odot"},      {"\\oplus", "oplus"},   {"\\complement", "complement"},
    {"\\cap", "cap"},        {"\\cup", "cup"},     {"\\pm", "pm"},          {"\\mp", "mp"}};

bool is_alphanumeric(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

std::string without_blanks(std::string text) {
    std::erase(text, ' ');
    return text;
}

/// Letters and digits; what stands between them becomes one underscore.
std::string as_name(std::string_view text) {
    std::string name;
    for (const char c : text) {
        if (is_alphanumeric(c)) name += c;
        else if (!name.empty() && name.back() != '_') name += '_';
    }
    while (name.ends_with('_')) name.pop_back();
    return name;
}

/// "u'v'" in words: "u_prime_v_prime"; "\\rho u" is "rho u".
std::string words_of(std::string_view base) {
    std::string text;
    for (const char c : base) {
        if (c == '\'') text += "_prime_";
        else text += c == '\\' ? '_' : c;
    }
    return text;
}

}  // namespace

bool is_greek(std::string_view command) {
    return command.starts_with('\\') && std::find(greek_letters.begin(), greek_letters.end(), command.substr(1)) != greek_letters.end();
}

std::string greek_name(std::string_view command) {
    std::string_view name = command.substr(1);
    if (name.starts_with("var") && name != "var") name.remove_prefix(3);
    return std::string(name);
}

std::string canonical_script(const std::vector<LatexToken>& script) {
    std::string text;
    bool ends_in_command = false;
    for (const LatexToken& token : script) {
        const bool is_word = token.text == "\\max" || token.text == "\\min" || token.text == "\\lim" || token.text == "\\sup";
        const std::string part = is_word ? token.text.substr(1) : without_blanks(token.text);
        if (ends_in_command && !part.empty() && is_alphanumeric(part[0])) text += ' ';
        text += part;
        ends_in_command = token.kind == LatexToken::Kind::command && !is_word;
    }
    return text;
}

std::string script_name(const std::vector<LatexToken>& script) {
    std::string text;
    for (const LatexToken& token : script) {
        if (const auto sign = sign_names.find(token.text); sign != sign_names.end()) text += "_" + sign->second + "_";
        else if (is_greek(token.text)) text += "_" + greek_name(token.text) + "_";
        else text += token.text;
    }
    return as_name(text);
}

bool can_be_script(const LatexToken& token) {
    if (token.kind == LatexToken::Kind::command) return is_greek(token.text) || sign_names.contains(token.text);
    return token.kind != LatexToken::Kind::begin && token.kind != LatexToken::Kind::end_of;
}

std::string LatexLetter::canonical() const {
    std::string text = is_upright ? "\\mathrm{" + base + "}" : base;
    for (const std::string& mark : marks) text = mark + "{" + text + "}";
    constexpr std::array<const char*, 5> dotted{"", "\\dot", "\\ddot", "\\dddot", "\\ddddot"};
    if (dots > 0) text = std::string(dotted[static_cast<std::size_t>(std::min(dots, 4))]) + "{" + text + "}";
    if (is_difference) text = "\\Delta " + text;
    if (!before.empty()) text = "{}^{" + canonical_script(before) + "}" + text;
    const auto script = [&](const char* sign, const std::vector<LatexToken>& tokens) {
        if (tokens.empty()) return;
        const std::string inside = canonical_script(tokens);
        text += inside.size() == 1 ? sign + inside : std::string(sign) + "{" + inside + "}";
    };
    script("_", index);
    script("^", label);
    return text + std::string(static_cast<std::size_t>(primes), '\'');
}

std::string LatexLetter::plain_name() const {
    std::string name = is_difference ? "Delta_" : "";
    if (const std::string part = script_name(before); !part.empty()) name += part + "_";
    constexpr std::array<const char*, 10> digits{"zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    if (base.size() == 1 && base[0] >= '0' && base[0] <= '9') name += digits[static_cast<std::size_t>(base[0] - '0')];  // \mathbf{1}
    else name += base.starts_with('\\') && is_greek(base) ? greek_name(base) : as_name(words_of(base));
    for (const std::string& mark : marks) {
        const auto known = mark_names.find(mark);
        name += "_" + (known != mark_names.end() ? known->second : mark.substr(1));
    }
    for (const std::vector<LatexToken>* script : {&index, &label})
        if (const std::string part = script_name(*script); !part.empty()) name += "_" + part;
    for (int i = 0; i < primes; ++i) name += "_prime";
    return name;
}

std::optional<std::string> LatexLetter::meant_by_dummy() const {
    if (base == "\\tau" && marks.empty() && index.empty() && dots == 0) return "t";
    if (dots > 0) return std::nullopt;
    LatexLetter meant = *this;
    const auto is_dummy = [](const std::string& mark) { return mark == "\\tilde" || mark == "\\bar" || mark == "\\hat"; };
    std::erase_if(meant.marks, is_dummy);
    meant.primes = 0;
    if (meant.marks.size() == marks.size() && primes == 0) return std::nullopt;
    return meant.plain_name();
}

bool LatexLetter::is_vector() const {
    return std::any_of(marks.begin(), marks.end(), [](const std::string& mark) { return mark == "\\mathbf" || mark == "\\vec"; });
}

}  // namespace dalembert

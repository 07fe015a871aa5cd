// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_macros.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dalembert {

namespace {

constexpr std::size_t most_macro_calls = 2'000;
constexpr std::size_t longest_text = 100'000;

bool is_macro_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_macro_digit(char c) { return c >= '0' && c <= '9'; }
bool is_macro_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Of the package physics, where the text defines none of its own.
const LatexMacros& usual_macros() {
    static const LatexMacros macros{{"vb", {1, {}, "\\mathbf{#1}"}},
                                    {"va", {1, {}, "\\vec{#1}"}},
                                    {"abs", {1, {}, "\\left|#1\\right|"}},
                                    {"norm", {1, {}, "\\left\\|#1\\right\\|"}},
                                    {"grad", {0, {}, "\\nabla "}},
                                    {"curl", {0, {}, "\\nabla\\times "}},
                                    {"divergence", {0, {}, "\\nabla\\cdot "}},
                                    {"laplacian", {0, {}, "\\nabla^2 "}},
                                    {"ket", {1, {}, "|#1\\rangle "}},
                                    {"bra", {1, {}, "\\langle #1|"}},
                                    {"expval", {1, {}, "\\langle #1\\rangle "}},
                                    {"mel", {3, {}, "\\langle #1|#2|#3\\rangle "}},
                                    {"mathd", {0, {}, "\\mathrm{d}"}},
                                    {"mathe", {0, {}, "\\mathrm{e}"}},
                                    {"flatfrac", {2, {}, "{#1}/{#2}"}}};
    return macros;
}

bool is_derivative(std::string_view name) { return name == "dv" || name == "pdv" || name == "odv"; }

bool defines(std::string_view name) {
    return name == "newcommand" || name == "renewcommand" || name == "providecommand" || name == "DeclareMathOperator" || name == "def";
}

/// A text that is written out from left to right.
class MacroText {
public:
    MacroText(const Excerpt& text, LatexMacros& macros) : text_(text), macros_(macros) {}

    Excerpt run() {
        for (std::size_t i = 0; i < text_.text.size();) {
            if (text_.text[i] == '%') {
                while (i < text_.text.size() && text_.text[i] != '\n') ++i;
                continue;
            }
            if (text_.text[i] != '\\') {
                ++i;
                continue;
            }
            const std::size_t begin = i;
            const std::string name = name_at(i);
            if (name.empty()) i += 2;
            else if (defines(name)) i = define(name, begin, i);
            else if (const LatexMacro* macro = find(name)) i = call(*macro, name, begin, i);
            else if (name == "mathchoice") i = first_choice(name, begin, i);
            else if (name == "braket") i = braket(begin, i);
            else if (is_derivative(name) && starts_derivative(i)) i = derivative(name, begin, i);
        }
        return std::move(text_);
    }

    /// Definitions only: what else a preamble calls is not of interest.
    void run_definitions() {
        for (std::size_t i = 0; i < text_.text.size();) {
            if (text_.text[i] == '%') {
                while (i < text_.text.size() && text_.text[i] != '\n') ++i;
            } else if (text_.text[i] == '\\') {
                const std::size_t begin = i;
                const std::string name = name_at(i);
                if (name.empty()) i += 2;
                else if (defines(name)) i = define_if_possible(name, begin, i);
            } else {
                ++i;
            }
        }
    }

private:
    char at(std::size_t i) const { return i < text_.text.size() ? text_.text[i] : '\0'; }
    [[noreturn]] void wrong(std::size_t begin, std::size_t end, std::string message) const {
        const std::size_t size = text_.text.size();
        fail(Id::syntax, text_.span(std::min(begin, size), std::min(end, size)), std::move(message));
    }
    void skip_blanks(std::size_t& i) const {
        while (is_macro_blank(at(i))) ++i;
    }

    /// The letters behind the backslash at i, and i behind them; nothing, and i where it was, where a sign stands there.
    std::string name_at(std::size_t& i) const {
        std::size_t k = i + 1;
        while (is_macro_letter(at(k))) ++k;
        const std::string name = text_.text.substr(std::min(i + 1, text_.text.size()), k - i - 1);
        if (!name.empty()) i = k;
        return name;
    }

    const LatexMacro* find(const std::string& name) const {
        if (const auto own = macros_.find(name); own != macros_.end()) return &own->second;
        const auto usual = usual_macros().find(name);
        return usual == usual_macros().end() ? nullptr : &usual->second;
    }

    /// Behind the bracket that closes the one at i.
    std::size_t behind(std::size_t i, char open, char close) const {
        int depth = 0;
        for (std::size_t k = i; k < text_.text.size(); ++k) {
            if (at(k) == '\\') ++k;
            else if (at(k) == open) ++depth;
            else if (at(k) == close && --depth == 0) return k + 1;
        }
        wrong(i, i + 1, fmt::format("this '{}' is never closed by '{}'", open, close));
    }

    /// What stands in braces at i, or the one token there; i is behind it then.
    std::string argument(std::size_t& i, const std::string& of) const {
        skip_blanks(i);
        if (at(i) == '{') {
            const std::size_t first = i;
            i = behind(i, '{', '}');
            return text_.text.substr(first + 1, i - first - 2);
        }
        if (i >= text_.text.size() || at(i) == '}') wrong(i, i + 1, fmt::format("an argument of '\\{}' is expected", of));
        const std::size_t first = i;
        if (at(i) != '\\') ++i;
        else if (name_at(i).empty()) i += 2;
        while (i < text_.text.size() && (static_cast<unsigned char>(at(i)) & 0xC0U) == 0x80U) ++i;
        return text_.text.substr(first, i - first);
    }

    std::optional<std::string> optional_argument(std::size_t& i) const {
        std::size_t k = i;
        skip_blanks(k);
        if (at(k) != '[') return std::nullopt;
        const std::size_t end = behind(k, '[', ']');
        i = end;
        return text_.text.substr(k + 1, end - k - 2);
    }

    /// A command must not run into a letter behind it.
    static void append(std::string& text, std::string_view more) {
        std::size_t k = text.size();
        while (k > 0 && is_macro_letter(text[k - 1])) --k;
        const bool ends_in_command = k > 0 && k < text.size() && text[k - 1] == '\\' && (k < 2 || text[k - 2] != '\\');
        if (ends_in_command && !more.empty() && is_macro_letter(more[0])) text += ' ';
        text += more;
    }

    /// The bytes [begin, end) become this, and all of it stands at begin.
    void replace(std::size_t begin, std::size_t end, std::string by) {
        if (const char next = at(end); is_macro_letter(next)) append(by, std::string_view(&next, 1)), by.pop_back();
        const std::size_t place = text_.offsets[begin];
        text_.text.replace(begin, end - begin, by);
        const auto from = text_.offsets.begin() + static_cast<std::ptrdiff_t>(begin);
        text_.offsets.erase(from, from + static_cast<std::ptrdiff_t>(end - begin));
        text_.offsets.insert(text_.offsets.begin() + static_cast<std::ptrdiff_t>(begin), by.size(), place);
    }

    void count(const std::string& name, std::size_t begin, std::size_t end) {
        if (++calls_ > most_macro_calls || text_.text.size() > longest_text)
            fail(Id::too_long, text_.span(begin, end),
                 fmt::format("the macro '\\{}' makes the equation too long; perhaps it calls itself", name));
    }

    std::size_t call(const LatexMacro& macro, const std::string& name, std::size_t begin, std::size_t i) {
        count(name, begin, i);
        std::vector<std::string> arguments;
        if (at(i) == '*') ++i;
        if (macro.first && macro.arguments > 0) arguments.push_back(optional_argument(i).value_or(*macro.first));
        while (arguments.size() < macro.arguments) arguments.push_back(argument(i, name));
        std::string text;
        for (std::size_t k = 0; k < macro.body.size(); ++k) {
            const char c = macro.body[k];
            const bool is_argument = c == '#' && k + 1 < macro.body.size() && macro.body[k + 1] >= '1' &&
                                     static_cast<std::size_t>(macro.body[k + 1] - '0') <= macro.arguments;
            if (is_argument) append(text, arguments[static_cast<std::size_t>(macro.body[++k] - '1')]);
            else if (is_macro_letter(c) && k > 0 && macro.body[k - 1] != '\\' && !is_macro_letter(macro.body[k - 1]))
                append(text, std::string_view(&macro.body[k], 1));
            else text += c;
        }
        replace(begin, i, std::move(text));
        return begin;
    }

    /// What is displayed, of four sizes.
    std::size_t first_choice(const std::string& name, std::size_t begin, std::size_t i) {
        count(name, begin, i);
        std::string text = argument(i, name);
        for (int k = 0; k < 3; ++k) (void)argument(i, name);
        replace(begin, i, std::move(text));
        return begin;
    }

    /// \braket{a}{b} and \braket{a|b}
    std::size_t braket(std::size_t begin, std::size_t i) {
        count("braket", begin, i);
        std::string text = argument(i, "braket");
        if (at(i) == '{') text += "|" + argument(i, "braket");
        replace(begin, i, "\\langle " + text + "\\rangle ");
        return begin;
    }

    bool starts_derivative(std::size_t i) const {
        skip_blanks(i);
        return at(i) == '{' || at(i) == '[' || at(i) == '*';
    }

    /// \dv{f}{x}, \dv[2]{f}{x}, \dv{x}, \pdv{f}{x}{y}.
    std::size_t derivative(const std::string& name, std::size_t begin, std::size_t i) {
        count(name, begin, i);
        const std::string d = name == "pdv" ? "\\partial " : "\\mathrm{d}";
        if (at(i) == '*') ++i;
        const std::string order = optional_argument(i).value_or("");
        std::vector<std::string> arguments{argument(i, name)};
        for (const std::size_t most = name == "pdv" ? 3 : 2; arguments.size() < most && at(i) == '{';)
            arguments.push_back(argument(i, name));
        const std::string above = arguments.size() > 1 ? arguments.front() : "";
        const std::string times = arguments.size() > 2 ? "^2" : order.empty() ? "" : "^{" + order + "}";
        std::string text = "\\frac{" + d + times + " " + above + "}{" + d + (arguments.size() > 1 ? arguments[1] : arguments[0]);
        if (arguments.size() > 2) text += " " + d + arguments[2];
        else if (!order.empty()) text += "^{" + order + "}";
        replace(begin, i, text + "}");
        return begin;
    }

    /// A definition that is not read is missed only where an equation calls it.
    std::size_t define_if_possible(const std::string& command, std::size_t begin, std::size_t i) {
        try {
            return define(command, begin, i);
        } catch (const Failure&) {
            return i;
        }
    }

    /// The line goes.
    std::size_t define(const std::string& command, std::size_t begin, std::size_t i) {
        if (at(i) == '*') ++i;
        skip_blanks(i);
        const bool is_braced = at(i) == '{';
        if (is_braced) ++i;
        skip_blanks(i);
        if (at(i) != '\\') wrong(i, i + 1, fmt::format("the name of a macro is expected behind '\\{}'", command));
        std::size_t k = i;
        std::string name = name_at(k);
        if (name.empty()) wrong(i, i + 2, "a macro whose name is a sign is not read; name it by letters");
        skip_blanks(k);
        if (is_braced && at(k) != '}') wrong(k, k + 1, "'}' is expected behind the name of the macro");
        if (is_braced) ++k;
        LatexMacro macro;
        if (command == "def") {
            for (skip_blanks(k); at(k) == '#' && is_macro_digit(at(k + 1)); k += 2) ++macro.arguments;
            if (at(k) != '{') wrong(k, k + 1, "only '\\def' with '#1#2...' and braces is read");
        } else if (command != "DeclareMathOperator") {
            if (const auto number = optional_argument(k)) {
                if (number->size() != 1 || !is_macro_digit((*number)[0])) wrong(i, k, "a macro has up to nine arguments");
                macro.arguments = static_cast<std::size_t>((*number)[0] - '0');
                macro.first = optional_argument(k);
            }
        }
        macro.body = argument(k, command);
        if (command == "DeclareMathOperator") macro.body = "\\operatorname{" + macro.body + "}";
        if (command != "providecommand" || !macros_.contains(name)) macros_[std::move(name)] = std::move(macro);
        replace(begin, k, "");
        return begin;
    }

    Excerpt text_;
    LatexMacros& macros_;
    std::size_t calls_ = 0;
};

}  // namespace

void define_macro(LatexMacros& macros, const Excerpt& name, const std::string& body) {
    const std::string& text = name.text;
    if (text.size() < 2 || text[0] != '\\' || !std::all_of(text.begin() + 1, text.end(), is_macro_letter))
        fail(Id::syntax, name.whole(),
             fmt::format("'{}' is not the name of a macro; a backslash and letters are expected, such as '\\v'", text));
    LatexMacro macro{0, {}, body};
    for (std::size_t i = 0; i + 1 < body.size(); ++i)
        if (body[i] == '#' && is_macro_digit(body[i + 1]))
            macro.arguments = std::max(macro.arguments, static_cast<std::size_t>(body[i + 1] - '0'));
    macros[text.substr(1)] = std::move(macro);
}

void define_macros(LatexMacros& macros, const Excerpt& preamble) { MacroText(preamble, macros).run_definitions(); }

Excerpt without_macros(const Excerpt& text, const LatexMacros& macros) {
    LatexMacros known = macros;
    return MacroText(text, known).run();
}

}  // namespace dalembert

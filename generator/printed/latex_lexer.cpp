// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "printed/latex_commands.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

bool is_latex_digit(char c) { return c >= '0' && c <= '9'; }
bool is_latin(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_latex_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class LatexLexer {
public:
    LatexLexer(const Excerpt& excerpt, std::size_t from, std::size_t to, char decimal_mark)
        : excerpt_(excerpt), text_(excerpt.text), i_(from), to_(to), decimal_mark_(decimal_mark) {}

    std::vector<LatexToken> run() {
        while (i_ < to_) word();
        add(Kind::end, "", to_, to_);
        return std::move(tokens_);
    }

private:
    using Kind = LatexToken::Kind;
    using Space = LatexToken::Space;
    using Side = LatexToken::Side;

    [[noreturn]] void wrong(std::size_t begin, std::size_t end, std::string message) const {
        fail(Id::syntax, excerpt_.span(begin, end), std::move(message));
    }

    void add(Kind kind, std::string text, std::size_t begin, std::size_t end, Side side = Side::neutral, std::size_t inside = 0) {
        if (tokens_.size() == budget::words)
            fail(Id::too_long, excerpt_.span(begin, end),
                 fmt::format("the equation has more than {} words and signs; split it", budget::words));
        tokens_.push_back({kind, std::move(text), begin, end, space_, side, inside});
        space_ = Space::none;
    }
    void spaced(Space space) { space_ = std::max(space_, space); }
    char at(std::size_t i) const { return i < to_ ? text_[i] : '\0'; }
    void skip_blanks() {
        while (i_ < to_ && is_latex_blank(text_[i_])) ++i_;
    }

    /// Where the brace that opens at i is closed.
    std::size_t closing(std::size_t i) const {
        int depth = 0;
        for (std::size_t k = i; k < to_; ++k) {
            if (text_[k] == '\\') ++k;
            else if (text_[k] == '{') ++depth;
            else if (text_[k] == '}' && --depth == 0) return k;
        }
        wrong(i, i + 1, "this '{' is never closed by '}'");
    }

    void word() {
        if (!wraps_.empty() && i_ == wraps_.back()) {
            wraps_.pop_back();
            ++i_;
            return;
        }
        const char c = text_[i_];
        if (is_latex_blank(c)) {
            spaced(Space::blank);
            ++i_;
        } else if (c == '~') {
            spaced(Space::thin);
            ++i_;
        } else if (c == '$') {
            ++i_;
        } else if (c == '%') {
            while (i_ < to_ && text_[i_] != '\n') ++i_;
        } else if (is_latex_digit(c) || (c == '.' && is_latex_digit(at(i_ + 1)))) {
            number();
        } else if (is_latin(c)) {
            add(Kind::letter, std::string(1, c), i_, i_ + 1);
            ++i_;
        } else if (c == '\\') {
            command();
        } else if (c == '{' && font_switch()) {
        } else {
            sign();
        }
    }

    /// Digits, one decimal point or comma with a digit behind it, groups of three behind \, .
    void number() {
        const std::size_t begin = i_;
        bool is_fraction = false;
        std::string value;  // as it is written, without what stands between thousands
        const auto digits = [&] { while (is_latex_digit(at(i_))) value += text_[i_++]; };
        digits();
        for (;;) {
            const std::string_view rest = text_.substr(i_, to_ - i_);
            const bool braced = rest.starts_with("{,}") || rest.starts_with("{.}");
            const std::size_t width = braced ? 3 : 1;
            const auto is_digit_at = [&](std::size_t k) { return is_latex_digit(at(i_ + k)); };
            if (!is_fraction && (braced || rest.starts_with('.') || (rest.starts_with(',') && i_ > begin)) && is_digit_at(width)) {
                const char mark = rest[braced ? 1 : 0];
                const bool is_group = is_digit_at(width + 1) && is_digit_at(width + 2) && !is_digit_at(width + 3) && i_ - begin < 4 &&
                                      text_[begin] != '0' && i_ > begin;
                const Mark meaning = meaning_of(mark, braced, is_group, begin, i_ + width + 3);
                if (meaning == Mark::end) break;
                if (meaning == Mark::thousands) {
                    while (text_.substr(i_, width) == rest.substr(0, width) && is_digit_at(width) && is_digit_at(width + 1) &&
                           is_digit_at(width + 2) && !is_digit_at(width + 3)) {
                        value += text_.substr(i_ + width, 3);
                        i_ += width + 3;
                    }
                    continue;
                }
                is_fraction = true;
                value += text_.substr(i_, width);
                i_ += width;
                digits();
            } else if (rest.starts_with("\\,") && is_digit_at(2) && is_digit_at(3) && is_digit_at(4) && !is_digit_at(5)) {
                value += text_.substr(i_, 5);
                i_ += 5;
            } else {
                break;
            }
        }
        add(Kind::number, std::move(value), begin, i_);
    }

    enum class Mark { decimal, thousands, end };

    /// What the mark in 42,164 is. Where the text does not say which mark divides thousands, three digits behind a comma are refused.
    Mark meaning_of(char mark, bool is_braced, bool is_group, std::size_t begin, std::size_t end) const {
        const bool is_other = decimal_mark_ != 0 && decimal_mark_ != mark;
        if (!is_group) return is_other && mark == ',' && !is_braced ? Mark::end : Mark::decimal;
        if (is_other) return Mark::thousands;
        const bool is_plain_point = mark == '.' && !is_braced;  // most texts have a decimal point, and those that have not may say so
        if (decimal_mark_ == mark || is_plain_point) return Mark::decimal;
        wrong(begin, std::min(end, to_),
              fmt::format("it is not clear whether this '{}' stands between thousands or before decimals; say decimal = \".\" or decimal = "
                          "\",\" under [catalogue], or write '1\\,234' for thousands",
                          mark));
    }

    /// {\bf M} is \mathbf{M}, {\rm kg} is \mathrm{kg}.
    bool font_switch() {
        static const latex::Spellings switches{{"\\bf", "\\mathbf"},
                                                                              {"\\bfseries", "\\mathbf"},
                                                                              {"\\boldmath", "\\mathbf"},
                                                                              {"\\cal", "\\mathcal"},
                                                                              {"\\rm", "\\mathrm"},
                                                                              {"\\sf", "\\mathrm"},
                                                                              {"\\tt", "\\mathrm"},
                                                                              {"\\it", ""},
                                                                              {"\\em", ""},
                                                                              {"\\sl", ""},
                                                                              {"\\mit", ""}};
        const std::size_t begin = i_++;
        skip_blanks();
        const std::size_t name_begin = i_;
        const auto font = at(i_) == '\\' ? switches.find(command_name()) : switches.end();
        if (font == switches.end()) {
            i_ = begin;
            return false;
        }
        skip_blanks();
        if (font->second == "\\mathrm") {
            const std::size_t close = closing(begin);
            const std::string text(text_.substr(i_, close - i_));
            const std::size_t inside = std::exchange(i_, close + 1);
            if (text == "d") add(Kind::command, "\\differential", begin, i_);
            else add(Kind::upright, text, begin, i_, Side::neutral, inside);
            return true;
        }
        if (!font->second.empty()) add(Kind::command, font->second, name_begin, i_);
        add(Kind::sign, "{", begin, begin + 1);
        return true;
    }

    void sign() {
        const std::string_view rest = text_.substr(i_, to_ - i_);
        std::size_t length = 1;
        if (rest.starts_with(":=")) length = 2;
        else if (rest.starts_with("...")) length = 3;
        else
            while (i_ + length < to_ && (static_cast<unsigned char>(text_[i_ + length]) & 0xC0U) == 0x80U) ++length;
        std::string text(rest.substr(0, length));
        if (text == "...") text = "\\dots";
        if (const auto known = latex::spelt_out.find(text); known != latex::spelt_out.end()) text = known->second;
        const Kind kind = text.starts_with('\\') ? Kind::command : Kind::sign;
        add(kind, std::move(text), i_, i_ + length);
        i_ += length;
    }

    /// The name of the command at i_, which moves behind it.
    std::string command_name() {
        const std::size_t begin = i_++;
        if (is_latin(at(i_)))
            while (is_latin(at(i_))) ++i_;
        else if (i_ < to_) {
            ++i_;
            while (i_ < to_ && (static_cast<unsigned char>(text_[i_]) & 0xC0U) == 0x80U) ++i_;
        }
        std::string name(text_.substr(begin, i_ - begin));
        if (name.size() == 2 && is_latex_blank(name[1])) name = "\\ ";
        return name;
    }

    void command() {
        const std::size_t begin = i_;
        std::string name = command_name();
        if (name == "\\") wrong(begin, i_, "a command such as '\\frac' is expected behind the backslash");
        if (latex::thin_spaces.contains(name)) return spaced(Space::thin);
        if (name == "\\quad" || name == "\\qquad") return spaced(Space::quad);
        if (name == "\\\\" || name == "\\cr" || name == "\\tabularnewline") return line_break(begin);
        if (name == "\\qty" && at(i_) == '{') return add(Kind::command, name, begin, i_);
        if (latex::without_meaning.contains(name)) return;
        if (latex::with_idle_argument.contains(name)) return idle_argument(name, begin);
        if (name == "\\intertext" || name == "\\shortintertext") return words_between(name, begin);
        if (latex::bracket_sizes.contains(name)) return bracket(name, begin);
        if (name == "\\begin" || name == "\\end") return environment(name, begin);
        if (latex::upright_commands.contains(name)) return upright(name, begin);
        if (name == "\\%") return add(Kind::sign, "%", begin, i_);
        if (const auto known = latex::one_spelling.find(name); known != latex::one_spelling.end()) name = known->second;
        if (name == "\\Pr") return add(Kind::upright, "Pr", begin, i_);
        if (name == "\\log_{10}") return add(Kind::command, "\\lg", begin, i_);
        add(name.starts_with('\\') && name != "\\{" && name != "\\}" && name != "\\|" ? Kind::command : Kind::sign, name, begin, i_);
    }

    /// A line break swallows an extra distance, \\[2mm].
    void line_break(std::size_t begin) {
        if (at(i_) == '*') ++i_;
        if (at(i_) == '[') {
            std::size_t k = i_ + 1;
            while (is_latex_digit(at(k)) || at(k) == '.' || at(k) == '-') ++k;
            const std::size_t digits = k;
            while (is_latin(at(k))) ++k;
            if (digits > i_ + 1 && k == digits + 2 && at(k) == ']') i_ = k + 1;
        }
        add(Kind::sign, "\\\\", begin, i_);
    }

    /// A line of words between equations. One with a relation is refused: it may be a condition of what follows.
    void words_between(const std::string& name, std::size_t begin) {
        idle_argument(name, begin);
        if (text_.substr(begin, i_ - begin).find_first_of("<>=") != std::string::npos)
            wrong(begin, i_, "this text cannot be read; end the block before it");
        add(Kind::sign, "\\\\", begin, i_);
    }

    void idle_argument(const std::string& name, std::size_t begin) {
        if (at(i_) == '*') ++i_;
        skip_blanks();
        if (at(i_) != '{') wrong(begin, i_, fmt::format("'{{' is expected behind '{}'", name));
        i_ = closing(i_) + 1;
        if (!latex::wraps_second_argument.contains(name)) return;
        skip_blanks();
        if (at(i_) != '{') return;
        if (wraps_.size() == static_cast<std::size_t>(budget::nesting))
            fail(Id::too_deep, excerpt_.span(begin, i_),
                 fmt::format("'{}' is nested more than {} levels deep", name, static_cast<std::size_t>(budget::nesting)));
        wraps_.push_back(closing(i_));
        ++i_;
    }

    void bracket(const std::string& size, std::size_t begin) {
        skip_blanks();
        if (i_ >= to_) wrong(begin, i_, fmt::format("a bracket is expected behind '{}'", size));
        std::string text;
        if (at(i_) == '\\') {
            text = command_name();
            if (const auto known = latex::one_spelling.find(text); known != latex::one_spelling.end()) text = known->second;
        } else {
            text = std::string(1, text_[i_++]);
            if (text == "<" && size == "\\left") text = "\\langle";
            if (text == ">" && size == "\\right") text = "\\rangle";
        }
        static const latex::Words brackets{"(", ")", "[", "]", "\\{", "\\}", "|", "\\|", ".", "/"};
        if (text == "\\langle" || text == "\\rangle")
            return add(Kind::command, text, begin, i_, text == "\\langle" ? Side::left : Side::right);
        if (!brackets.contains(text)) wrong(begin, i_, fmt::format("a bracket is expected behind '{}'", size));
        const bool left = size == "\\left" || size.back() == 'l';
        const bool right = size == "\\right" || size.back() == 'r';
        if (text == "." && !left && !right) return;
        add(Kind::sign, text, begin, i_, left ? Side::left : right ? Side::right : Side::neutral);
    }

    void environment(const std::string& name, std::size_t begin) {
        skip_blanks();
        if (at(i_) != '{') wrong(begin, i_, fmt::format("'{{' is expected behind '{}'", name));
        const std::size_t close = closing(i_);
        std::string text(text_.substr(i_ + 1, close - i_ - 1));
        if (text.ends_with('*')) text.pop_back();
        i_ = close + 1;
        const bool is_begin = name == "\\begin";
        if (is_begin && at(i_) == '[') {  // where it is aligned
            const std::size_t end = text_.substr(0, to_).find(']', i_);
            if (end != std::string::npos && end - i_ == 2) i_ = end + 1;
        }
        if (is_begin && (text == "array" || text == "alignat" || text == "alignedat" || text == "tabular")) {
            skip_blanks();
            if (at(i_) == '{') i_ = closing(i_) + 1;
        }
        add(is_begin ? Kind::begin : Kind::end_of, std::move(text), begin, i_);
    }

    void upright(const std::string& name, std::size_t begin) {
        if (at(i_) == '*') ++i_;
        skip_blanks();
        if (i_ >= to_) wrong(begin, i_, fmt::format("'{{' is expected behind '{}'", name));
        if ((name == "\\mathnormal" || name == "\\mathit") && at(i_) == '{' && at(i_ + 1) == '\\') return;  // of \mathit{\Omega}
        if (at(i_) == '{') {
            const std::size_t close = closing(i_);
            std::size_t inside = i_ + 1;
            std::string text(text_.substr(inside, close - inside));
            if (text.starts_with("\\boldmath$")) {  // \mbox{\boldmath$v$}
                add(Kind::command, "\\mathbf", begin, inside);
                return;
            }
            i_ = close + 1;
            for (const std::string font : {"\\textrm{", "\\mathrm{", "\\text{"}) {
                if (!text.starts_with(font) || text.find('}') != text.size() - 1) continue;
                inside += font.size();
                text = text.substr(font.size(), text.size() - font.size() - 1);
            }
            if (text == "d") return add(Kind::command, "\\differential", begin, i_);
            return add(Kind::upright, text, begin, i_, Side::neutral, inside);
        }
        if (!is_latin(at(i_))) wrong(begin, i_, fmt::format("'{{' is expected behind '{}'", name));
        const std::size_t inside = i_++;
        if (text_[inside] == 'd') return add(Kind::command, "\\differential", begin, i_);
        add(Kind::upright, std::string(1, text_[inside]), begin, i_, Side::neutral, inside);
    }

    const Excerpt& excerpt_;
    std::string_view text_;
    std::size_t i_;
    std::size_t to_;
    char decimal_mark_;
    Space space_ = Space::none;
    std::vector<LatexToken> tokens_;
    std::vector<std::size_t> wraps_;  ///< closing braces that are dropped, with their opening ones
};

}  // namespace

std::vector<LatexToken> latex_tokens(const Excerpt& excerpt, std::size_t from, std::size_t to, char decimal_mark) {
    return LatexLexer(excerpt, from, to, decimal_mark).run();
}

}  // namespace dalembert

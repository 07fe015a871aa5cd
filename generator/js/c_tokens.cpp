// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/c_tokens.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace dalembert {

namespace {

constexpr std::string_view long_signs[]{
    "<<=", ">>=", "...", "->", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Lexer {
public:
    explicit Lexer(std::string_view text) : text_(text) {}

    std::vector<CToken> run() {
        while (at_ < text_.size()) next();
        tokens_.push_back({CToken::Kind::end, ""});
        return std::move(tokens_);
    }

private:
    bool starts(std::string_view what) const { return text_.substr(at_, what.size()) == what; }

    void add(CToken::Kind kind, std::size_t size) {
        tokens_.push_back({kind, std::string(text_.substr(at_, size)), std::move(comment_)});
        comment_.clear();
        at_ += size;
    }

    std::size_t line_end() const { return std::min(text_.find('\n', at_), text_.size()); }

    void comment(std::size_t end) {
        comment_ += std::string(text_.substr(at_, end - at_)) + "\n";
        at_ = end;
    }

    void directive() {
        const std::size_t end = line_end();
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end;
        const std::size_t name = std::string_view("#define ").size();
        if (line.substr(0, name) != "#define ") return;
        const std::size_t behind = std::min(line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_", name), line.size());
        if (behind == line.size() || line[behind] != ' ') return;
        tokens_.push_back({CToken::Kind::sign, "#define"});
        for (CToken& token : Lexer(line.substr(name)).run()) tokens_.push_back(std::move(token));
        tokens_.back() = {CToken::Kind::sign, ";"};
    }

    void next() {
        const char c = text_[at_];
        if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            if (starts("\n\n")) comment_.clear();
            ++at_;
        } else if (starts("//"))
            comment(line_end());
        else if (starts("/*"))
            comment(text_.find("*/", at_) + 2);
        else if (c == '#')
            directive();
        else if (c == '@')
            add(CToken::Kind::placeholder, text_.find('@', at_ + 1) + 1 - at_);
        else if (c == '"')
            add(CToken::Kind::string, text_.find('"', at_ + 1) + 1 - at_);
        else if (std::isdigit(static_cast<unsigned char>(c)) != 0)
            number();
        else if (is_word(c)) {
            std::size_t end = at_;
            while (end < text_.size() && is_word(text_[end])) ++end;
            add(CToken::Kind::name, end - at_);
        } else {
            for (const std::string_view sign : long_signs)
                if (starts(sign)) return add(CToken::Kind::sign, sign.size());
            add(CToken::Kind::sign, 1);
        }
    }

    /// With the suffixes of C, which are left out.
    void number() {
        std::size_t end = at_;
        const bool is_hexadecimal = starts("0x");
        while (end < text_.size() && (is_word(text_[end]) || text_[end] == '.' ||
                                      ((text_[end] == '-' || text_[end] == '+') && text_[end - 1] == 'e' && !is_hexadecimal)))
            ++end;
        add(CToken::Kind::number, end - at_);
        std::string& text = tokens_.back().text;
        while (std::string_view(is_hexadecimal ? "uUlL" : "uUlLfF").find(text.back()) != std::string_view::npos) text.pop_back();
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::string comment_;
    std::vector<CToken> tokens_;
};

}  // namespace

std::vector<CToken> c_tokens(std::string_view text) { return Lexer(text).run(); }

}  // namespace dalembert

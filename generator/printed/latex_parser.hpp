// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of printed equations: what the files latex_*.cpp share. Users include latex_reader.hpp.
//
// note [how a product is read]  Letters beside each other are a product, and so bind more strongly than a sign: a \cdot b c is a (b c).
// "/" divides by one factor; what is ambiguous to a reader (a/b c) is refused. A function without brackets (\sin 2\theta x) takes numbers,
// letters and fractions up to a space \, , a sign, a bracket, a dotted or bold letter or another function; a letter that is an angle by
// custom (\alpha ... \theta, \varphi, \psi) ends it. \frac{d}{dt} and \nabla take the one factor behind them, \sum and \lim the rest of the
// product. f(...) is a function where the notation says so, where the bracket holds letters and commas only, or one letter without index;
// where it is not clear what it is a function of, and the expression of f says that it matters, it is refused.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "printed/latex_letter.hpp"
#include "printed/latex_reader.hpp"

namespace dalembert {

class LatexParser {
public:
    LatexParser(const Excerpt& excerpt, const PrintedNotation& notation);

    /// Throws at the first equation that cannot be read, or, with `refused`, adds it there: note [what an equation takes with it].
    std::vector<LatexEquation> equations(std::vector<RefusedEquation>* refused = nullptr);
    ExpressionPtr whole_expression();
    std::string whole_letter();
    std::pair<std::string, std::vector<std::string>> whole_function();

private:
    using Kind = Expression::Kind;
    using Tokens = std::vector<LatexToken>;
    using Space = LatexToken::Space;
    using Side = LatexToken::Side;

    /// For a part of the text: the tokens of an index.
    LatexParser(const LatexParser& whole, Tokens part);

    // latex_parser.cpp: where we are, and sums and products -------------------------------------------------------------------------
    struct Depth {
        explicit Depth(LatexParser& parser);
        ~Depth() { --parser_.depth_; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        LatexParser& parser_;
    };
    /// What belongs to an integral or to the outermost level does not belong to what stands in its brackets.
    struct Inside;

    const LatexToken& token(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
    const LatexToken& at(std::size_t i) const { return tokens_[std::min(i, tokens_.size() - 1)]; }
    const LatexToken& next() { return tokens_[at_ + 1 < tokens_.size() ? at_++ : at_]; }
    bool is(std::string_view text) const { return token().is(text); }
    bool is_point() const { return is(".") && token().side == Side::neutral; }  ///< and not \\left.
    bool take(std::string_view text);
    bool is_end() const { return token().kind == LatexToken::Kind::end; }
    Span place(const LatexToken& token) const { return excerpt_.span(token.begin, token.end); }
    Span from(std::size_t first) const;
    std::string shown(const LatexToken& token) const;
    [[noreturn]] void expected(std::string_view what) const;
    [[noreturn]] void wrong(const Span& span, std::string message) const { fail(Id::syntax, span, std::move(message)); }
    void expect(std::string_view text);
    /// The index of the brace that closes the one at i; of any bracket. Behind the end without one.
    std::size_t closing_brace(std::size_t i) const;
    std::size_t closing_bracket(std::size_t i) const;
    /// Behind the group or single token at i.
    std::size_t behind_argument(std::size_t i) const;

    ExpressionPtr node(Kind kind, std::size_t first, std::vector<ExpressionPtr> children, std::string name = {}) const;
    ExpressionPtr call(std::string name, std::size_t first, std::vector<ExpressionPtr> children) const {
        return node(Kind::call, first, std::move(children), std::move(name));
    }
    ExpressionPtr number(Rational value, std::size_t first) const { return make_number(std::move(value), from(first)); }

    ExpressionPtr expression();
    ExpressionPtr signed_term();
    ExpressionPtr term();
    ExpressionPtr product();
    ExpressionPtr quotient(ExpressionPtr left, std::size_t first);
    bool starts_factor();
    bool starts_factor_at(std::size_t i);
    ExpressionPtr braced(const char* what);     ///< {expression} or one token
    bool is_vector(const Expression& e) const;  ///< as printed: bold, with an arrow, or made of such

    // latex_factors.cpp: brackets, powers, numbers ----------------------------------------------------------------------------------
    ExpressionPtr factor();
    ExpressionPtr primary();
    ExpressionPtr postfix(ExpressionPtr base, std::size_t first);
    ExpressionPtr superscript(ExpressionPtr base, std::size_t first);
    ExpressionPtr bracket();
    ExpressionPtr group();
    ExpressionPtr grouped();  ///< without an index behind it
    ExpressionPtr magnitude();
    ExpressionPtr number_factor();
    ExpressionPtr root();
    ExpressionPtr under_brace();
    ExpressionPtr cancelled();
    ExpressionPtr marked_expression();  ///< a dot or bar over more than a letter
    bool closes(const LatexToken& open, const LatexToken& token) const;

    // latex_without_value.cpp: read, although a text alone gives it no value ------------------------------------------------------------
    ExpressionPtr dots();
    ExpressionPtr binomial();
    ExpressionPtr average();              ///< also \\langle a | b \\rangle and \\langle a, b \\rangle
    ExpressionPtr pairing();              ///< <a, b>
    ExpressionPtr ket(std::size_t first, ExpressionPtr inside);
    ExpressionPtr extremum_over(const std::string& name, std::size_t first);
    ExpressionPtr value_of(ExpressionPtr function, std::size_t first);
    ExpressionPtr named_value(ExpressionPtr function, std::size_t first);
    ExpressionPtr partial_by_index();
    ExpressionPtr in_frame();
    ExpressionPtr under_font();
    bool has_differential_ahead() const;
    bool stands_before_rangle(std::size_t i) const;
    bool starts_named_value();
    bool starts_square_value(const LatexLetter& letter);
    bool starts_plain_value(std::size_t open, std::size_t close, const LatexLetter* letter);
    bool is_sample(std::size_t open, std::size_t close, bool is_known);
    std::optional<ExpressionPtr> material_rate();
    bool is_placeholder(std::size_t open, std::size_t close) const;
    bool has_odd_bars(std::size_t open, std::size_t close) const;
    std::size_t behind_zero_vector(std::size_t i) const;  ///< 0 where none stands

    // latex_units.cpp ------------------------------------------------------------------------------------------------------------------
    ExpressionPtr unit_behind();  ///< nothing where no unit stands
    ExpressionPtr unit_in_bracket();
    ExpressionPtr unit_product();
    void refuse_unit_behind_letters();
    ExpressionPtr unit_factor();

    // latex_letters.cpp ----------------------------------------------------------------------------------------------------------------
    struct Read {
        LatexLetter letter;
        std::size_t power_at = 0;  ///< of the power in q^2_j, which stands before the index
    };
    std::optional<Read> try_letter();
    std::optional<std::pair<Read, std::size_t>> letter_at(std::size_t i);
    bool read_nucleus(Read& read);
    bool read_marked(Read& read);
    bool read_scripts(Read& read);
    bool read_superscript(Read& read);
    bool read_scripts_before(Read& read);  ///< of {}^A x
    bool starts_scripts_before(std::size_t i) const;
    bool read_long_mark(Read& read);       ///< \overline{u'v'}
    Tokens script_tokens();  ///< of the group or single token behind _ or ^
    bool starts_letter(std::size_t i);
    ExpressionPtr letter_factor();
    ExpressionPtr translate(const LatexLetter& letter, std::size_t first);
    ExpressionPtr with_span(const Expression& meaning, const Span& span) const;
    std::optional<std::vector<ExpressionPtr>> family_indices(const LatexLetter& letter, std::string& name);
    bool counts(const LatexToken& token) const;
    static bool is_phrase(const LatexToken& token);  ///< several words that name something: \text{equatorial radius}

    // latex_arguments.cpp --------------------------------------------------------------------------------------------------------------
    struct Brackets {
        std::vector<std::string> names;  ///< of letters alone
        std::vector<std::pair<std::string, ExpressionPtr>> dummies;  ///< \tau for t, \tilde{x} for x
        std::string spelled;
        std::string printed;      ///< the same with variables of integration as they are
        bool is_plain = true;     ///< letters and commas
        bool is_list = false;
        bool is_instant = false;  ///< t_0
        bool has_place = false;   ///< x_A
        bool has_index = false;
    };
    struct Place {
        std::size_t first, bracket, close;
    };
    ExpressionPtr applied(ExpressionPtr function, const LatexLetter& letter, std::size_t first);
    ExpressionPtr of_letters(ExpressionPtr function, const LatexLetter& letter, const Brackets& found, Place place,
                             const std::function<void(const std::string&)>& unclear);
    ExpressionPtr value_at(const ExpressionPtr& function, const std::string& argument, const ExpressionPtr& value, std::size_t first);
    Brackets brackets_at(std::size_t open, std::size_t close);
    const LetterDependence* dependence_of(const Expression& function) const;
    bool is_called(const LatexLetter& letter);
    void find_calls();
    bool is_value_of(const std::vector<std::string>& arguments, std::size_t open, std::size_t close);
    static std::string as_argument(LatexLetter letter);
    const std::vector<std::string>* called_with(const LatexLetter& letter);
    ExpressionPtr slope_by_primes(const LatexLetter& letter, std::size_t first);
    const std::vector<std::string>* arguments_of(const LatexLetter& letter) const;
    std::vector<ExpressionPtr> list_until_bracket(const LatexToken& open);

    // latex_functions.cpp --------------------------------------------------------------------------------------------------------------
    bool is_function(const LatexToken& token) const;
    ExpressionPtr function();
    ExpressionPtr function_argument(const std::string& name);
    ExpressionPtr extremum(const std::string& name, std::size_t first);
    ExpressionPtr nabla();

    // latex_calculus.cpp ---------------------------------------------------------------------------------------------------------------
    struct Integral {
        ExpressionPtr variable;
    };
    bool at_differential();
    ExpressionPtr differential_variable();
    ExpressionPtr differential();
    ExpressionPtr fraction();
    bool is_derivative();
    ExpressionPtr derivative();
    ExpressionPtr derived(ExpressionPtr e, const std::vector<ExpressionPtr>& variables, bool is_partial, std::size_t first) const;
    ExpressionPtr operand(const char* what);
    int order();

    // latex_integrals.cpp --------------------------------------------------------------------------------------------------------------
    ExpressionPtr integral();
    ExpressionPtr counted();
    ExpressionPtr counted_without_limits(const LatexToken& sign, std::size_t first, const std::string& index, ExpressionPtr condition);
    int take_side_of_limit();
    ExpressionPtr limit();
    ExpressionPtr evaluated(ExpressionPtr e, std::size_t first);
    ExpressionPtr between(ExpressionPtr e, std::size_t first);
    bool is_evaluation_bar() const;

    // latex_matrices.cpp ---------------------------------------------------------------------------------------------------------------
    ExpressionPtr environment();
    ExpressionPtr cases(std::size_t first);
    ExpressionPtr condition();
    ExpressionPtr single_condition();
    bool starts_condition_group() const;
    void skip_remark();

    // latex_equations.cpp --------------------------------------------------------------------------------------------------------------
    void prepare();
    void take_signs();
    void take_over();
    void take_frames();
    void drop_remarks();
    void drop_empty_groups();
    void drop_marks_of_nabla();
    bool divides_columns(std::size_t column) const;
    void drop_tags();
    void drop_layout();
    bool is_layout(std::size_t begin) const;
    bool continues(std::size_t line_break) const;
    static std::optional<Relation> relation_of(const LatexToken& token);
    std::optional<Relation> relation() const { return relation_of(token()); }
    enum class Word { none, separator, condition, otherwise, constant, name, comment };
    Word word_of(const LatexToken& token) const;
    LatexEquation chain();
    bool is_between() const;
    void statement(std::vector<LatexEquation>& all);
    bool may_be_condition(std::size_t begin, std::size_t end) const;
    std::string named_letter();
    bool skip_range(LatexEquation* equation);
    void skip_set();
    bool skip_condition_in_brackets(LatexEquation& equation);

    const Excerpt& excerpt_;
    const PrintedNotation& notation_;
    Tokens tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;
    bool has_units_ = true;        ///< behind a number
    int magnitudes_ = 0;           ///< open bars: the next one closes
    int fractions_ = 0;            ///< around us
    int brackets_ = 0;             ///< 0: the outermost level, where \quad and commas separate
    Integral* integral_ = nullptr;  ///< the one whose differential may stand here
    std::string integrated_;       ///< the variable of the last integral, for [F]_a^b
    std::vector<std::string> counters_;  ///< of the sums around
    std::set<std::string, std::less<>> vectors_;  ///< names that are printed as vectors
    std::map<std::string, std::string, std::less<>> applied_;  ///< f -> "(x)" where the notation does not say what f depends on
    /// f(x): canonical letters with the names in their brackets, once they are asked for; none where there are different ones.
    std::optional<std::map<std::string, std::vector<std::string>, std::less<>>> called_with_letters_;
    std::map<std::string, std::string, std::less<>> called_;   ///< the letter that got each name
    bool has_differential_ = false;  ///< there was a dx outside of integrals, so that d(x y) is one too
    std::set<std::size_t> both_signs_;  ///< where \pm and \mp stand in the text
    std::string font_;  ///< of \\mathbf{R_1(\\gamma)}, for the letters in it
    std::set<std::size_t> not_a_letter_;  ///< groups that were tried
};

struct LatexParser::Inside {
    explicit Inside(LatexParser& parser) : parser_(parser), integral_(parser.integral_), magnitudes_(parser.magnitudes_) {
        ++parser_.brackets_;
        parser_.integral_ = nullptr;
        parser_.magnitudes_ = 0;
    }
    ~Inside() {
        --parser_.brackets_;
        parser_.integral_ = integral_;
        parser_.magnitudes_ = magnitudes_;
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    LatexParser& parser_;
    Integral* integral_;
    int magnitudes_;
};

}  // namespace dalembert

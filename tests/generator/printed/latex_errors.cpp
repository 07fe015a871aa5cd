// SPDX-License-Identifier: GPL-3.0-or-later
// What cannot be read as an equation is refused at the right place, and nothing makes the reader fall over.
#include <doctest/doctest.h>

#include <random>

#include "generator/printed/latex_rows.hpp"
#include "printed/latex_words.hpp"
#include "text/diagnostic.hpp"

using namespace dalembert;

namespace {

struct Wrong {
    const char* latex;
    std::size_t column;  ///< of the caret
    const char* says;    ///< part of the message
};

const Wrong wrongs[]{
    {"", 1, "there is no equation"},
    {"a", 1, "'a' is no equation; a relation such as '=' is expected in it"},
    {"a =", 3, "there is nothing behind '='"},
    {"a = , b = c", 3, "there is nothing behind '='"},
    {"= b", 1, "there is '=' where a number, a letter or a bracket is expected"},
    {"a = b +", 8, "the text ends where a number, a letter or a bracket is expected"},
    {R"(a = \frac{b}{c)", 15, "the text ends where '}' is expected"},
    {R"(a = \int_0^l dx\, f + g)", 21, "it is not clear whether the part behind '+' is integrated"},
    {R"(a = b \intertext{with $c = 0$,} d = f)", 7, "this text cannot be read; end the block before it"},
    {R"(a = \frac{b})", 13, "the text ends where the denominator is expected"},
    {R"(a = \frac{b}{})", 13, "the denominator is empty"},
    {R"(a = \frac)", 10, "the text ends where the numerator is expected"},
    {R"(a = b})", 6, "there is '}' where an operator"},
    {R"(a = (b + c)", 11, "the text ends where ')' is expected"},
    {R"(a = (b + c])", 11, "there is ']' where ')' is expected"},
    {R"(a = \left( b)", 13, R"('\right' with a bracket)"},
    {R"(a = \left)", 5, R"(a bracket is expected behind '\left')"},
    {R"(a = ())", 5, "the bracket is empty"},
    {R"(a = b \foo c)", 7, R"('\foo' cannot be read here)"},
    {R"(a = \mathrm{b)", 12, "this '{' is never closed"},
    {"a = b \\", 7, "a command such as"},
    {R"(a = \tan^{-1} b)", 11, R"(it is not clear whether '\tan^{-1}' is the inverse function or 1/\tan; write '\arctan')"},
    {R"(a = b + \cancel{c})", 9, "it is not clear whether the crossed out part is zero"},
    {"a = 42,164", 5, "it is not clear whether this ',' stands between thousands or before decimals"},
    {"a = 42{,}164 b", 5, "it is not clear whether this ',' stands between thousands or before decimals"},
    {R"(a = \sin)", 9, "the argument of 'sin'"},
    {R"(a = \sin \omega (t - b))", 17, "it is not clear whether this bracket belongs to the argument of 'sin'"},
    {R"(a = \cos\bar\omega t)", 20, "it is not clear whether 't' belongs to the argument of 'cos'"},
    {R"(a = \exp^{-1} x)", 11, "the inverse of 'exp' is not read"},
    {R"(a = b/c d)", 6, "it is not clear whether 'd' belongs to the divisor"},
    {R"(a = \frac{d}{dt})", 17, "what is differentiated"},
    {R"(a = \frac{d^2 x}{dt})", 17, "the order is 2 above and 1 below"},
    {R"(a = \frac{\partial^2 x}{\partial y \partial 2})", 45, "the letter of the derivative"},
    {R"(a = \partial x)", 5, R"('\partial' stands alone)"},
    {R"(a = \mathrm{d} + 1)", 5, "a letter is expected behind"},
    {R"(a = \int_0^1 x)", 5, "the integral has no differential such as 'dx'"},
    {R"(a = \frac{d}{dx} b \sin x)", 20, R"(it is not clear whether '\sin' is also differentiated)"},
    {R"(a = \begin{cases} b & x < 0 \\ c & \text{if $x>0$} \end{cases})", 36, "a condition is expected behind the text"},
    {R"(a = \sin b/2)", 11, "it is not clear whether '/2' belongs to the argument of 'sin'"},
    {R"(a = \int^1 x dx)", 5, "the integral has an upper limit, but no lower one"},
    {R"(a = \sum_{i=1} x_i + \sum_2 b)", 27, "the index is expected"},
    {R"(a = \lim x)", 10, R"(as in '\lim_{x \to 0}')"},
    {R"(a = [F]_0^1)", 5, "it is not clear which letter runs between these limits"},
    {R"(a = \begin{bmatrix} a & b \\ c \end{bmatrix})", 30, "this row has 1 entries while the first one has 2"},
    {R"(a = \begin{bmatrix} a & b)", 26, "the end of the matrix"},
    {R"(a = \begin{bmatrix} a & \end{bmatrix})", 25, "a number, a letter or a bracket is expected"},
    {R"(a = \begin{foo} a \end{foo})", 5, "the environment 'foo' cannot stand here"},
    {R"(a = b \end{foo})", 7, "'foo' ends here, but did not begin"},
    {R"(a = \begin{cases} b & c \end{cases})", 25, "a relation such as '<'"},
    {R"(\text{für } x > 0)", 1, "an equation before the condition"},
    {R"(a = |b)", 7, "'|' is expected"},
    {R"(\phi = \varphi)", 8, R"('\phi' and '\varphi' would both be called 'phi')"},
    {R"(a = x_{\frac12})", 8, R"('\frac' cannot stand in an index)"},
    {R"(a = x_{})", 7, "the index is empty"},
    {R"(a = x^)", 7, "the text ends where"},
    {R"(a = 2 3)", 7, "two numbers stand next to each other"},
    {R"(a = 10^{900} b)", 5, "the exponent of ten must lie between -400 and 400"},
    {R"(a = 5 \text{ furlong})", 7, "' furlong' is not a unit"},
    {R"(a = \min(1,2))", 5, "'min' needs two arguments"},
    {R"(\newcommand{\f}{\f} a = \f)", 25, "the macro '\\f' makes the equation too long; perhaps it calls itself"},
    {R"(\newcommand{\f}[1]{#1} a = \f)", 30, "an argument of '\\f' is expected"},
    {R"(a = \partial_t u v)", 18, "it is not clear whether 'v' is also differentiated"},
    {R"(a = \frac{\delta}{\delta f} b)", 5, "a derivative by a function is not read"},
    {R"(a = \int_{y=0}^1 x dx)", 11, "the limit belongs to 'y', but the integral runs over 'x'"},
    {R"(a = \int_0^1 f dx dy)", 5, "there are more differentials than integrals"},
    {R"(a = \max_{2} b)", 11, "the letter that varies"},
    {R"(a = \hat{x + y})", 9, R"(one letter under '\hat')"},
    {"a = b \xc3\xa9", 7, "where an operator"},
};

/// Read, but without a value: refused where an equation of the model language is made of it.
const Wrong unsaid[]{
    {R"(a = b + \dots + c)", 9, "write out the terms that the dots stand for"},
    {R"(a = \left. F \right|_0)", 5, "it is not clear which letter is '0' here; write the point as in '|_{x=0}'"},
    {R"(a = T(0))", 5, "the arguments of 'T' in 'T(0)' are not known; give them, as in functions = ['T(x)']"},
    {R"(a = T(x_0))", 5, "as in functions = ['T(x)'], or write 'T \\cdot' for a product"},
    {R"(a = T(x) + T(y))", 12, "the arguments of 'T' in 'T(y)' are not known"},
    {R"(a = T(x, 2))", 5, "the arguments of 'T' in 'T(x, 2)' are not known"},
    {R"(a = x[n+1])", 5, "the arguments of 'x' in 'x[n+1]' are not known"},
    {R"(a = h(z(t)))", 5, "the arguments of 'h' in 'h(z(t))' are not known"},
    {R"(a = E[b - c])", 5, "or write 'E \\cdot' for a product"},
    {R"(a = [b, c])", 5, "it is not clear whether '[b, c]' is a row, an interval or a commutator"},
    {R"(a = \begin{cases} b & c \in A \\ 0 & \text{else} \end{cases})", 23, "the set in 'c \\in A' is not read"},
    {R"(a = \langle b, c \rangle)", 5, "but gives it no value; write out its meaning"},
    {R"(a = (b + c)_i)", 5, "but gives it no value; write out its meaning"},
    {R"(a = \frac{D u}{D t})", 5, "but gives it no value; write out its meaning"},
    {R"(a = \int_V \rho)", 5, "but gives it no value; write out its meaning"},
    {R"(a = \int_0^1 f d^3 x)", 5, "runs over a space"},
};

/// One to three changes.
std::string mutated(std::string text, std::mt19937& engine) {
    static const std::vector<std::string> words{"{",
                                                "}",
                                                "(",
                                                ")",
                                                "[",
                                                "]",
                                                "^",
                                                "_",
                                                "\\frac",
                                                "\\left(",
                                                "\\right)",
                                                "\\left.",
                                                "\\right|",
                                                "d",
                                                "dx",
                                                "\\partial",
                                                "\\int",
                                                "\\sum_{i=1}^n",
                                                "\\begin{bmatrix}",
                                                "\\end{bmatrix}",
                                                "\\begin{cases}",
                                                "\\end{cases}",
                                                "&",
                                                "\\\\",
                                                "=",
                                                "|",
                                                "\\|",
                                                "\\text{und}",
                                                "\\text{f",
                                                "\\sin",
                                                "\\dot",
                                                "\\mathbf",
                                                "\\Delta",
                                                "\\delta",
                                                "^T",
                                                "^{-1}",
                                                "10^{99}",
                                                ",",
                                                ".",
                                                "\\quad",
                                                "$",
                                                "%",
                                                "\\",
                                                "'",
                                                "!",
                                                "\xc3",
                                                "\xc2\xb0",
                                                "\\stackrel{!}",
                                                "\\mathrm{m}",
                                                "/",
                                                "-",
                                                "\\in",
                                                "\\forall",
                                                "0",
                                                "1,5",
                                                "{{{",
                                                "}}}",
                                                "\\underbrace{",
                                                "\\sqrt[",
                                                "\n",
                                                "\\over",
                                                "\\langle",
                                                "\\rangle",
                                                "\\dots",
                                                "\\max_",
                                                "\\partial_",
                                                "{}^A",
                                                "d^3",
                                                "<",
                                                ">",
                                                "[k]",
                                                "(k+1)",
                                                "\\mathbf{1",
                                                "\\text{a b}"};
    const auto pick = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine); };
    for (std::size_t changes = 1 + pick(3); changes > 0 && !text.empty(); --changes) {
        const std::size_t at = pick(text.size());
        switch (pick(5)) {
            case 0:
                text.erase(at, 1 + pick(6));
                break;
            case 1:
                text.insert(at, words[pick(words.size())]);
                break;
            case 2:
                text[at] = static_cast<char>(32 + pick(95));
                break;
            case 3:
                text.insert(at, text.substr(pick(text.size()), 1 + pick(20)));
                break;
            default:
                std::swap(text[at], text[pick(text.size())]);
                break;
        }
    }
    return text;
}

/// Whether the text is read or refused with a place inside it.
bool ends_well(const std::string& latex) {
    try {
        const auto all = read_latex(latex_rows::text(latex), {});
        for (const LatexEquation& read : all) {
            if (read.equation.sides.size() != read.relations.size() + 1 || read.relations.empty()) return false;
            bool is_inside = true;
            for (const ExpressionPtr& side : read.equation.sides) {
                if (in_model_language(*side).empty()) return false;
                for_each(*side,
                         [&](const Expression& e) { is_inside = is_inside && e.span.begin <= e.span.end && e.span.end <= latex.size(); });
            }
            if (!is_inside) return false;
        }
        return !all.empty();
    } catch (const Failure& failure) {
        for (const Diagnostic& diagnostic : failure.diagnostics())
            if (!diagnostic.span || diagnostic.span.begin > diagnostic.span.end || diagnostic.span.end > latex.size() ||
                diagnostic.message.empty())
                return false;
        return true;
    }
}

/// That reading it fails at the place and with the sentence that are expected.
template <class Read>
void check_refused(const Wrong& wrong, Read read) {
    std::string message;
    std::size_t column = 0;
    try {
        message = read();
    } catch (const Failure& failure) {
        message = failure.diagnostics().front().message;
        column = failure.diagnostics().front().span.begin + 1;
    }
    CAPTURE(message);
    CHECK(column == wrong.column);
    CHECK(message.find(wrong.says) != std::string::npos);
}

}  // namespace

TEST_CASE("what is no equation is refused at the right place") {
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.latex);
        check_refused(wrong, [&] { return "read as " + latex_rows::in_rows(wrong.latex); });
    }
}

TEST_CASE("what has no value without more words is read, and refused behind the reader") {
    for (const Wrong& wrong : unsaid) {
        CAPTURE(wrong.latex);
        const std::vector<LatexEquation> equations = read_latex(latex_rows::text(wrong.latex), {});
        check_refused(wrong, [&]() -> std::string {
            for (const LatexEquation& read : equations)
                for (const ExpressionPtr& side : read.equation.sides) (void)in_model_words(side);
            return "taken";
        });
    }
}

TEST_CASE("long and deep texts end with a sentence") {
    const auto repeated = [](const std::string& part, int times) {
        std::string text;
        for (int i = 0; i < times; ++i) text += part;
        return text;
    };
    const auto id_of = [](const std::string& latex) {
        try {
            read_latex(latex_rows::text(latex), {});
        } catch (const Failure& failure) {
            return std::string(name_of(failure.diagnostics().front().id));
        }
        return std::string("read");
    };
    CHECK(id_of("a = " + repeated("x+", 30'000) + "x") == "too-long");
    CHECK(id_of("a = " + repeated("x+", 5'000) + "x") == "read");
    for (const char* open : {"(",
                             "{",
                             "\\left(",
                             "\\sqrt{",
                             "\\frac{1}{",
                             "-",
                             "\\sin(",
                             "\\dot{",
                             "x^{",
                             "\\underbrace{",
                             "\\int ",
                             "\\begin{matrix}",
                             "|a+",
                             "\\stackrel{!}{",
                             "\\frac{d}{dt} ",
                             "{{\\dot ",
                             "\\langle ",
                             "\\min_x ",
                             "\\partial_t ",
                             "\\int_V ",
                             "f(|",
                             "\\mathbf{a+",
                             "<",
                             "{a \\over "})
        CHECK_MESSAGE(id_of("a = " + repeated(open, 2'000) + "x") != "read", open);
}

TEST_CASE("damaged equations") {
    const std::vector<std::string> samples{
        R"(\begin{aligned} \dot{x}_1 &= x_2 \\ \dot{x}_2 &= \frac{1}{ml^2} (-ul \cos(x_1) + ml^2 x_4^2) .\end{aligned}\quad (2.223))",
        R"(\mathbf{r}_S = \frac{1}{m_1 + m_2} \left( \frac{\rho}{4} l^3 \begin{bmatrix} \frac{l}{6} \\ \frac{l}{2} \end{bmatrix} \right), \quad (2.59))",
        R"(\sum_{i=1}^N m_i \ddot{\mathbf{r}}_i^T \frac{\partial \mathbf{r}_i}{\partial q_j} = \frac{d}{dt} \frac{\partial}{\partial \dot{q}_j} T)",
        R"(\Psi(\Pi) = \begin{cases} \sqrt{\frac{\kappa}{\kappa-1}} |\Pi|^{\frac{2}{\kappa}} & \text{für } \Pi > \Pi_{\text{krit}} \\ 1 & \text{sonst} . \end{cases})",
        R"(\left. \frac{\partial s}{\partial p} \right|_T = \frac{1}{T} \left( \left. \frac{\partial h}{\partial p} \right|_T - \nu \right))",
        R"(x_2(t) = \int_{t_1}^t a_{max}(t_1 - t_0) d\tau = \underbrace{\frac{1}{2}a_{max}}_{=b}(t_1 - t_0)^2 \quad \text{und} \quad T = -8.40^\circ\text{C})",
        R"(E = \int_0^\infty \varepsilon_\lambda(\lambda, T) d\lambda = 9{,}81\,\frac{\mathrm{m}}{\mathrm{s}^2}\cdot 1.52\cdot10^{-3}\,\mathrm{N\,m^{-2}} \approx [F]_{x=0}^{1})",
        R"(\mathbf{r} = [l \sin^2(\theta), -l \cos 2\varphi \dot\varphi, \min\{a, b\}]^T \times \|\mathbf{v}\|_2, \quad j = 1, \dots, n \quad \forall x \in (0, L))"};
    for (const std::string& sample : samples) CHECK_NOTHROW(read_latex(latex_rows::text(sample), {}));
    std::mt19937 engine(2013);
    int refused = 0;
    for (int i = 0; i < 10'000; ++i) {
        const std::string latex = mutated(samples[static_cast<std::size_t>(i) % samples.size()], engine);
        INFO("mutation ", i, "\n", latex);
        REQUIRE(ends_well(latex));
        try {
            read_latex(latex_rows::text(latex), {});
        } catch (const Failure&) {
            ++refused;
        }
    }
    CHECK(refused > 1'000);
    CHECK(refused < 9'900);
}

TEST_CASE("what can be read beside an equation that cannot") {
    const auto numbers = [](const char* latex, std::vector<std::size_t>& refused) {
        std::vector<RefusedEquation> parts;
        std::vector<std::size_t> read;
        for (const LatexEquation& one : read_latex(latex_rows::text(latex), {}, parts)) read.push_back(one.number);
        for (const RefusedEquation& one : parts) refused.push_back(one.number);
        return read;
    };
    std::vector<std::size_t> refused;
    CHECK(numbers(R"(a = b \\ c = \foo d, \quad e = f \\ g = \left( h \right))", refused) == std::vector<std::size_t>{1, 3});
    CHECK(refused == std::vector<std::size_t>{2});
    refused.clear();
    CHECK(numbers(R"(\begin{align} a &= \frac{b + \foo}{2} \\ q \\ |c| &= {d} \end{align})", refused) == std::vector<std::size_t>{3});
    CHECK(refused == std::vector<std::size_t>{1, 2});
    for (const char* latex : {R"(a = b \\ x > \foo)", R"(a = b \\ \text{for } x = \foo)", R"(a = b, \quad (x = \foo))",
                              R"(a = b \\ \text{where $x > 0$})", R"(a = \foo \\ b)"}) {
        INFO(std::string(latex));
        CHECK_THROWS_AS(numbers(latex, refused), Failure);
    }
}

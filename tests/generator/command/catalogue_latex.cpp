// SPDX-License-Identifier: GPL-3.0-or-later
// What LaTeX is read as, or why it is not: brackets behind a letter, conditions, rounded numbers, letters of matrices.
#include <doctest/doctest.h>

#include "generator/command/verb.hpp"

namespace {

const std::string letters = R"toml([catalogue]
format = 1
source = "Any text"

[positive]
T = "s"
v = "m/s"

[letters]
a = "1"
b = "1"
c = "1"
x = "1"
x_0 = "1"
phi = { unit = "1", of = "t" }

[entries.one]
)toml";

struct Claim {
    const char* keys;
    const char* latex;
    const char* says;  ///< the verdict, or part of why it cannot be read
};

const Claim claims[]{
    // a time, where the letter is one of it
    {"with = { h = \"v*t\" }", R"(h(T) = v T)", "proven"},
    {"with = { h = \"v*t\" }", R"(h(t) = v t)", "proven"},
    {"with = { h = \"v*t\" }\nfunctions = [\"h\"]", R"(h(t + T) = h(t) + v T, h(-t) = -h(t), h(0) = 0)", "proven"},
    {"with = { h = \"v*t + v*T\" }", R"(h(T) = 2 v T)", "'T' may be the letter that 'h' is a function of, or where it is taken"},
    {"", R"(\varphi(T) = \varphi(t))", "not checkable"},
    // said to be a function of something
    {"with = { f = \"x^2 - a^2\" }\nfunctions = [\"f(x)\"]", R"(f(a) = 0, f(-x) = f(x), f(2\pi) = 4\pi^2 - a^2, f(x_0) = x_0^2 - a^2, f(x) = x^2 - a^2)", "proven"},
    {"with = { f = \"x - a\" }\nfunctions = [\"f(x, a)\"]", R"(f(b, c) = b - c)", "proven"},
    {"with = { f = \"x - a\" }\nfunctions = [\"f(x, a)\"]", R"(f(a, x) = a - x)", "'x' takes a value with 'a', which itself takes another one"},
    {"with = { f = \"a\" }\nfunctions = [\"f(x)\"]", R"(f(0) = f(x))", "proven"},
    {"with = { f = \"x^3\" }\nfunctions = [\"f(x)\"]", R"(f'(x) = 3 x^2, f'' = 6 x, f'(a)^2 = 9 a^4, f''(2) = 12)", "proven"},
    {"with = { h = \"v*t^2\" }\nfunctions = [\"h(t)\"]", R"(h''(T) = 2 v, h'(T) = 2 v T)", "proven"},
    {"functions = [\"b(x)\"]", R"(b(0) = b(x))", "nothing says what 'b' is at another place than 'x'"},
    // not said
    {"with = { f = \"x^2\" }", R"(f(x) = x^2)", "proven"},
    {"with = { f = \"x^2 - a^2\" }", R"(f(a) = 0)", "'a' may be the letter that 'f' is a function of, or where it is taken; say what 'f' is a function of, as in functions = ['f(x)']"},
    {"with = { f = \"x^2 - a^2\" }\nfunctions = [\"f\"]", R"(f(-x) = f(x))", "it is not clear what 'f' is a function of"},
    {"with = { f = \"x^2\" }", R"(f(a) = a^2)", "'f' does not depend on 'a'"},
    {"with = { h = \"v*t\" }", R"(h(t + T) = h(t) + v T)", "'h' stands before a letter in brackets elsewhere"},
    // factors
    {"with = { f = \"x^2\" }", R"(f(b + c) = x^2 b + x^2 c)", "proven"},
    {"", R"(a(b + c) = a b + a c)", "proven"},
};

const Claim others[]{
    // conditions behind an equation follow from what is declared, or are refused
    {"positive = { p = \"1\" }", R"(|p| = p \quad \text{for } p > 0)", "proven"},
    {"positive = { p = \"1\" }", R"(|p| = p, \quad p \ge 0)", "proven"},
    {"letters = { p = { unit = \"1\", range = [2, 3] } }", R"(|p - 1| + |p - 4| = 3 \quad \text{für } 1 < p < 4)", "numerically equal"},
    {"", R"(|a| = a \quad \text{for } a > 0)", "the condition 'a > 0' does not follow from what is declared of its letters"},
    {"", R"(|a| = a, \quad a > 0)", "the condition 'a > 0' does not follow from what is declared of its letters"},
    {"", R"(|a| = a \quad \text{where } a > 0)", "the condition"},
    {"", R"(|a| = a \quad \text{where $a > 0$})", "what stands in this text is not read"},
    {"", R"(\frac{a b}{a} = b \quad \text{for } a \neq 0)", "proven"},
    {"", R"(a + b = b \quad \text{for } a = 0)", "the condition 'a = 0' does not follow"},
    {"at = { a = 0 }", R"(a + b = b \quad \text{for } a = 0)", "proven"},
    // of cases
    {"", R"(|a| = \begin{cases} a & a > 0 \end{cases})", "a single case says nothing beyond its condition"},
    {"", R"(|a| = \begin{cases} a & a > 0 \quad \text{(right)} \\ -a & a < 0 \quad \text{(left)} \end{cases})", "proven"},
    {"", R"(|a| = \begin{cases} a & a > 0 \quad \text{whenever it slides} \\ -a & a < 0 \end{cases})", "what stands in this text is not read"},
    {"", R"(|a| = \begin{cases} a & a > 0 \lor a > 1 \land b > 0 \\ -a & \text{otherwise} \end{cases})", "it is not clear which conditions belong together"},
    {"", R"(|a| = \begin{cases} a & a > 0 \lor (a > 1 \land b > 0) \\ -a & \text{otherwise} \end{cases})", "numerically equal"},
    {"", R"(a = \begin{cases} a & a \neq 0 \\ 0 & a = 0 \end{cases})", "'a \\neq 0' holds at single points or at all but such"},
    // rounded numbers
    {"", R"(\frac{a}{\sqrt{2}} \approx 0.707 a)", "proven"},
    {"", R"(\frac{a}{\sqrt{2}} \approx 0.708 a)", "wrong"},
    {"", R"(2 a = \frac{4 a}{2} \approx 2.00 a)", "proven"},
    {"", R"(\sin a \approx a)", "'\\approx' between '\\sin a' and 'a' does not say how near they are"},
    {"", R"(\arctan\frac{1}{2} = 26.57^\circ = 0.4636\,\mathrm{rad})", "proven"},
    {"", R"(26.57^\circ = 0.4636\,\mathrm{rad})", "proven"},
    {"", R"(26.57^\circ = 0.4646\,\mathrm{rad})", "wrong"},
    {"", R"(1\,\mathrm{km} = 1400\,\mathrm{m})", "wrong"},
    {"", R"(1\tfrac12 = 1.5)", "it is not clear whether this is a sum, as in one and a half, or a product"},
    {"", R"(1{.}000 = 1)", "it is not clear whether this point stands between thousands"},
    // matrices
    {"", R"(a = \mathbf{E} + \begin{bmatrix} a & b \\ b & a \end{bmatrix})", "'E_bold' is not defined"},
    {"with = { R = \"matrix(row(cos(x), -sin(x)), row(sin(x), cos(x)))\" }\nfunctions = [\"R(x)\"]", R"(R(a) R(b) = R(a + b))", "proven"},
    {"with = { R = \"matrix(row(a, b), row(b, c))\" }", R"(R R^{-1} = \begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}, R^2 = R R, |R| = a c - b^2)", "proven"},
    {"with = { R = \"matrix(row(a, b), row(b, c))\" }", R"(R^a = R)", "'R^a' is a power of a 2 by 2 matrix; only square matrices have powers, from -9 to 9 and not 0"},
    {"with = { q = \"vector(a, b)\" }", R"(|q| = a)", "'|q|' is the magnitude of a 2 by 1 vector"},
    // letters
    {"", R"(\int_0^1 x\,dx = \left. \frac{x^2}{2} \right|_0^1)", "proven"},
    {"positive = { t = \"s\" }", R"(a = a)", "'t' is the time"},
};

void check_all(const Claim* first, const Claim* last) {
    for (; first != last; ++first) {
        CAPTURE(first->keys);
        CAPTURE(first->latex);
        const Folder folder;
        const std::string path = folder.write("text.toml", letters + first->keys + "\nlatex = '''" + first->latex + "'''\n");
        const Answer answer = ask("check", {path, "--format", "json"});
        const nlohmann::json json = answer.out.empty() ? nlohmann::json{} : answer.json();
        if (json.contains("printed") && !json["printed"].empty()) {
            CHECK(json["printed"][0]["verdict"].get<std::string>() == first->says);
            continue;
        }
        const std::string said = json.contains("errors") ? json["errors"][0]["message"].get<std::string>() : answer.err;
        CHECK(said.find(first->says) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("brackets behind a letter") { check_all(std::begin(claims), std::end(claims)); }
TEST_CASE("conditions, rounded numbers, matrices by a letter") { check_all(std::begin(others), std::end(others)); }

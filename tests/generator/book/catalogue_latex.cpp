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
    {"with = { h = \"v*t + v*T\" }", R"(h(T) = 2 v T)", "'T' may be the argument of 'h', or the place where it is evaluated"},
    {"", R"(\varphi(T) = \varphi(t))", "not checkable"},
    // said to be a function of something
    {"with = { f = \"x^2 - a^2\" }\nfunctions = [\"f(x)\"]",
     R"(f(a) = 0, f(-x) = f(x), f(2\pi) = 4\pi^2 - a^2, f(x_0) = x_0^2 - a^2, f(x) = x^2 - a^2)", "proven"},
    {"with = { f = \"x - a\" }\nfunctions = [\"f(x, a)\"]", R"(f(b, c) = b - c)", "proven"},
    {"with = { f = \"x - a\" }\nfunctions = [\"f(x, a)\"]", R"(f(a, x) = a - x)",
     "the value for 'x' contains 'a', which has another value itself"},
    {"with = { f = \"a\" }\nfunctions = [\"f(x)\"]", R"(f(0) = f(x))", "proven"},
    {"with = { f = \"x^3\" }\nfunctions = [\"f(x)\"]", R"(f'(x) = 3 x^2, f'' = 6 x, f'(a)^2 = 9 a^4, f''(2) = 12)", "proven"},
    {"with = { h = \"v*t^2\" }\nfunctions = [\"h(t)\"]", R"(h''(T) = 2 v, h'(T) = 2 v T)", "proven"},
    {"functions = [\"b(x)\"]", R"(b(0) = b(x))", "'b' has no known value at other places than 'x'"},
    // not said
    {"with = { f = \"x^2\" }", R"(f(x) = x^2)", "proven"},
    {"with = { f = \"x^2 - a^2\" }", R"(f(a) = 0)",
     "'a' may be the argument of 'f', or the place where it is evaluated; give the arguments of 'f', as in functions = ['f(x)']"},
    {"with = { f = \"x^2 - a^2\" }\nfunctions = [\"f\"]", R"(f(-x) = f(x))", "the arguments of 'f' are not clear"},
    {"with = { f = \"x^2\" }", R"(f(a) = a^2)", "'f' does not depend on 'a'"},
    {"with = { h = \"v*t\" }", R"(h(t + T) = h(t) + v T)", "proven"},
    // said elsewhere in the text
    {"with = { f = \"x^2\" }", R"(f(x) = x^2, f(2) = 4, f(x_0) = x_0^2, f(x + 1) = x^2 + 2 x + 1)", "proven"},
    {"with = { f = \"x^2\" }", R"(f(x) = x^2, f(x + 1) = x^2 + x + 1)", "wrong"},
    {"", R"(b(x) = b, b(0) = b)", "'b' has no known value at other places than 'x'"},
    // factors
    {"with = { f = \"x^2\" }", R"(f(b + c) = x^2 b + x^2 c)", "proven"},
    {"", R"(a(b + c) = a b + a c)", "proven"},
};

const Claim others[]{
    // conditions behind an equation follow from what is declared, or are refused
    {"positive = { p = \"1\" }", R"(|p| = p \quad \text{for } p > 0)", "proven"},
    {"positive = { p = \"1\" }", R"(|p| = p, \quad p \ge 0)", "proven"},
    {"letters = { p = { unit = \"1\", range = [2, 3] } }", R"(|p - 1| + |p - 4| = 3 \quad \text{für } 1 < p < 4)", "numerically equal"},
    {"", R"(|a| = a \quad \text{for } a > 0)", "the condition 'a > 0' does not follow from the declarations of its letters"},
    {"", R"(|a| = a, \quad a > 0)", "the condition 'a > 0' does not follow from the declarations of its letters"},
    {"", R"(|a| = a \quad \text{where } a > 0)", "the condition"},
    {"", R"(|a| = a \quad \text{where $a > 0$})", "this text cannot be read"},
    {"", R"(\frac{a b}{a} = b \quad \text{for } a \neq 0)", "proven"},
    {"", R"(a + b = b \quad \text{for } a = 0)", "the condition 'a = 0' does not follow"},
    {"at = { a = 0 }", R"(a + b = b \quad \text{for } a = 0)", "proven"},
    // of cases
    {"", R"(|a| = \begin{cases} a & a > 0 \end{cases})", "a single case has no value where its condition does not hold"},
    {"", R"(|a| = \begin{cases} a & a > 0 \quad \text{(right)} \\ -a & a < 0 \quad \text{(left)} \end{cases})", "proven"},
    {"", R"(|a| = \begin{cases} a & a > 0 \quad \text{whenever it slides} \\ -a & a < 0 \end{cases})", "this text cannot be read"},
    {"", R"(|a| = \begin{cases} a & a > 0 \lor a > 1 \land b > 0 \\ -a & \text{otherwise} \end{cases})",
     "it is not clear which conditions belong together"},
    {"", R"(|a| = \begin{cases} a & a > 0 \lor (a > 1 \land b > 0) \\ -a & \text{otherwise} \end{cases})", "numerically equal"},
    {"", R"(a = \begin{cases} a & a \neq 0 \\ 0 & a = 0 \end{cases})", "'a \\neq 0' holds only at single points, or everywhere else"},
    // rounded numbers
    {"", R"(\frac{a}{\sqrt{2}} \approx 0.707 a)", "proven"},
    {"", R"(\frac{a}{\sqrt{2}} \approx 0.708 a)", "wrong"},
    {"", R"(2 a = \frac{4 a}{2} \approx 2.00 a)", "proven"},
    {"", R"(\sin a \approx a)", "'\\approx' between '\\sin a' and 'a' does not say how near they are"},
    {"", R"(\arctan\frac{1}{2} = 26.57^\circ = 0.4636\,\mathrm{rad})", "proven"},
    {"", R"(26.57^\circ = 0.4636\,\mathrm{rad})", "proven"},
    {"", R"(26.57^\circ = 0.4646\,\mathrm{rad})", "wrong"},
    {"", R"(1\,\mathrm{km} = 1400\,\mathrm{m})", "wrong"},
    {"", R"(\pi/3 = 1.0472)", "proven"},
    {"", R"(\pi/3 = 1.0473)", "wrong"},
    {"", R"(\pi = 3)", "wrong"},
    {"", R"(a = 0.5)", "wrong"},
    {"", R"(1\tfrac12 = 1.5)", "it is not clear whether this is a sum, as in one and a half, or a product"},
    {"", R"(1{.}000 = 1)", "it is not clear whether this '.' stands between thousands"},
    // matrices
    {"", R"(a = \mathbf{E} + \begin{bmatrix} a & b \\ b & a \end{bmatrix})", "'E_bold' is not defined"},
    {"with = { R = \"matrix(row(cos(x), -sin(x)), row(sin(x), cos(x)))\" }\nfunctions = [\"R(x)\"]", R"(R(a) R(b) = R(a + b))", "proven"},
    {"with = { R = \"matrix(row(a, b), row(b, c))\" }",
     R"(R R^{-1} = \begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}, R^2 = R R, |R| = a c - b^2)", "proven"},
    {"with = { R = \"matrix(row(a, b), row(b, c))\" }", R"(R^a = R)",
     "'R^a' is a power of a 2 by 2 matrix; only square matrices have powers, from -9 to 9 and not 0"},
    {"with = { q = \"vector(a, b)\" }", R"(|q| = a)", "'|q|' is the magnitude of a 2 by 1 vector"},
    // letters
    {"", R"(\int_0^1 x\,dx = \left. \frac{x^2}{2} \right|_0^1)", "proven"},
    {"positive = { t = \"s\" }", R"(a = a)", "'t' is always the time"},
};

/// What is read of other people's texts, and a slip in each.
const Claim readings[]{
    {"", R"(\begin{align} (a+b)^2 &= a^2 + 2 a b + b^2 & (a-b)^2 &= a^2 - 2 a b + b^2 \end{align})", "proven"},
    {"", R"(\begin{align} (a+b)^2 &= a^2 + 2 a b + b^2 & (a-b)^2 &= a^2 - 2 a b - b^2 \end{align})", "wrong"},
    {"", R"(\begin{align} a &= a & -b &= b - 2 b \end{align})", "proven"},
    {"", R"(\begin{eqnarray} a &=& a \\ b &=& 2 b \end{eqnarray})", "wrong"},
    // both signs
    {"", R"(\cos(a \pm b) = \cos a \cos b \mp \sin a \sin b)", "proven"},
    {"", R"(\cos(a \pm b) = \cos a \cos b \pm \sin a \sin b)", "wrong"},
    {"", R"(a = \pm b)", "'\\pm' stands on one side of 'a = \\pm b' only"},
    {"positive = { p = \"1\", q = \"1\" }\nsolves = [\"a^2 + 2*p*a - q = 0\"]", R"(a = -p \pm \sqrt{p^2 + q})", "proven"},
    {"positive = { p = \"1\", q = \"1\" }\nsolves = [\"a^2 + 2*p*a - q = 0\"]", R"(a = -p \pm \sqrt{p^2 - q})", "wrong"},
    // integrals without limits
    {"", R"(\int x^2 \, dx = \frac{x^3}{3} + c)", "proven"},
    {"", R"(\int x^2 \, dx = \frac{x^3}{2} + c)", "wrong"},
    {"", R"(2 \int x \, dx - b x = x^2 - b x + \text{const.})", "proven"},
    {"", R"(a = \int x^2 \, dx)", "the program does not know how 'a' depends on 'x'"},
    {"", R"(x \int x \, dx = \frac{x^3}{2})", "so its constant matters"},
    // sums without limits, \nabla
    {"letters = { s = { unit = \"1\", for = \"i = 1..3\" } }", R"(\sum_i s_i = \sum_{i=1}^3 s_i)", "proven"},
    {"letters = { s = { unit = \"1\", for = \"i = 1..3\" } }", R"(\sum_i s_i = \sum_{i=1}^2 s_i)", "wrong"},
    {"letters = { s = { unit = \"1\", for = \"i = 1..3\" } }", R"(\sum_{j \ne i} s_j = a)", "the members of the sum"},
    {"", R"(\sum a = a)", "write its index and limits"},
    {"", R"(\nabla a = 0)", "the coordinates of '\\nabla' in '\\nabla a' are not known"},
    // words and marks
    {"", R"(\newcommand{\sq}[1]{#1^2} \sq{a} + \sq b = a a + b^2)", "proven"},
    {"with = { W = \"x^2\" }", R"(\dv{W}{x} = 2 x \therefore \boxed{\dv[2]{W}{x} = 2})", "proven"},
    {"with = { W = \"x^2*a^3\" }", R"(\pdv{W}{x}{a} = 6 x a^2)", "proven"},
    {"", R"(\frac{x^3}{3!} = \frac{x^3}{6})", "proven"},
    {"", R"(a! = a)", "has a value only for a whole number"},
    {"", R"(\frac{\cancel{a} b}{\cancel{a} c} = \frac{b}{c})", "proven"},
    {"letters = { u_bar = \"1\", PE_1 = \"1\" }", R"({\it a} + \bar{u} + PE_1 = PE_1 + a + \bar u)", "proven"},
    {"letters = { u_prime_v_prime_over = \"1\" }", R"(\overline{u'v'} + a = a + \overline{u' v'})", "proven"},
    {"letters = { A_v_vec_B = \"1\" }", R"({}^A\vec{v}^B + a{} = a + {}^A\vec{v}^B)", "proven"},
    {"", R"(\overline{a + b} = a + b)", "but gives it no value; write out its meaning"},
    {"", R"(a \propto b)", "a comparison by '\\propto' is not checked"},
    // without units
    {"dimensionless = true\nletters = { m = \"kg\", u = \"m\" }", R"(m + u = u + m)", "proven"},
    {"letters = { m = \"kg\", u = \"m\" }", R"(m + u = u + m)", "dimensionally wrong"},
};

void check_all(const Claim* first, const Claim* last) {
    for (; first != last; ++first) {
        CAPTURE(first->keys);
        CAPTURE(first->latex);
        const Folder folder;
        const std::string path = folder.write("text.toml", letters + first->keys + "\nlatex = '''" + first->latex + "'''\n");
        const Answer answer = ask("check", {path, "--format", "json"});
        const nlohmann::json json = answer.out.empty() ? nlohmann::json{} : answer.json();
        if (json.contains("printed") && !json["printed"].empty() && !json.contains("errors")) {  // or else a part is not read
            CHECK(json["printed"][0]["verdict"].get<std::string>() == first->says);
            continue;
        }
        const std::string said = json.contains("errors") ? json["errors"][0]["message"].get<std::string>() : answer.err;
        CHECK(said.find(first->says) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("what other texts have") { check_all(std::begin(readings), std::end(readings)); }
TEST_CASE("brackets behind a letter") { check_all(std::begin(claims), std::end(claims)); }
TEST_CASE("conditions, rounded numbers, matrices by a letter") { check_all(std::begin(others), std::end(others)); }

TEST_CASE("what a text says of itself") {
    const std::string text = R"toml([catalogue]
format = 1
source = "Any text"
decimal = "."
dimensionless = true
coordinates = ["x", "y"]
preamble = '''
\documentclass{book}
\newcommand{\half}{\frac12}
\def\pd#1#2{\frac{\partial #1}{\partial #2}}
\newcommand{\broken}{
'''
[macros]
'\v' = '\mathbf{#1}'
[letters]
a = "kg"
x = "m"
y = "s"
[entries."numbers"]
latex = '''42,164 = 42164, 42,164.2 = 42164.23, x + \half a = a/2 + x'''
[entries."rounded"]
latex = '''42164.4 = 42,164.2'''
[entries."fields"]
with = { W = "x^2 + y^2", w = "vector(x^2, x*y)" }
latex = '''\nabla^2 W = 4, \pd{W}{x} = 2 x, \nabla \cdot w = 3 x, \nabla W = \begin{pmatrix} 2 x \\ 2 y \end{pmatrix}'''
[entries."fields wrong"]
with = { W = "x^2 + y^2" }
latex = '''\vec{\nabla}^2 W = 2'''
[entries."vector"]
with = { v_bold = "vector(x, y)" }
latex = '''\v{v} = \begin{pmatrix} x \\ y \end{pmatrix}'''
)toml";
    const Folder folder;
    const nlohmann::json json = ask("check", {folder.write("text.toml", text), "--format", "json"}).json();
    const std::vector<std::string> expected{"proven", "wrong", "proven", "wrong", "proven"};
    CHECK_FALSE(json.contains("errors"));
    REQUIRE(json["printed"].size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(json["printed"][i]["verdict"].get<std::string>() == expected[i]);
    }
}

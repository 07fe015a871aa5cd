// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in brackets behind a letter: what it is a function of, where it is taken, or a factor.
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

}  // namespace

TEST_CASE("brackets behind a letter") {
    for (const Claim& claim : claims) {
        CAPTURE(claim.keys);
        CAPTURE(claim.latex);
        const Folder folder;
        const Answer answer = ask("check", {folder.write("text.toml", letters + claim.keys + "\nlatex = '''" + claim.latex + "'''\n"), "--format", "json"});
        const nlohmann::json json = answer.json();
        const std::string said = json["printed"].empty() ? json["errors"][0]["message"].get<std::string>() : json["printed"][0]["verdict"].get<std::string>();
        CHECK(said.find(claim.says) == 0);
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of an entry that is wrong: where it differs, numbers that show it, and what was probably meant.
#include <doctest/doctest.h>

#include "generator/command/verb.hpp"

namespace {

nlohmann::json wrong(const std::string& entry) {
    const Folder folder;
    const std::string head = "[catalogue]\nformat = 1\nsource = \"Any text\"\n[letters]\nphi = { unit = \"rad\", of = \"t\" }\nu = \"1\"\nv = \"1\"\nw = \"1\"\n[entries.one]\n";
    const Answer answer = ask("check", {folder.write("text.toml", head + entry + "\n"), "--format", "json"});
    CAPTURE(answer.err);
    REQUIRE(answer.code == 1);
    return answer.json()["printed"][0];
}

nlohmann::json wrong_latex(const std::string& latex) { return wrong("latex = '''" + latex + "'''"); }

}  // namespace

TEST_CASE("cases differ piece by piece") {
    const std::string turned = R"(|u| = \begin{cases} u & u < 0 \\ -u & u \ge 0 \end{cases})", twice = R"(|u| = \begin{cases} u & u > 0 \\ 2 u & u \le 0 \end{cases})";
    const std::string three = R"(\min\{\max\{u, -1\}, 1\} = \begin{cases} -1 & u < -1 \\ 2 & u > 1 \\ u & \text{sonst} \end{cases})";
    const auto swapped = wrong_latex(turned);
    CHECK(swapped["difference"] == "2*u where u > 0; -2*u where u < 0");
    CHECK(swapped["suggestion"].get<std::string>().find("sign") == std::string::npos);
    CHECK(wrong_latex(twice)["difference"].get<std::string>().find("-3*u where u < 0; 0 elsewhere") == 0);
    CHECK(wrong_latex(three)["difference"].get<std::string>().find(" where u > 1; 0 elsewhere") != std::string::npos);
    // Between 1 and 2 no case holds: there is no value to differ.
    const std::string gap = R"(u = \begin{cases} 2 & u > 2 \\ u & u < 1 \end{cases})";
    CHECK(wrong_latex(gap)["difference"].get<std::string>()== "-(2 - u) where u > 2; 0 elsewhere");
    const std::string slip = R"(|u - v| = \begin{cases} u - v & \text{if } u < v \\ v - u & \text{otherwise} \end{cases})";
    CHECK(wrong_latex(slip)["suggestion"] != "");
}

TEST_CASE("of matrices the entry is named, and a slip in it is found") {
    const auto sign = wrong("equation = \"matrix(row(cos(u), -sin(u)), row(sin(u), cos(u)))*matrix(row(cos(v), -sin(v)), row(sin(v), cos(v))) = matrix(row(cos(u + v), sin(u + v)), row(sin(u + v), cos(u + v)))\"");
    CHECK(sign["reason"] == "the entries in row 1, column 2 differ");
    CHECK(sign["suggestion"].get<std::string>().find("row(cos(u + v), -sin(u + v))") != std::string::npos);
    CHECK(wrong("equation = \"2*vector(u, v) = vector(2*u, v)\"")["reason"] == "the entries in row 2 differ");
}

TEST_CASE("no dot is put on what does not move") {
    for (const char* entry : {"equation = \"u + v = u\"", "with = { x = \"2*u\" }\nequation = \"u + x = u\""}) CHECK(wrong(entry)["slip"].get<std::string>().find("dot") == std::string::npos);
}

TEST_CASE("an example has every letter of both sides, and as many digits as show the difference") {
    const auto both = wrong("equation = \"(u + v)*w = u*w - v*w\"")["counterexample"];
    CHECK(both["values"].size() == 3);
    const auto close = wrong("equation = \"u = u + 10^(-12)\"")["counterexample"];
    CHECK(close["left"] != close["right"]);
    CHECK(close["values"].contains("u"));
}

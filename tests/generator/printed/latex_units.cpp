// SPDX-License-Identifier: GPL-3.0-or-later
// Units in LaTeX: those that are read, those that are refused with what to write instead, and functions by logarithms.
#include <doctest/doctest.h>

#include "generator/command/verb.hpp"

namespace {

Answer checked(const std::string& latex) {
    const Folder folder;
    const std::string letters = "[catalogue]\nformat = 1\nsource = \"Any text\"\n[positive]\nm = { unit = \"kg\", value = 1 }\nh = { unit = \"m\", value = 2 }\ng = { unit = \"m/s^2\", value = 9.81 }\n[letters]\nu = { unit = \"1\", range = [-0.9, 0.9] }\n[entries.one]\n";
    return ask("check", {folder.write("text.toml", letters + "latex = '''" + latex + "'''\n")});
}

}  // namespace

TEST_CASE("units that are read") {
    for (const char* latex : {R"(h = 2\cdot 10^6\,\mu\mathrm{m})", R"(h = 2\cdot 10^6\,\mathrm{\mu m})", R"(m g h = 19.62\ [\mathrm{N m}])", R"(m g h = 19.62\left[\mathrm{N}\,\mathrm{m}\right])", R"(\sqrt{g/h} = 2.21\,\mathrm{\frac{rad}{s}})",
                              R"(g = 9.81\,\mathrm{\frac{m}{s^2}})"}) {
        INFO(latex);
        const Answer answer = checked(latex);
        CAPTURE(answer.out);
        CHECK(answer.code == 0);
    }
}

TEST_CASE("units that are refused") {
    for (const auto& [latex, words] : {std::pair(R"(2 m g = 3 m g\ \mathrm{N})", "looks like a unit behind an expression"), std::pair(R"(h = (1 + 1)\,\mathrm{m})", "looks like a unit behind an expression"),
                                       std::pair(R"(h = \SI{2}{\metre})", "write the number with its unit behind it"), std::pair(R"(h = \qty{2}{\metre})", "write the number with its unit behind it")}) {
        INFO(latex);
        const Answer answer = checked(latex);
        CHECK(answer.code == 2);
        CHECK(answer.err.find(words) != std::string::npos);
    }
}

TEST_CASE("inverse hyperbolic functions") {
    for (const char* latex : {R"(\operatorname{artanh}(u) = \frac{1}{2} \ln\frac{1+u}{1-u})", R"(\sinh(\operatorname{arsinh} u) = u)", R"(\operatorname{arsinh}(u) = \ln(u + \sqrt{u^2+1}))", R"(\tanh(\operatorname{arctanh} u) = u)"}) {
        INFO(latex);
        const Answer answer = checked(latex);
        CAPTURE(answer.out);
        CHECK(answer.code == 0);
    }
}

TEST_CASE("a letter that is not known is named, not what is done with it") {
    const Answer answer = checked(R"(\mathbf{R}^T \mathbf{R} = 1)");
    CHECK(answer.err.find("'R_bold' is not defined") != std::string::npos);
    CHECK(answer.err.find("no function") == std::string::npos);
}

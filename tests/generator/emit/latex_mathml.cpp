// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/latex_mathml.hpp"

#include <doctest/doctest.h>

#include <regex>

using namespace dalembert;

namespace {

/// Without attributes, groups and spaces.
std::string shown(const std::string& latex, const LatexMacros& macros = {}) {
    const std::string text = mathml_of_latex(latex, macros);
    const std::string plain = std::regex_replace(text, std::regex("<mspace[^>]*></mspace>|</?mrow>"), "");
    return std::regex_replace(plain, std::regex("<(\\w+) [^>]*>"), "<$1>");
}

}  // namespace

TEST_CASE("LaTeX is shown as it is printed") {
    CHECK(shown("L = T - V") == "<mi>L</mi><mo>=</mo><mi>T</mi><mo>−</mo><mi>V</mi>");
    CHECK(shown("\\frac12 m_{1} \\dot x^2") ==
          "<mfrac><mn>1</mn><mn>2</mn></mfrac><msub><mi>m</mi><mn>1</mn></msub><msup><mover><mi>x</mi><mo>˙</mo></mover><mn>2</mn></msup>");
    CHECK(shown("\\sin^2\\varphi") == "<msup><mi>sin</mi><mn>2</mn></msup><mo>&#8289;</mo><mi>φ</mi>");
    CHECK(shown("\\left( a \\right)") == "<mo>(</mo><mi>a</mi><mo>)</mo>");
    CHECK(shown("\\int_0^1 x\\,\\mathrm dx") == "<msubsup><mo>∫</mo><mn>0</mn><mn>1</mn></msubsup><mi>x</mi><mi>d</mi><mi>x</mi>");
    CHECK(shown("\\sqrt[3]{x'}") == "<mroot><msup><mi>x</mi><mo>′</mo></msup><mn>3</mn></mroot>");
    CHECK(shown("T &= 1 \\\\") == "<mi>T</mi><mo>=</mo><mn>1</mn>");
}

TEST_CASE("rows of a matrix stay rows, and bold letters bold") {
    CHECK(shown("\\begin{pmatrix} a & b \\\\ c & d \\end{pmatrix}") ==
          "<mo>(</mo><mtable><mtr><mtd><mi>a</mi></mtd><mtd><mi>b</mi></mtd></mtr>"
          "<mtr><mtd><mi>c</mi></mtd><mtd><mi>d</mi></mtd></mtr></mtable><mo>)</mo>");
    CHECK(mathml_of_latex("\\mathbf r_S", {}).find("font-weight:bold\">r</mi>") != std::string::npos);
    CHECK(mathml_of_latex("\\mathbf r_S", {}).find("font-weight:bold\">S</mi>") == std::string::npos);
}

TEST_CASE("macros are written out; what is not known is not shown") {
    LatexMacros macros;
    macros["half"] = {0, {}, "\\frac{1}{2}"};
    CHECK(shown("\\half m", macros) == "<mfrac><mn>1</mn><mn>2</mn></mfrac><mi>m</mi>");
    for (const char* latex : {"\\unknown x", "\\frac{1}", "\\left( a", "a }", "\\begin{aligned} a \\end{aligned}", "\\begin{pmatrix} a"})
        CHECK(mathml_of_latex(latex, {}).empty());
}

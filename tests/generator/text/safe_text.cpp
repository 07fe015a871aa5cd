// SPDX-License-Identifier: GPL-3.0-or-later
// Text from a model cannot break out of a comment, a string, a file name or a plot script.
#include "cpp/print.hpp"
#include "program/statement_maker.hpp"
#include "graph/notation.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"
#include "generator/machine.hpp"

using namespace dalembert;

TEST_CASE("strings and comments of C++") {
    CHECK(cpp_string("a\"b\\c?\?/d\n") == "\"a\\\"b\\\\c\\?\\?/d\"");
    CHECK(safe_line("ends in a backslash \\\\ \\") == "ends in a backslash");
    CHECK(safe_line("a\nb\rc\0d") == "a b c");
    CHECK(safe_line("left\xE2\x80\xAEright") == "left?right");
    CHECK(cpp_comment("x\n*/ int evil; //", 0) == "/// x */ int evil; //\n");
}

TEST_CASE("hostile text in a model stays text in the header") {
    const std::string evil = "\\\"; } int evil() { return 1; } // \\\\\\n #include </etc/passwd> */ ?\?/ @BANNER@ %s {} \\u202e";
    Machine machine = machine_from("title = \"" + evil + "\"\nsource = \"" + evil + "\"\n" +
                                   "[parameters]\nm = { value = 1, unit = \"kg\", doc = \"" + evil + "\" }\n[coordinates]\nx = { unit = \"m\", doc = \"" + evil +
                                   "\" }\n[bodies.b]\nmass = \"m\"\nposition = [\"x\", 0, 0]\n");
    const std::string text = generate(machine).text;
    // Every occurrence stands in a comment or in a string.
    for (std::size_t at = text.find("int evil"); at != std::string::npos; at = text.find("int evil", at + 1)) {
        const std::size_t begin = text.rfind('\n', at) + 1;
        const std::string line = text.substr(begin, text.find('\n', at) - begin);
        CAPTURE(line);
        const std::size_t comment = line.find("//");
        const bool in_comment = comment != std::string::npos && comment < at - begin;
        int quotes = 0;
        for (std::size_t i = 0; i < at - begin; ++i)
            if (line[i] == '"' && (i == 0 || line[i - 1] != '\\')) ++quotes;
        CHECK((in_comment || quotes % 2 == 1));
        CHECK(line.back() != '\\');
    }
    CHECK(text.find("\xE2\x80\xAE") == std::string::npos);
}

TEST_CASE("constants are exact in every scalar type") {
    CHECK(cpp_text(Value::constant(3)) == "Scalar(3)");
    CHECK(cpp_text(Value::constant(Rational(-981) / 100)) == "-Scalar(981) / Scalar(100)");
    CHECK(cpp_text(Value::constant(Rational(cln::cl_I("5972000000000000000000000")))) ==
          "((Scalar(5972000) * Scalar(1000000000)) * Scalar(1000000000))");
    CHECK(cpp_text(Value::constant(Rational(1000000001))) == "(Scalar(1) * Scalar(1000000000) + Scalar(1))");
}

TEST_CASE("templates name what is missing") {
    CHECK(fill_template("a @X@ b", {{"X", "1"}}) == "a 1 b");
    CHECK_THROWS(fill_template("a @X@ b", {}));
    CHECK_THROWS(fill_template("a b", {{"X", "1"}}));
    CHECK_THROWS(fill_template("a @X", {{"X", "1"}}));
}

TEST_CASE("names as LaTeX") {
    CHECK(latex_name("phi_1") == "\\varphi_{\\mathrm{1}}");
    CHECK(latex_name("m") == "m");
    CHECK(latex_name("theta") == "\\theta");
    CHECK(latex_name("height") == "\\mathrm{height}");
    CHECK(latex_name("c_W_max") == "c_{\\mathrm{W,max}}");
}

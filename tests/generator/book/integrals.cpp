// SPDX-License-Identifier: GPL-3.0-or-later
// Entries with integrals and limits: what is proven, what quadrature says, and what has no value.
#include <doctest/doctest.h>

#include "generator/command/verb.hpp"

namespace {

const std::string text_of_letters =
    "[catalogue]\nformat = 1\nsource = \"Any text\"\n[positive]\np = \"1\"\nn = \"1\"\n[letters]\nu = \"1\"\nx = \"1\"\n[entries.one]\n";

nlohmann::json checked(const std::string& latex) {
    const Folder folder;
    const Answer answer = ask("check", {folder.write("text.toml", text_of_letters + "latex = '''" + latex + "'''\n"), "--format", "json"});
    CAPTURE(answer.err);
    REQUIRE(answer.code <= 1);
    return answer.json()["printed"][0];
}

void all_are(const char* verdict, std::initializer_list<const char*> equations) {
    for (const char* latex : equations) {
        INFO(latex);
        CHECK(checked(latex)["verdict"] == verdict);
    }
}

}  // namespace

TEST_CASE("integrals with a primitive are proven") {
    all_are("proven", {R"(\int_0^1 \frac{1}{1+x^2} dx = \frac{\pi}{4})", R"(\int_{-\infty}^{\infty} \frac{1}{1+x^2} dx = \pi)",
                       R"(\int_0^{2\pi} \frac{1}{2+\cos x} dx = \frac{2\pi}{\sqrt 3})",
                       R"(\int_0^{p} e^{-x} \sin(x) dx = \frac{1}{2}(1 - e^{-p}(\sin p + \cos p)))",
                       R"(\int_{-1}^{2} |x| \cos x\, dx = 2\sin 2 + \cos 2 + \sin 1 + \cos 1 - 2)",
                       R"(\int_0^1 \frac{1}{\sqrt{1-y^2}} dy = \frac{\pi}{2})", R"(\int_0^{\pi/4} \frac{1}{\cos^2 x} dx = 1)",
                       R"(\int_2^{3} \frac{x}{(x-1)(x+2)} dx = \frac13 \ln 2 + \frac23 \ln\frac54)",
                       R"(\int_0^{2} \begin{cases} x & x < 1 \\ 1 & x \ge 1 \end{cases} dx = \frac32)"});
}

TEST_CASE("what quadrature alone says is not proven") {
    all_are("numerically equal", {R"(\int_0^1 e^{-x^2} dx \approx 0.74682)", R"(\int_0^p e^{-x^2} dx = \int_{-p}^0 e^{-x^2} dx)",
                                  R"(\int_{0}^{\pi} |\cos x| dx = 2)", R"(\int_0^{\infty} e^{-x^2} dx = \frac{\sqrt{\pi}}{2})"});
    all_are("wrong", {R"(\int_0^1 e^{-x^2} dx \approx 0.74683)", R"(\int_0^p e^{-x^2} dx = \int_{0}^p e^{x^2} dx)",
                      R"(\int_0^{\pi} \sin(\sin x) dx = 1.7866)"});
    CHECK(checked(R"(\int_0^p e^{-x^2} dx = \int_{0}^p e^{x^2} dx)")["counterexample"]["values"].contains("p"));
    CHECK(checked(R"(\int_0^p e^{-x^2} dx = 2 \int_0^p e^{-x^2} dx - \int_0^p e^{-x^2} dx)")["verdict"] == "proven");  // whatever it is
}

TEST_CASE("poles between the limits, and derivatives of what is not found") {
    all_are(
        "not checkable",
        {R"(\int_{-1}^{1} \frac{1}{x} dx = 0)", R"(\int_{-1}^{2} \frac{1}{\sin x} dx = 0)", R"(\int_0^{2} \frac{1}{x^2 - 1} dx = 1)",
         R"(\int_{-1}^{2} \frac{1}{\sin x} dx = \int_{-1}^{2} \frac{1}{\sin x} dx)", R"(\frac{d}{dp} \int_0^p e^{-x^2} dx = e^{-p^2})"});
}

TEST_CASE("limits from one side, and Euler's number") {
    all_are("proven",
            {R"(\lim_{x \to 0^+} \frac{|x|}{x} = 1)", R"(\lim_{x \to 0-} \frac{|x|}{x} = -1)", R"(\lim_{x \to 0^{-}} \frac{|x|}{x} = -1)",
             R"(\lim_{x \downarrow 0} \frac{|x|}{x} = 1)", R"(\lim_{n \to \infty} \left(1 + \frac{1}{n}\right)^n = e)",
             R"(\lim_{n \to \infty} \left(1 + \frac{u}{n}\right)^n = e^u)"});
    all_are("not checkable", {R"(\lim_{x \to 0^+} \frac{1}{x} = 1)", R"(\lim_{x \to 0} \frac{|x|}{x} = 1)"});
    CHECK(checked(R"(\lim_{x \to 0} \frac{|x|}{x} = 1)")["reason"].get<std::string>().find("give the side") != std::string::npos);
}

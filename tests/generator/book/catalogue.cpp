// SPDX-License-Identifier: GPL-3.0-or-later
// Catalogues: verdicts of every kind of entry, what mends the wrong ones, and what the pages show.
#include <doctest/doctest.h>

#include "generator/command/verb.hpp"

namespace {

const std::string head = R"toml([catalogue]
format = 1
source = "Any text"

[positive]
m = "kg"
l = "m"
a = "1/s"
s = "s"
R = "J/(kg*K)"
T = "K"
rho = "kg/m^3"
h = { unit = "m", value = 2 }
g = { unit = "m/s^2", value = 9.81 }

[letters]
phi = { unit = "rad", of = "t" }
x_0 = "m"
u = "1"
v = "1"
w = "1"

)toml";

/// The rows by id.
std::map<std::string, nlohmann::json> verdicts(const std::string& entries, int code = 0) {
    const Folder folder;
    const Answer answer = ask("check", {folder.write("text.toml", head + entries), "--format", "json"});
    CAPTURE(answer.err);
    CHECK(answer.code == code);
    std::map<std::string, nlohmann::json> rows;
    const nlohmann::json json = answer.json();
    for (const auto& row : json["printed"]) rows[row["id"]] = row;
    return rows;
}

nlohmann::json row(const std::string& entry, int code = 0) { return verdicts("[entries.one]\n" + entry, code).at("one"); }
std::string verdict(const std::string& entry, int code = 0) { return row(entry, code)["verdict"]; }

/// What a wrong equation is said to have been meant to be.
std::string mended(const std::string& equation) { return row("equation = \"" + equation + "\"", 1)["suggestion"]; }

std::string model(const char* name) {
    return "model = \"" + (std::filesystem::path(SOURCE_DIR) / "systems" / "mechanics" / name).string() + ".toml\"\n";
}

}  // namespace

TEST_CASE("identities on letters") {
    CHECK(verdict("equation = \"sin(u + v) = sin(u)*cos(v) + cos(u)*sin(v)\"") == "proven");
    CHECK(verdict("equation = \"sqrt(m^2) = m\"") == "proven");    // it is positive
    CHECK(verdict("equation = \"sqrt(u^2) = u\"", 1) == "wrong");  // this one is not
    CHECK(verdict("with = { p = \"rho*R*T\" }\nequation = \"diff(p, T)/p = 1/T\"") == "proven");
    CHECK(verdict("with = { x = \"l*sin(phi)\", y = \"-l*cos(phi)\" }\nequation = \"m/2*(dot(x)^2 + dot(y)^2) = m*l^2*dot(phi)^2/2\"") ==
          "proven");
    CHECK(verdict("equation = \"ddot(phi) = dot(phi)*a\"", 1) == "wrong");  // nothing says how it moves
    CHECK(verdict("equation = \"m = l\"", 1) == "dimensionally wrong");
    CHECK(verdict("letters = { b = { unit = \"1\", for = \"k = 1..3\" } }\nequation = \"sum(k, 1, 3, b[k]) = b[1] + b[2] + b[3]\"") ==
          "proven");
}

TEST_CASE("integrals, limits, and places") {
    CHECK(verdict("equation = \"integral(r^2, r, 0, l) = l^3/3\"") == "proven");
    CHECK(verdict("equation = \"integral(exp(-a*s), s, 0, infinity) = 1/a\"") == "proven");
    CHECK(verdict("equation = \"limit(sin(u)/u, u, 0) = 1\"") == "proven");
    CHECK(verdict("equation = \"limit((u^2 - 1)/(u - 1), u, 1) = 2\"") == "proven");
    CHECK(verdict("equation = \"limit((1 - exp(-a*t))/a, a, 0) = t\"") == "proven");
    CHECK(verdict("equation = \"limit(u/(1 + u), u, infinity) = 1\"") == "proven");
    CHECK(verdict("equation = \"limit(1/u, u, 0) = 1\"") == "not checkable");
    CHECK(verdict("equation = \"at(u^2 + v, u, 3) = 9 + v\"") == "proven");
}

TEST_CASE("what has no value is not proven to have one") {
    for (const char* equation : {"integral(1/x^2, x, -1, 1) = -2", "integral(1/(x - 1)^2, x, 0, 2) = -2", "integral(1/x, x, -1, 1) = 0",
                                 "integral(1/x, x, 0, 1) = 1", "limit(abs(u)/u, u, 0) = 1", "limit(sqrt(u^2)/u, u, 0) = 1",
                                 "limit(sign(u), u, 0) = 0", "dot(u) = 0", "at(phi, t, 0) = phi", "integral(phi, t, 0, s) = phi*s"}) {
        INFO(equation);
        const std::string entry = "equation = \"" + std::string(equation) + "\"";
        CHECK(verdict(entry) == "not checkable");
    }
    CHECK(verdict("equation = \"integral(1/x^2, x, 1, 2) = 1/2\"") == "proven");
    CHECK(verdict("equation = \"limit(sqrt(u^2), u, 0) = 0\"") == "proven");
    CHECK(verdict("positive = { p = \"1\" }\nequation = \"limit(p/sqrt(p), p, 0) = 0\"") == "proven");
}

TEST_CASE("integrals are what quadrature says, too") {
    for (const char* equation : {"integral(tan(x), x, 0, 2) = -log(abs(cos(2)))", "integral(1/x^3, x, -1, 2) = 3/8",
                                 "integral(1/cos(x)^2, x, 0, 3) = tan(3)", "integral(1/(x - l), x, 0*l, 3*l) = log(2)"}) {
        INFO(equation);
        const std::string entry = "equation = \"" + std::string(equation) + "\"";
        CHECK(verdict(entry) == "not checkable");
    }
    for (const char* equation : {"integral(1/sqrt(x), x, 0, 1) = 2", "integral(tan(x), x, 0, 1) = -log(abs(cos(1)))",
                                 "integral(s*exp(-a*s), s, 0, infinity) = 1/a^2", "integral(r^2, r, l, 0*l) = -l^3/3",
                                 "integral(integral(r*q, q, 0, 1), r, 0, l) = l^2/4"}) {
        INFO(equation);
        const std::string entry = "equation = \"" + std::string(equation) + "\"";
        CHECK(verdict(entry) == "proven");
    }
}

TEST_CASE("points at random reach beyond a quarter turn, and say where one side has no value") {
    CHECK(verdict("equation = \"asin(sin(u)) = u\"", 1) == "wrong");
    const auto logarithms = row("equation = \"log(u) + log(v) = log(u*v)\"");
    CHECK(logarithms["verdict"] == "numerically equal");
    CHECK(logarithms["reason"].get<std::string>().find("where both sides are real") == 0);
}

TEST_CASE("points at random are small and large, and say what case none of them came into") {
    CHECK(verdict("equation = \"abs(u - 10) = 10 - u\"", 1) == "wrong");
    CHECK(verdict("positive = { p = \"1\" }\nequation = \"abs(p - 10) = 10 - p\"", 1) == "wrong");
    CHECK(verdict("letters = { p = { unit = \"1\", range = [0, 9] } }\nequation = \"max(p, 10) = 10\"") == "numerically equal");
    const auto far = row("equation = \"abs(u - 5000) + max(v, -1) = 5000 - u + max(v, -1)\"");
    CHECK(far["verdict"] == "numerically equal");
    CHECK(far["reason"] == "no point reached one of the cases that 'u' decides");
}

TEST_CASE("cases") {
    const auto latex = [](const std::string& text) { return "latex = '''" + text + "'''\n"; };
    const std::string falling = R"(|u| = \begin{cases} u & u \ge 0 \\ -u & u < 0 \end{cases})",
                      otherwise = R"(|u - v| = \begin{cases} u - v & \text{if } u > v \\ v - u & \text{otherwise} \end{cases})",
                      turned = R"(|u| = \begin{cases} u & u < 0 \\ -u & u \ge 0 \end{cases})",
                      three = R"(\min\{\max\{u, -1\}, 1\} = \begin{cases} -1 & u < -1 \\ 1 & u > 1 \\ u & \text{sonst} \end{cases})",
                      partly = R"(|u| = \begin{cases} u & 0 < u < 1 \\ -u & u < 0 \end{cases})",
                      single = R"(v = \begin{cases} v & u = 0 \\ u & \text{otherwise} \end{cases})";
    CHECK(verdict(latex(falling)) == "proven");
    CHECK(verdict(latex(otherwise)) == "proven");
    CHECK(verdict(latex(turned), 1) == "wrong");
    CHECK(verdict(latex(three)) == "numerically equal");  // products of signs are not multiplied out
    const std::string doubly = R"(|u| = \begin{cases} u + 1 & u > 0 \\ u - 1 & u > 0 \\ -u & u < 0 \end{cases})",
                      in_order = R"(\min\{1, \max\{-1, u\}\} = \begin{cases} -1 & u < -1 \\ u & u < 1 \\ 1 & \text{otherwise} \end{cases})";
    CHECK(verdict(latex(doubly), 1) == "wrong");  // the first that holds counts
    CHECK(verdict(latex(in_order)) == "numerically equal");
    CHECK(verdict(latex(partly)) == "proven");  // it says nothing beyond one
    CHECK(verdicts("[entries.one]\n" + latex(single), 2).empty());
}

TEST_CASE("sizes of matrices that do not fit are a verdict") {
    const auto sizes = row("equation = \"vector(u, v) = vector(u, v, w)\"", 1);
    CHECK(sizes["verdict"] == "dimensionally wrong");
    CHECK(sizes["reason"].get<std::string>().find("'vector(u, v)' is 2 by 1, but another side") == 0);
    CHECK(verdict("equation = \"matrix(row(u, v))*matrix(row(u, v)) = u^2 + v^2\"", 1) == "dimensionally wrong");
    CHECK(verdict("equation = \"trace(matrix(row(u, v), row(w, u))) = 2*u\"") == "proven");
    CHECK(verdict("equation = \"diag(u, v) = matrix(row(u, 0), row(0, v))\"") == "proven");
    const std::string determinant = R"(\det\left(\operatorname{diag}(u, v, w)\right) = u v w)";
    CHECK(verdict("latex = '''" + determinant + "'''") == "proven");
}

TEST_CASE("an entry that cannot be read does not stop the others") {
    const Folder folder;
    const std::string entries = R"([entries."1"]
equation = "u = u"
[entries."2"]
latex = '''u = \pm v'''
[entries."3"]
equation = "u = unknown"
[entries."4"]
equation = "v = v"
)";
    const std::string path = folder.write("text.toml", head + entries);
    const Answer text = ask("check", {path, "-o", folder.path() / "pages"});
    CHECK(text.code == 2);
    CHECK(text.out.find("  1                proven\n  2                not read: ") != std::string::npos);
    CHECK(text.out.find("  4                proven\n2 printed equations: 2 proven; 2 more could not be read\n") != std::string::npos);
    CHECK(text.err.find("'\\pm' stands on one side of") != std::string::npos);
    CHECK(text.err.find("unknown") != std::string::npos);
    std::ifstream book(folder.path() / "pages" / "book.html");
    const std::string page{std::istreambuf_iterator<char>(book), {}};
    CHECK(page.find("<h3>2 <span class=\"verdict\">not read</span></h3>\n<p>'\\pm' stands on one side") != std::string::npos);
    CHECK(page.find("<h3>4 <span class=\"verdict\">proven</span></h3>") != std::string::npos);
    const Answer answer = ask("check", {path, "--format", "json"});
    CHECK(answer.code == 2);
    const nlohmann::json json = answer.json();
    CHECK(json["printed"].size() == 2);
    REQUIRE(json["errors"].size() == 2);
    CHECK(json["errors"][0]["id"] == "2");
    CHECK(json["errors"][1]["error"] == "unknown-name");
    CHECK(json["errors"][1]["line"].get<int>() > json["errors"][0]["line"].get<int>());
    CHECK(json["passed"] == false);
}

TEST_CASE("a mistake in the keys of an entry, or in another file, does not stop the others") {
    const Folder folder;
    const std::string path = folder.write(
        "text.toml",
        head + "[entries.\"1\"]\nequatoin = \"u = u\"\n[entries.\"2\"]\nequation = \"u = (u\"\n[entries.\"3\"]\nequation = \"u = u\"\n");
    const std::string broken = folder.write("broken.toml", "[catalogue]\nformat = 1\nsource = \"Any\"\n[letters]\na = \"furlong\"\n");
    const Answer answer = ask("check", {broken, path, "-o", folder.path() / "pages"});
    CHECK(answer.code == 2);
    CHECK(answer.out.find("\n  not read: ") != std::string::npos);
    CHECK(answer.out.find("  1                not read: ") != std::string::npos);
    CHECK(answer.out.find("  2                not read: ") != std::string::npos);
    CHECK(answer.out.find("  3                proven\n") != std::string::npos);
    CHECK(answer.err.find("furlong") != std::string::npos);
    CHECK(answer.err.find("did you mean 'equation'?") != std::string::npos);
    CHECK(std::filesystem::exists(folder.path() / "pages" / "book.html"));
}

TEST_CASE("what solves an equation may be said twice") {
    CHECK(verdict("solves = [\"u = v\"]\nequations = [\"u = v\", \"u = v\"]") == "proven");
    CHECK(verdict("solves = [\"u = v\"]\nequations = [\"u = v\", \"u = v + w - w\"]") == "proven");
    CHECK(verdict("solves = [\"u = v\"]\nequations = [\"u = v\", \"u = w\"]", 1) == "wrong");
}

TEST_CASE("letters of other letters in integrals") {
    CHECK(verdict("with = { W = \"u^2\" }\nequation = \"integral(W, u, 0, 1) = 1/3\"") == "proven");
    CHECK(verdict("with = { W = \"V^2\", V = \"1 + u\" }\nequation = \"integral(W, u, 0, 1) = 7/3\"") == "proven");
}

TEST_CASE("numbers and letters as LaTeX has them") {
    const auto latex = [](const std::string& text) { return "latex = '''" + text + "'''\n"; };
    const std::string speed = R"(\sqrt{2 g h})";
    for (const char* number : {R"(6.26\,\mathrm{m/s})", R"(6{,}26\,\mathrm{m}/\mathrm{s})", R"(62.6\times 10^{-1}\,\mathrm{m/s})",
                               R"(0.0626\cdot 10^2\,\mathrm{m/s})"}) {
        INFO(number);
        const std::string printed = speed + " = " + number;
        CHECK(verdict(latex(printed)) == "proven");
    }
    CHECK(verdict(latex(speed + R"( = 62.5\times 10^{-1}\,\mathrm{m/s})"), 1) == "wrong");
    CHECK(verdict(latex(R"(\sqrt{2} \approx 1.414)")) == "proven");
    CHECK(verdict(latex(R"(\sqrt{2} \approx 1.415)"), 1) == "wrong");
    CHECK(verdict("letters = { e = \"1\" }\n" + latex("1 - e^2 = (1 - e)(1 + e)")) == "proven");
    CHECK(verdict(latex("e^{u + v} = e^u e^v")) == "proven");
    CHECK(verdict(latex(R"(\frac{1}{2}\,\mathrm{km} = 500\,\mathrm{m})")) == "proven");
    CHECK(verdict(latex(R"(\frac34\,\mathrm{km} = 75 \cdot 10\,\mathrm{m})")) == "proven");
}

TEST_CASE("what solves an equation is inserted there") {
    const std::string decay = "solves = [\"dot(x) = -a*x\", \"at(x, t, 0) = x_0\"]\n";
    CHECK(verdict(decay + "equation = \"x = x_0*exp(-a*t)\"") == "proven");
    CHECK(row(decay + "equation = \"x = x_0*exp(a*t)\"", 1)["suggestion"] == "x = x_0/exp(a*t)");
    CHECK(verdict(decay + "equation = \"x = 2*x_0*exp(-a*t)\"", 1) == "wrong");
}

TEST_CASE("numbers are right to the digits that are printed") {
    const std::string speed = "unit = \"m/s\"\nequation = \"sqrt(2*g*h) = ";
    CHECK(verdict(speed + "6.26\"") == "proven");
    CHECK(verdict(speed + "6.264\"") == "proven");
    CHECK(verdict(speed + "6\"") == "proven");
    CHECK(verdict(speed + "6.27\"", 1) == "wrong");
    CHECK(verdict(speed + "6.260\"", 1) == "wrong");
    CHECK(verdict("unit = \"km/h\"\nequation = \"sqrt(2*g*h) = 22.55\"") == "proven");
    CHECK(verdict("equation = \"sqrt(2*g*h) = quantity(626*10^(-2), m/s)\"") == "proven");
    CHECK(verdict("unit = \"m\"\nequation = \"sqrt(2*g*h) = 6.26\"", 1) == "dimensionally wrong");
    CHECK(verdict("unit = \"m\"\nequation = \"x_0 = 6.26\"") == "not checkable");  // it has no value
}

TEST_CASE("vectors and matrices") {
    CHECK(verdict("equation = \"cross(vector(u, v, w), vector(v, w, u)) = vector(v*u - w^2, w*v - u^2, u*w - v^2)\"") == "proven");
    CHECK(verdict("with = { A = \"matrix(row(u, v), row(v, w))\" }\nequation = \"A*inverse(A) = matrix(row(1, 0), row(0, 1))\"") ==
          "proven");
    CHECK(verdict("with = { A = \"matrix(row(u, v), row(v, w))\" }\nequation = \"det(A) = u*w - v^2\"") == "proven");
    CHECK(verdict("with = { q = \"vector(u, v)\" }\nequation = \"diff(transpose(q)*q, q) = 2*transpose(q)\"") == "proven");
    CHECK(verdict("equation = \"vector(u, v) - vector(u, v) = 0\"") == "proven");
    CHECK(row("equation = \"cross(vector(u, v, w), vector(v, w, u)) = vector(v*u - w^2, w*v - u^2, u*w + v^2)\"", 1)["suggestion"]
              .get<std::string>()
              .find("u*w - v^2") != std::string::npos);
    CHECK(verdict(model("spherical_pendulum") +
                  "equation = \"position[bob] = vector(l*sin(theta)*cos(phi), -l*cos(theta), l*sin(theta)*sin(phi))\"") == "proven");
}

TEST_CASE("a single slip is found") {
    CHECK(mended("sin(u + v) = sin(u)*cos(v) - cos(u)*sin(v)") != "");
    CHECK(mended("sin(2*u) = sin(u)*cos(u)") != "");
    CHECK(mended("cosh(u)^2 - sinh(u)^2 = sin(u)^2 + cosh(u)^2 + 1 - cosh(u)^2") != "");
    CHECK(mended("(u + v)^2 = u^2 + u*v + v^2") == "(u + v)^2 = u^2 + 2*(u*v) + v^2");
    CHECK(mended("w*(u + v) = w*u + v") != "");
    CHECK(mended("integral(r^2, r, 0, l) = l^2/3") == "integral(r^2, r, 0, l) = l^3/3");  // dimensionally wrong
    CHECK(mended("u*v = u^3 + v^5 + 1").empty());                                         // no single one
}

TEST_CASE("against a model") {
    CHECK(verdict(model("spherical_pendulum") + "equation = \"potential_energy = m*g*l*(1 - cos(theta))\"") == "proven");
    const auto wrong = row(model("spherical_pendulum") + "equation = \"potential_energy = m*g*l*(1 - sin(theta))\"", 1);
    CHECK(wrong["verdict"] == "wrong");
    CHECK(wrong["suggestion"] == "potential_energy = m*g*l*(1 - cos(theta))");
    CHECK(wrong["counterexample"]["values"].contains("theta"));
    CHECK(verdict(model("spherical_pendulum") + "printed = \"2.222\"") == "proven");
    CHECK(verdict(model("spherical_pendulum") +
                  "letters = { delta = \"1\" }\nequation = \"(kinetic_energy - kinetic_energy)*delta = 0\"") == "proven");
}

TEST_CASE("LaTeX") {
    CHECK(verdict("latex = '''\\sin(u + v) = \\sin u \\cos v + \\cos u \\sin v \\quad (1.1)'''") == "proven");
    CHECK(verdict("latex = '''\\int_0^l r^2 dr = \\frac{l^3}{3}'''") == "proven");
    CHECK(verdict(model("spherical_pendulum") +
                  "notation = { V = \"potential_energy\" }\nlatex = '''V = mgl (1 - \\cos(\\theta)) . \\quad (2.219)'''") == "proven");
    CHECK(verdict(model("spherical_pendulum") + "notation = { T = \"kinetic_energy\", '\\mathbf{r}' = \"position[bob]\" }\n"
                                                "latex = '''T = \\frac{1}{2} m \\dot{\\mathbf{r}}^T \\dot{\\mathbf{r}} = \\frac{1}{2} ml^2 "
                                                "(\\dot{\\theta}^2 + \\dot{\\varphi}^2 \\sin^2(\\theta)) . \\quad (2.218)'''") == "proven");
}

TEST_CASE("verdicts come from the derivation, not from what is expected") {
    const std::string wrong = "equation = \"sin(2*u) = sin(u)*cos(u)\"\n";
    CHECK(verdict(wrong, 1) == "wrong");
    CHECK(verdict(wrong + "expect = \"wrong\"", 0) == "wrong");
    CHECK(verdict("equation = \"u = u\"\nexpect = \"wrong\"", 1) == "proven");
    CHECK(verdict("not_checkable = \"definition\"") == "not checkable");
}

TEST_CASE("several files, and pages") {
    const Folder folder;
    const std::string one = folder.write("one.toml", head + "[entries.\"1.1\"]\nequation = \"u = u\"\n");
    const std::string two = folder.write("two.toml", head + "[entries.\"2.1\"]\ndoc = \"<b>\"\nequation = \"sin(2*u) = sin(u)*cos(u)\"\n");
    const Answer answer = ask("check", {one, two, "--format", "json", "-o", folder.path() / "pages"});
    CHECK(answer.code == 1);
    CHECK(answer.json()["summary"]["entries"] == 2);
    CHECK(answer.json()["summary"]["proven"] == 1);
    CHECK(answer.json()["files"].size() == 2);
    const auto text = [&](const char* name) {
        std::ifstream in(folder.path() / "pages" / name);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string book = text("book.html"), errata = text("errata.html");
    CHECK(book.find("1.1") != std::string::npos);
    CHECK(book.find("<b>") == std::string::npos);
    CHECK(book.find("<script") == std::string::npos);
    CHECK(book.find("http") == std::string::npos);
    CHECK(errata.find("2.1") != std::string::npos);
    CHECK(errata.find(">1.1 ") == std::string::npos);
}

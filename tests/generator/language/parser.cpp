// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/parser.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

namespace {

Excerpt text(const std::string& expression) { return excerpt_of(std::make_shared<const Source>("test", expression)); }

/// The tree with all brackets, to see what binds how.
std::string tree(const Expression& e) {
    using Kind = Expression::Kind;
    const auto child = [&](std::size_t i) { return tree(*e.children[i]); };
    switch (e.kind) {
        case Kind::number: return to_string(e.value);
        case Kind::negate: return "(-" + child(0) + ")";
        case Kind::add: return "(" + child(0) + "+" + child(1) + ")";
        case Kind::subtract: return "(" + child(0) + "-" + child(1) + ")";
        case Kind::multiply: return "(" + child(0) + "*" + child(1) + ")";
        case Kind::divide: return "(" + child(0) + "/" + child(1) + ")";
        case Kind::power: return "(" + child(0) + "^" + child(1) + ")";
        default: break;
    }
    std::string inside;
    for (const ExpressionPtr& c : e.children) inside += (inside.empty() ? "" : ",") + tree(*c);
    if (e.kind == Kind::name) return e.children.empty() ? e.name : e.name + "[" + inside + "]";
    return (e.kind == Kind::sum ? "sum " : "") + e.name + "(" + inside + ")";
}

std::string parsed(const std::string& expression) { return tree(*parse_expression(text(expression))); }

}  // namespace

TEST_CASE("what binds how") {
    CHECK(parsed("a + b*c^2") == "(a+(b*(c^2)))");
    CHECK(parsed("-x^2") == "(-(x^2))");
    CHECK(parsed("a - b - c") == "((a-b)-c)");
    CHECK(parsed("a/b/c") == "((a/b)/c)");
    CHECK(parsed("2^3^2") == "(2^(3^2))");
    CHECK(parsed("2^-1") == "(2^(-1))");
    CHECK(parsed("a*-b") == "(a*(-b))");
    CHECK(parsed("+a") == "a");
    CHECK(parsed("sin(phi[k+1]) + 0.5") == "(sin(phi[(k+1)])+1/2)");
    CHECK(parsed("sum(k, 1, N, m[k])") == "sum k(1,N,m[k])");
    CHECK(parsed("mass_matrix[s, phi]") == "mass_matrix[s,phi]");
    CHECK(parsed("1e3*x") == "(1000*x)");
}

TEST_CASE("numbers with units are in SI") {
    CHECK(parsed("5 bar") == "500000");
    CHECK(parsed("5bar + 20 mbar") == "(500000+2000)");
    CHECK(parsed("20 degC") == "5863/20");
    CHECK(parsed("-5 degC") == "5363/20");
    CHECK(parsed("T - 5 degC") == "(T-5563/20)");
    CHECK(parsed("90 deg") == "(1/2*pi)");
    CHECK(parsed("36 km/h") == "10");
    CHECK(parsed("(36 km/h)*t") == "(10*t)");
    CHECK(parsed("718 J/(kg*K)") == "718");
    CHECK(parsed("(2 kJ/(kg*K))*t") == "(2000*t)");
    CHECK(parsed("12 W/(m^2*K)") == "12");
    CHECK(parse_expression(text("8 W/(cm^2*K)"))->name == "kg/(s^3*K)");
    CHECK(parsed("6 N/(x + 1)") == "(6/(x+1))");
    CHECK(parsed("6 N/(m*x)") == "(6/(m*x))");
    CHECK(parsed("5 bar*t") == "(500000*t)");
    CHECK(parsed("max(2 m, x)") == "max(2,x)");
    CHECK(parsed("4 mm^2*c") == "(1/250000*c)");
    CHECK(parse_expression(text("5 bar"))->name == "Pa");
    CHECK(parse_expression(text("5"))->name.empty());
}

TEST_CASE("laws, equations, families") {
    const Law law = parse_law(text("e -> c*e"));
    CHECK(law.variable == "e");
    CHECK(tree(*law.body) == "(c*e)");
    CHECK(parse_equation(text("a = b = c")).sides.size() == 3);
    const Family family = parse_family(text("k = 1..N-1"));
    CHECK(tree(*family.from) == "1");
    CHECK(tree(*family.to) == "(N-1)");
}

TEST_CASE("what is no expression is refused at the right place") {
    const auto column = [](const std::string& expression) {
        try {
            parse_expression(text(expression));
        } catch (const Failure& failure) {
            return failure.diagnostics().front().span.begin + 1;
        }
        return std::size_t{0};
    };
    CHECK(column("a b") == 3);
    CHECK(column("(a + b") == 7);
    CHECK(column("a + * b") == 5);
    CHECK(column("sin(") == 5);
    CHECK(column("a[1") == 4);
    CHECK(column("") == 1);
    CHECK(column("a $ b") == 3);
    CHECK(column("sum(k, 1, N)") == 12);
    CHECK(column("a = b") == 3);
    CHECK(column("2 x") == 3);
    CHECK(column("3 m/s*x") == 1);
    CHECK(column("a + 3 m/s") == 5);
    CHECK(column("a + 3 W/(m*K)") == 5);
}

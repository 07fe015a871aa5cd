// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/slips.hpp"

#include <doctest/doctest.h>

#include <set>

#include "language/expression_text.hpp"
#include "language/parser.hpp"

using namespace dalembert;

namespace {

std::set<std::string> slips(const std::string& equation, const std::vector<KnownLetter>& letters = {}, bool is_wide = false) {
    std::set<std::string> found;
    for (const Slip& slip : slips_of(parse_equation(excerpt_of(std::make_shared<const Source>("test", equation))), letters, {is_wide, {}})) found.insert(in_model_language(slip.equation));
    return found;
}

}  // namespace

TEST_CASE("slips of print") {
    const auto sum = slips("y = a*x - b");
    CHECK(sum.contains("y = a*x + b"));
    CHECK(sum.contains("y = a*x"));
    CHECK(sum.contains("y = a*(x - b)"));
    CHECK(sum.contains("y = 2*(a*x) - b"));
    CHECK(sum.contains("y = a/x - b"));
    const auto power = slips("y = x^2");
    CHECK(power.contains("y = x^3"));
    CHECK(power.contains("y = x"));
    CHECK(power.contains("y = x^-2"));
    CHECK(slips("y = sin(x)").contains("y = cos(x)"));
    CHECK(slips("y = dot(x)").contains("y = ddot(x)"));
    CHECK(slips("y = dot(x)").contains("y = x"));
    CHECK(slips("y = (a + b)/c").contains("y = a + b/c"));
    CHECK(slips("y = a/b").contains("y = b/a"));
}

TEST_CASE("letters are taken for others of their stem or unit") {
    const std::vector<KnownLetter> letters{{"m_1", "kg"}, {"m_2", "kg"}, {"M", "kg"}, {"x", "m"}};
    const auto found = slips("y = m_1*x", letters);
    CHECK(found.contains("y = m_2*x"));
    CHECK(found.contains("y = M*x"));
    CHECK_FALSE(found.contains("y = x*x"));
    CHECK(slips("y = r[bob, 1]").contains("y = r[bob, 2]"));
}

TEST_CASE("a slip is never the equation itself") {
    for (const char* equation : {"y = a*x - b", "y = (a + b)/c^2", "y = sin(x)*(a - b)^3", "y = -a"}) CHECK_FALSE(slips(equation).contains(equation));
}

TEST_CASE("slips that are many are asked for") {
    const std::vector<KnownLetter> letters{{"m", "kg"}, {"g", "m/s^2"}, {"l", "m"}};
    const auto found = slips("y = m*g", letters, true);
    CHECK(found.contains("y = l*(m*g)"));
    CHECK(found.contains("y = g/m"));
    CHECK_FALSE(slips("y = m*g", letters).contains("y = l*(m*g)"));
    CHECK(slips("y = m*(a - b)", letters, true).contains("y = m*(a - b)^2"));
    CHECK(slips("y = m*dot(x)", letters, true).contains("y = m*dot(x)^2"));
    CHECK(slips("y = cosh(x)", {}, true).contains("y = tanh(x)"));
}

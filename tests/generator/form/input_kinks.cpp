// SPDX-License-Identifier: GPL-3.0-or-later
// Where inputs have kinks: of time alone, to the last digit, and nowhere else.
#include "form/input_kinks.hpp"

#include <cmath>

#include "generator/machine.hpp"
#include "language/parser.hpp"

using namespace dalembert;

namespace {

/// The kinks of u = expression up to 10 s.
std::vector<double> kinks(const std::string& expression) {
    const Machine machine = machine_from(block + "[inputs]\nu = { unit = \"N\" }\nw = { unit = \"N\" }\n[forces.f]\non = \"block\"\nforce = [\"u + w\", 0, 0]\n");
    const System& system = *machine.system;
    const Values values(system.scene, system.translate);
    const auto source = std::make_shared<const Source>("input", expression);
    return input_kinks(system, {system.translate(*parse_expression(excerpt_of(source)), {}), 0}, values, 10);
}

void check_places(const std::string& expression, const std::vector<double>& places) {
    INFO(expression);
    const std::vector<double> found = kinks(expression);
    REQUIRE(found.size() == places.size());
    for (std::size_t i = 0; i < places.size(); ++i) CHECK(found[i] == doctest::Approx(places[i]).epsilon(1e-15));
}

}  // namespace

TEST_CASE("functions with a corner, and what stands in others") {
    check_places("max(t - pi, 0)", {std::acos(-1.0)});
    check_places("abs(sin(t))", {std::acos(-1.0), 2 * std::acos(-1.0), 3 * std::acos(-1.0)});
    check_places("3*exp(min(t, 7)) + sign(2 - t)", {2, 7});
    check_places("max(0, 1 - abs(t - 5))", {4, 5, 6});
    check_places("sqrt(max(t - m, 0))", {2});
}

TEST_CASE("no kink: smooth, of the state, of a constant, or at the ends") {
    for (const char* expression : {"sin(t)", "max(x - t, 0)", "abs(x)*t", "abs(m)*t", "max(t, 0)", "max(t - 11, 0)"}) check_places(expression, {});
}

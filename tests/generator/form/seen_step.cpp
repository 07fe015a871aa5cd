// SPDX-License-Identifier: GPL-3.0-or-later
// Within which steps inputs hide nothing.
#include "form/seen_step.hpp"

#include <cmath>

#include "generator/machine.hpp"
#include "language/parser.hpp"

using namespace dalembert;

namespace {

double seen_with(const std::string& expression) {
    INFO(expression);
    const Machine machine = machine_from(block + "[inputs]\nu = { unit = \"N\" }\n[forces.f]\non = \"block\"\nforce = [\"u\", 0, 0]\n");
    const System& system = *machine.system;
    const auto source = std::make_shared<const Source>("input", expression);
    return seen_step(system, {system.translate(*parse_expression(excerpt_of(source)), {})});
}

}  // namespace

TEST_CASE("what rests, and low powers of the time, hide nothing") {
    for (const char* expression : {"0", "m", "x^2", "(1 - t)*x", "t^4"}) CHECK(std::isinf(seen_with(expression)));
}

TEST_CASE("the fastest of sines, cosines and exponentials says how much steps see") {
    CHECK(seen_with("2*sin(4*t)") == doctest::Approx(1.0 / 16));
    CHECK(seen_with("cos(t)^2*sin(3*t + x)") == doctest::Approx(1.0 / 12));
    CHECK(seen_with("t^3*exp(-1000*t)") == doctest::Approx(1.0 / 4000));
    CHECK(seen_with("cos(t) + cos(2*t) + cos(3*t) + cos(4*t) + cos(5*t)") == doctest::Approx(1.0 / 20));
    CHECK(seen_with("sin(pi*t)") == doctest::Approx(1 / (4 * std::acos(-1.0))));
}

TEST_CASE("of pulses, and of rates that are no numbers, nothing is known") {
    for (const char* expression : {"exp(-(t - 5)^2)", "sin(t^2)", "sin(t)^6", "(1 + cos(t))^8", "1/(1 + (t - 5)^2)", "sin(exp(t))",
                                   "abs(sin(t))", "step(t - 1)", "tanh(t)", "exp(-x^2*t^2)", "sqrt(t + 1)", "2^t",
                                   "sin(m*t)", "sin(x*t)", "t^5"})
        CHECK(seen_with(expression) == 0);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Which inputs steps of any length cannot miss.
#include "form/free_steps.hpp"

#include "generator/machine.hpp"
#include "language/parser.hpp"

using namespace dalembert;

namespace {

bool steps_freely_with(const std::string& expression) {
    const Machine machine = machine_from(block + "[inputs]\nu = { unit = \"N\" }\n[forces.f]\non = \"block\"\nforce = [\"u\", 0, 0]\n");
    const System& system = *machine.system;
    const auto source = std::make_shared<const Source>("input", expression);
    return steps_freely(system, {system.translate(*parse_expression(excerpt_of(source)), {})});
}

}  // namespace

TEST_CASE("steps are free where inputs are still, or few sines, cosines, exponentials and powers of the time") {
    for (const char* expression : {"0", "m", "x^2", "2*sin(4*t)", "t^3*exp(-t)", "cos(t)^2*sin(3*t + x)", "(1 - t)*x",
                                   "sin(t) + cos(2*t) + exp(-3*t)"}) {
        CAPTURE(expression);
        CHECK(steps_freely_with(expression));
    }
}

TEST_CASE("steps are not free beside pulses") {
    for (const char* expression : {"exp(-(t - 5)^2)", "sin(t^2)", "sin(t)^6", "(1 + cos(t))^8", "1/(1 + (t - 5)^2)", "sin(exp(t))",
                                   "abs(sin(t))", "step(t - 1)", "tanh(t)", "exp(-x^2*t^2)", "sqrt(t + 1)", "2^t",
                                   "cos(t) + cos(2*t) + cos(3*t) + cos(4*t) + cos(5*t)"}) {
        CAPTURE(expression);
        CHECK_FALSE(steps_freely_with(expression));
    }
}

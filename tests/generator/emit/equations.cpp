// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/equations.hpp"

#include "generator/audits.hpp"
#include "generator/machine.hpp"

using namespace dalembert;
using GiNaC::ex;

// A rotary pendulum: the solve takes the second coordinate first.
TEST_CASE("equations of motion for people are M*ddot(q) + bias = Q, in the order of the coordinates") {
    const Machine machine = machine_from(
        "[parameters]\nJ_1 = { value = 1, unit = \"kg*m^2\" }\nJ_2 = { value = 2, unit = \"kg*m^2\" }\nL = { value = 1, unit = \"m\" }\n"
        "m = { value = 2, unit = \"kg\" }\nl = { value = 1, unit = \"m\" }\ng = { value = 9.81, unit = \"m/s^2\" }\n"
        "[coordinates]\ntheta = { unit = \"rad\" }\nalpha = { unit = \"rad\" }\n[inputs]\ntau = { unit = \"N*m\" }\n"
        "[gravity]\nacceleration = [0, 0, \"-g\"]\n[bodies.arm]\nrotation = \"theta\"\ninertia = \"J_1\"\n"
        "[bodies.pendulum]\non = \"arm\"\norigin = [\"L\", 0, 0]\nturns = [[\"x\", \"alpha\"]]\nmass = \"m\"\ncentre = [0, 0, \"-l\"]\n"
        "inertia = [\"J_2\", \"J_2\", 0]\n[torques.motor]\non = \"arm\"\ntorque = \"tau\"\n");
    const System& s = *machine.system;
    const auto equations = motion_equations(s);
    REQUIRE(equations.size() == 2);
    CHECK(equations[0].second.is_equal(symbol_named(s, SymbolKind::input, "tau")));
    CHECK(equations[1].second.is_zero());
    for (unsigned j = 0; j < 2; ++j) {
        ex left = s.bias[j];
        for (unsigned k = 0; k < 2; ++k) left += s.mass(j, k) * s.symbols.get(SymbolKind::acceleration, k);
        CHECK(is_zero_for_all(equations[j].first - left));
    }
}

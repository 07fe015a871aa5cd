// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/settings.hpp"

#include "generator/machine.hpp"

using namespace dalembert;

TEST_CASE("values from the command line") {
    const Machine machine = machine_of("cart_pendulum", "lab");
    const System& system = *machine.system;
    Values values(system.scene, system.translate);
    apply_settings(values, parse_settings({"m_W=1200g, g = 9.8", "l_S=1/2"}, "parameter"), on_parameters, system);
    apply_settings(values, parse_settings({"s=55cm,dot(s)=-0.3,phi = 90 deg"}, "state"), on_states, system);
    CHECK(values.parameter(0).is_equal(GiNaC::numeric(6, 5)));
    const auto x = values.state();
    CHECK(x[0].is_equal(GiNaC::numeric(11, 20)));
    CHECK(x[1].is_equal(GiNaC::Pi / 2));
    CHECK(x[2].is_equal(GiNaC::numeric(-3, 10)));
    CHECK_THROWS_AS(apply_settings(values, parse_settings({"m_W=3m"}, "parameter"), on_parameters, system), Failure);
    CHECK_THROWS_AS(apply_settings(values, parse_settings({"s=1"}, "parameter"), on_parameters, system), Failure);
    CHECK_THROWS_AS(apply_settings(values, parse_settings({"m_W=1000kg"}, "parameter"), on_parameters, system), Failure);
    CHECK_THROWS_AS(parse_settings({"m_W"}, "parameter"), Failure);
    CHECK_THROWS_AS(parse_settings({"m_W=3 parsecs"}, "parameter"), Failure);
}

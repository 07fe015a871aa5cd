// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/settings.hpp"

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

TEST_CASE("units with degrees above and below") {
    const Machine machine = machine_from("[parameters]\nc = { value = 1, unit = \"N*m/rad\" }\nJ = { value = 1, unit = \"kg*m^2\" }\n[coordinates]\nphi = { unit = \"rad\" }\n"
                                         "[bodies.b]\nrotation = \"phi\"\ninertia = \"J\"\n[springs.s]\nstiffness = \"c\"\nelongation = \"phi\"\n");
    Values values(machine.system->scene, machine.system->translate);
    apply_settings(values, parse_settings({"c=5N*m/deg"}, "parameter"), on_parameters, *machine.system);
    CHECK(values.parameter(0).is_equal(900 / GiNaC::Pi));
    apply_settings(values, parse_settings({"phi=90deg"}, "state"), on_states, *machine.system);
    CHECK(values.state()[0].is_equal(GiNaC::Pi / 2));
}

TEST_CASE("a value without a unit counts in the declared one") {
    const Machine machine = machine_from("[parameters]\nm = { value = 1, unit = \"t\" }\nk = { value = 2, unit = \"1\" }\n[coordinates]\nphi = { unit = \"deg\", start = \"2*k*(10 deg)\", start_rate = \"3*2\" }\n"
                                         "[bodies.b]\nmass = \"m\"\nposition = [\"sin(phi)*(1 m)\", 0]\n");
    Values values(machine.system->scene, machine.system->translate);
    const auto set = [&](const char* parameter, const char* state) {
        apply_settings(values, parse_settings({parameter}, "parameter"), on_parameters, *machine.system);
        apply_settings(values, parse_settings({state}, "state"), on_states, *machine.system);
    };
    CHECK(values.state()[0].subs(values.substitution()).is_equal(2 * GiNaC::Pi / 9));
    CHECK(values.state()[1].is_equal(GiNaC::Pi / 30));
    set("m=2*3", "phi=3*15");
    CHECK(values.parameter(0).is_equal(6000));
    CHECK(values.state()[0].is_equal(GiNaC::Pi / 4));
    set("m=2 kg", "phi=asin(1/2)");
    CHECK(values.parameter(0).is_equal(2));
    CHECK(values.state()[0].is_equal(GiNaC::Pi / 6));
    set("m=1", "dot(phi)=18");
    CHECK(values.state()[1].is_equal(GiNaC::Pi / 10));
    CHECK_THROWS_AS(set("m=1", "phi=30*k"), Failure);  // in deg or in rad?
}

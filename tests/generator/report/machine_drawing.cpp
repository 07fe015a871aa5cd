// SPDX-License-Identifier: GPL-3.0-or-later
// Where bars of drawings begin and end.
#include "report/machine_drawing.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "generator/machine.hpp"

using namespace dalembert;

namespace {

/// The drawing of bodies, which may turn by angles a and b.
MachineDrawing drawing(const std::string& bodies) {
    const Machine machine = machine_from("[coordinates]\na = { unit = \"rad\" }\nb = { unit = \"rad\" }\n" + bodies);
    return drawing_of(machine);
}
/// Whether a point is there, for a = 1 and b = 2.
bool is_at(const MachineDrawing& drawn, std::size_t point, double x, double y) {
    const auto number = [&](std::size_t i) {
        GiNaC::ex value = drawn.coordinates.at(3 * point + i);
        GiNaC::exmap values;
        for (auto part = value.preorder_begin(); part != value.preorder_end(); ++part)
            if (GiNaC::is_a<GiNaC::symbol>(*part)) values[*part] = GiNaC::ex_to<GiNaC::symbol>(*part).get_name() == "a" ? 1 : 2;
        return GiNaC::ex_to<GiNaC::numeric>(value.subs(values).evalf()).to_double();
    };
    return number(0) == doctest::Approx(x) && number(1) == doctest::Approx(y);
}

}  // namespace

TEST_CASE("networks of fluids and heat have the parts and links of the scene, in all of its modes") {
    const MachineDrawing cylinder = drawing_of(machine_of("hydraulics/hydraulic_cylinder", "leaking"));
    REQUIRE(cylinder.networks.size() == 1);
    const NetworkDrawing& network = cylinder.networks[0];
    const auto kinds = [](const NetworkDrawing& of) {
        std::string text;
        for (const NetworkDrawing::Part& part : of.parts) text += part.name + ": " + part.kind + "; ";
        for (const NetworkDrawing::Link& link : of.links)
            text += link.name + ": " + link.kind + " " + of.parts[link.from].name + " - " + of.parts[link.to].name + "; ";
        return text;
    };
    CHECK(kinds(network) == "chamber_1: cylinder; chamber_2: cylinder; supply: reservoir; tank: reservoir; "
                            "inlet_1:  supply - chamber_1; inlet_2:  tank - chamber_2; leak: laminar chamber_1 - chamber_2; ");
    const MachineDrawing valve = drawing_of(machine_of("pneumatics/check_valve"));
    CHECK(valve.networks.size() == 2);
    CHECK(valve.networks[0].values.size() == valve.networks[1].values.size());
    CHECK(valve.not_drawn.empty());
    const MachineDrawing wall = drawing_of(machine_of("heat/pipe_wall"));
    CHECK(kinds(wall.networks[0]).starts_with("wall: cells; insulation: cells; flowing_water: held; air: held; "));
}

TEST_CASE("bars of drawings end where inertia or other bars tell, and begin at the joint next to the body") {
    const std::string first = "[bodies.first]\nmass = \"3 kg\"\nposition = [\"(1 m)*cos(a)\", \"(1 m)*sin(a)\"]\nrotation = \"a\"\n";
    const double x = std::cos(1.0), y = std::sin(1.0);
    {
        const MachineDrawing uniform = drawing(first + "inertia = \"1 kg*m^2\"\n[kinetic.b]\nenergy = \"(1 kg*m^2)*dot(b)^2/2\"\n");
        REQUIRE(uniform.bars.size() == 1);
        CHECK(is_at(uniform, uniform.bars[0].from, 0, 0));
        CHECK(is_at(uniform, uniform.bars[0].to, 2 * x, 2 * y));
    }
    {
        const MachineDrawing other = drawing(first + "inertia = \"2 kg*m^2\"\n[kinetic.b]\nenergy = \"(1 kg*m^2)*dot(b)^2/2\"\n");
        REQUIRE(other.bars.size() == 1);
        CHECK(is_at(other, other.bars[0].to, x, y));
    }
    // The second one turns by a and by b, and hangs on the first.
    const MachineDrawing both = drawing(
        first + "inertia = \"2 kg*m^2\"\n[bodies.second]\nmass = \"1 kg\"\nposition = [\"(3 m)*cos(a) + (1 m)*cos(a + b)\", "
                "\"(3 m)*sin(a) + (1 m)*sin(a + b)\"]\nrotation = \"a + b\"\ninertia = \"5 kg*m^2\"\n");
    REQUIRE(both.bars.size() == 2);
    CHECK(is_at(both, both.bars[0].from, 0, 0));
    CHECK(is_at(both, both.bars[1].from, 3 * x, 3 * y));
    CHECK(is_at(both, both.bars[1].to, 3 * x + std::cos(3.0), 3 * y + std::sin(3.0)));
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Where bars of drawings begin and end.
#include "report/machine_drawing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
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

/// A value where all letters are 1.
double at_ones(const GiNaC::ex& e) {
    GiNaC::exmap values;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part)) values[*part] = 1;
    return GiNaC::ex_to<GiNaC::numeric>(e.subs(values).evalf()).to_double();
}

/// Parts and links of a network, by names.
std::string kinds(const NetworkDrawing& of) {
    std::string text;
    for (const NetworkDrawing::Part& part : of.parts) text += part.name + ": " + part.kind + "; ";
    for (const NetworkDrawing::Link& link : of.links)
        text += link.name + ": " + link.kind + " " + of.parts[link.from].name + " - " + of.parts[link.to].name + "; ";
    return text;
}

}  // namespace

TEST_CASE("networks of fluids and heat have the parts and links of the scene, in all of its modes") {
    const MachineDrawing cylinder = drawing_of(machine_of("hydraulics/hydraulic_cylinder", "leaking"));
    REQUIRE(cylinder.networks.size() == 1);
    const NetworkDrawing& network = cylinder.networks[0];
    CHECK(kinds(network) == "chamber_1: cylinder; chamber_2: cylinder; supply: reservoir; tank: reservoir; "
                            "inlet_1:  supply - chamber_1; inlet_2:  tank - chamber_2; leak: laminar chamber_1 - chamber_2; ");
    const MachineDrawing valve = drawing_of(machine_of("pneumatics/check_valve"));
    CHECK(valve.networks.size() == 2);
    CHECK(valve.networks[0].values.size() == valve.networks[1].values.size());
    CHECK(valve.not_drawn.empty());
    const MachineDrawing tank = drawing_of(machine_of("hydraulics/switched_tank", "switched"));
    CHECK(tank.not_drawn.empty());
    CHECK(kinds(tank.networks[0]) == "tank: tank; ambient: reservoir; source: reservoir; opening: hydraulic_orifice tank - ambient; "
                                     "inflow:  source - tank; ");
    const MachineDrawing wall = drawing_of(machine_of("heat/pipe_wall"));
    CHECK(kinds(wall.networks[0]).starts_with("wall: cells; insulation: cells; flowing_water: held; air: held; "));
    const MachineDrawing buck = drawing_of(machine_of("drives/buck_converter"));
    CHECK(kinds(buck.networks[0]) == "plus: pin; chopped: pin; out: pin; : ground; : ground; : ground; : ground; "
                                     "battery: voltage_source  - plus; S: switch plus - chopped; D: diode  - chopped; "
                                     "choke: inductor chopped - out; store: capacitor out - ; load: resistor out - ; ");
    CHECK(buck.networks.size() == 3);
    std::vector<int> conducting;
    for (const NetworkDrawing& mode : buck.networks) {
        int conducts = 0;
        for (const NetworkDrawing::Link& link : mode.links)
            if (link.conducts && mode.values[*link.conducts].is_equal(1)) ++conducts;
        conducting.push_back(conducts);
    }
    std::sort(conducting.begin(), conducting.end());
    CHECK(conducting == std::vector{0, 1, 1});
}

TEST_CASE("bodies that turn and have no place are drawn with what turns and couples them") {
    const MachineDrawing train = drawing_of(machine_of("mechanics/drive_train", "damped"));
    CHECK(kinds(train.networks[0]) == "motor: rotor; disc: rotor; load: rotor; : outside; : outside; : gear motor - disc; "
                                      "shaft: torsion spring disc - load; shaft: torsion damper disc - load; "
                                      "motor: torque  - motor; load: torque  - load; ");
    CHECK(train.not_drawn.empty());
    // A contact and a friction are one coupling each, whatever they bring in which mode.
    const MachineDrawing dry = drawing_of(machine_of("mechanics/dry_drive_train", "damped"));
    CHECK(dry.not_drawn.empty());
    CHECK(kinds(dry.networks[0]).ends_with(": gear motor - disc; motor: torque  - motor; load: clutch  - load; "
                                           "damped_shaft: torsion spring disc - load; "));
    bool is_held = false, is_slipping = false;
    for (const NetworkDrawing& mode : dry.networks) {
        const NetworkDrawing::Link& brake = mode.links.at(2);
        REQUIRE(brake.flow);
        const GiNaC::ex holds = mode.values.at(brake.conducts.value()), torque = mode.values.at(*brake.flow);
        CHECK(holds.is_equal(torque.is_zero() ? 1 : 0));
        (holds.is_equal(1) ? is_held : is_slipping) = true;
    }
    CHECK((is_held && is_slipping));
    // The rate of a bearing is that of one rotor, although another one has the same coordinate.
    const MachineDrawing screw = drawing_of(machine_of("parts/ball_screw"));
    CHECK(kinds(screw.networks[0]) == "screw: rotor; : fixed; : outside; bearings: torsion damper  - screw; drive: torque  - screw; ");
}

TEST_CASE("forces and torques are in the axes of the ground, at bodies, points and joints") {
    const MachineDrawing drawn = drawing_of(machine_from(
        "[bodies]\narm = { mass = \"1 kg\", inertia = [\"1 kg*m^2\", \"1 kg*m^2\", \"1 kg*m^2\"], centre = [\"1 m\", 0, 0] }\n"
        "[joints]\nshoulder = { law = \"revolute\", body = \"arm\", at = [0, 0, \"2 m\"], axis = \"y\" }\n"
        "[forces]\nthrust = { on = \"arm\", force = [0, 0, \"5 N\"], in_axes = true }\n"
        "[torques]\nmotor = { rate = \"2*dot(shoulder)\", torque = \"3 N*m\" }\n"));
    REQUIRE(drawn.forces.size() == 2);
    const std::vector<GiNaC::ex>& values = drawn.force_values.at(0);
    CHECK(at_ones(values[0]) == doctest::Approx(5 * std::sin(1.0)));
    CHECK(at_ones(values[1]) == 0);
    CHECK(at_ones(values[2]) == doctest::Approx(5 * std::cos(1.0)));
    CHECK(drawn.forces[1].is_torque);
    CHECK(std::vector{at_ones(values[3]), at_ones(values[4]), at_ones(values[5])} == std::vector{0.0, 6.0, 0.0});
    const std::size_t joint = drawn.forces[1].at;
    CHECK(std::vector{at_ones(drawn.coordinates[3 * joint]), at_ones(drawn.coordinates[3 * joint + 2])} == std::vector{0.0, 2.0});
    REQUIRE(drawn.bars.size() == 1);
    CHECK(drawn.bars[0].from == joint);
    CHECK(drawn.not_drawn.empty());
}

TEST_CASE("bars stand where a constraint holds a distance") {
    const MachineDrawing drawn = drawing_of(machine_of("mechanics/double_pendulum_xy"));
    CHECK(drawn.bars.size() == 2);
    CHECK(drawn.not_drawn.empty());
    CHECK(drawing_of(machine_of("mechanics/four_bar")).not_drawn == std::vector<std::string>{"constraints 'loop_x' and 'loop_y'"});
}

TEST_CASE("bodies have the shapes of their solids, around their centres of mass where that is their position") {
    const std::string solids = "[coordinates]\na = { unit = \"rad\" }\n[solids]\n"
                               "plate = { shape = \"box\", size = [\"2 m\", \"1 m\", \"1 m\"], at = [\"1 m\", 0, 0], mass = \"1 kg\" }\n"
                               "pin = { shape = \"cylinder\", radius = \"1 m\", height = \"3 m\", at = [\"3 m\", 0, 0], mass = \"1 kg\" }\n"
                               "both = { of = [\"plate\", \"pin\"], at = [0, \"1 m\", 0] }\n";
    const auto place_of = [](const MachineDrawing& drawn, std::size_t shape) {
        std::vector<double> place;
        for (std::size_t i = 0; i < 3; ++i) {
            GiNaC::ex e = drawn.measures.at(drawn.shapes.at(shape).first + drawn.shapes[shape].sizes + i);
            GiNaC::exmap still;
            for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
                if (GiNaC::is_a<GiNaC::symbol>(*part)) still[*part] = 0;
            place.push_back(GiNaC::ex_to<GiNaC::numeric>(e.subs(still).evalf()).to_double());
        }
        return place;
    };
    const MachineDrawing placed = drawing_of(
        machine_from(solids + "[bodies.rotor]\nsolid = \"both\"\norigin = [0, 0, 0]\nturns = [[\"z\", \"a\"]]\n"));
    REQUIRE(placed.shapes.size() == 2);
    CHECK(placed.shapes[0].kind == "box");
    CHECK(placed.shapes[1].kind == "cylinder");
    CHECK(place_of(placed, 0) == std::vector{1.0, 1.0, 0.0});
    CHECK(place_of(placed, 1) == std::vector{3.0, 1.0, 0.0});
    const MachineDrawing centred =
        drawing_of(machine_from(solids + "[bodies.rotor]\nsolid = \"both\"\nposition = [0, 0, 0]\nrotation = \"a\"\n"));
    CHECK(place_of(centred, 0) == std::vector{-1.0, 0.0, 0.0});
}

TEST_CASE("springs and dampers are between bodies or at walls, side by side where they have the same ends") {
    const MachineDrawing drawn = drawing_of(machine_from(
        "[parameters]\nm = { unit = \"kg\", value = 1 }\nc = { unit = \"N/m\", value = 1 }\nd = { unit = \"N*s/m\", value = 1 }\n"
        "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\n"
        "[bodies]\nfirst = { mass = \"m\", position = [\"x\", 0, 0] }\nsecond = { mass = \"m\", position = [\"y\", 0, 0] }\n"
        "[springs]\nwall = { elongation = \"x - 1 m\", stiffness = \"c\" }\n"
        "middle = { elongation = \"y - x\", stiffness = \"c\" }\n"
        "[dampers]\nbeside = { rate = \"dot(x)\", coefficient = \"d\" }\n"
        "between = { rate = \"2*(dot(x) - dot(y))\", coefficient = \"d\" }\n"
        "turned = { rate = \"dot(x) + dot(y)\", coefficient = \"d\" }\nair = { on = \"first\", coefficient = \"d\" }\n"));
    std::string text;
    for (const MachineDrawing::Connector& one : drawn.connectors)
        text += std::string(one.is_damper ? "damper" : "spring") + (one.has_wall ? " at wall" : "") + " " + std::to_string(one.beside) +
                " of " + std::to_string(one.together) + "; ";
    CHECK(text == "spring at wall 0 of 2; spring 0 of 2; damper at wall 1 of 2; damper 1 of 2; ");
    REQUIRE(drawn.connectors.size() == 4);
    CHECK(drawn.connectors[0].to == drawn.connectors[2].to);
    CHECK(drawn.not_drawn == std::vector<std::string>{"damper 'turned'"});
    REQUIRE(drawn.forces.size() == 1);
    const std::vector<GiNaC::ex>& air = drawn.force_values.at(0);
    CHECK(std::vector{at_ones(air[0]), at_ones(air[1])} == std::vector{-1.0, 0.0});
}

TEST_CASE("views of models give shapes and hide parts with what leads to them") {
    const std::string block = "[bodies.block]\nmass = \"3 kg\"\nposition = [\"(1 m)*a\", 0, 0]\n[bodies.rod]\nmass = \"1 kg\"\n"
                              "position = [\"(1 m)*cos(b)\", \"(1 m)*sin(b)\"]\nrotation = \"b\"\ninertia = \"1 kg*m^2\"\n";
    const MachineDrawing seen = drawing(block + "[view]\nground = \"-1 m\"\ntrails = false\n"
                                                "parts.block = { shape = \"box\", width = \"2 m\", height = \"1 m\", colour = \"red\" }\n");
    REQUIRE(seen.looks.size() == 2);
    CHECK(seen.looks[0].shape == "box");
    CHECK(seen.looks[0].colour == "red");
    CHECK(seen.measures.at(seen.looks[0].width.value()).is_equal(2));
    CHECK(seen.measures.at(seen.ground.value()).is_equal(-1));
    CHECK_FALSE(seen.has_trails);
    CHECK(seen.bars.size() == 1);
    const MachineDrawing hidden = drawing(block + "[view]\nparts.rod = { hidden = true }\n");
    CHECK(hidden.looks[1].hidden);
    CHECK(hidden.bars.empty());
    const MachineDrawing tank = drawing(
        "[kinetic.b]\nenergy = \"(1 kg*m^2)*(dot(a)^2 + dot(b)^2)/2\"\n[states]\nh = { unit = \"m\", start = 1, range = [0, 2] }\n"
        "[media]\nwater = { law = \"incompressible\", density = \"1000 kg/m^3\" }\n"
        "[reservoirs]\nriver = { medium = \"water\", pressure = \"1 bar\" }\n"
        "[volumes]\nbasin = { medium = \"water\", volume = \"(2 m^2)*h\", filling = \"h\", pressure = \"1 bar\" }\n"
        "[flows]\ninlet = { from = \"river\", to = \"basin\", mass_flow = \"1 kg/s\" }\n[view]\nparts.inlet = { hidden = true }\n");
    REQUIRE(tank.networks[0].parts.size() == 1);
    CHECK(tank.networks[0].parts[0].name == "basin");
    CHECK(tank.networks[0].links.empty());
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

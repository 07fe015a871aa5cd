// SPDX-License-Identifier: GPL-3.0-or-later
// Balances of mass and energy: what is derived, and that no wrong sign passes the proofs.
#include <algorithm>

#include "graph/notation.hpp"
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "check/checks.hpp"
#include "elements/verdict.hpp"
#include "prove/media.hpp"
#include "symbolic/functions.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string oil =
    "[parameters]\n"
    "rho_0 = { value = 850, unit = \"kg/m^3\", range = [500, 1500] }\n"
    "beta  = { value = 1.5e9, unit = \"Pa\", range = [1e8, 1e10] }\n"
    "alpha = { value = 7e-4, unit = \"1/K\", range = [1e-5, 1e-2] }\n"
    "c_v   = { value = 1900, unit = \"J/(kg*K)\", range = [100, 5000] }\n"
    "p_0   = { value = 1, unit = \"bar\", range = [0.1, 10] }\n"
    "T_0   = { value = 300, unit = \"K\", range = [200, 400] }\n"
    "V     = { value = 1, unit = \"l\", range = [0.01, 100] }\n"
    "G     = { value = 1e-12, unit = \"m^3/(s*Pa)\", range = [1e-15, 1e-9] }\n"
    "[media.oil]\n"
    "law = \"liquid\"\ndensity = \"rho_0\"\nbulk_modulus = \"beta\"\nexpansion = \"alpha\"\nisochoric_heat = \"c_v\"\n"
    "reference_pressure = \"p_0\"\nreference_temperature = \"T_0\"\n";

const std::string leak =
    "[reservoirs.ambient]\nmedium = \"oil\"\npressure = \"p_0\"\n"
    "[flows.leak]\nfrom = \"vessel\"\nto = \"ambient\"\nlaw = \"laminar\"\nconductance = \"G\"\n";

std::string written(const Machine& machine, const ex& e) { return Notation(machine.system->symbols, Style::text)(e); }

}  // namespace

TEST_CASE("a vessel of oil: dp/dt = beta/V times the volume flow (3.92)") {
    const Machine machine = machine_from(oil + leak + "[states]\np = { unit = \"bar\", start = 50 }\n[volumes.vessel]\nmedium = \"oil\"\nvolume = \"V\"\npressure = \"p\"\n");
    CHECK(all_proven(*machine.system));
    CHECK(machine.audit.balances.size() == 2);
    CHECK(machine.system->guards.size() == 1);
    CHECK(written(machine, machine.system->state_rates[0]) != "0");
}

TEST_CASE("no sign can be wrong unseen: each rate, flow, heat, force and power negated in turn") {
    for (const auto& [name, scene] : {std::pair("hydraulics/hydraulic_cylinder", "thermal"), std::pair("pneumatics/pneumatic_cylinder", "thermal"),
                                      std::pair("hydraulics/torricelli", "book"), std::pair("hydraulics/penstock", "rough"),
                                      std::pair("pneumatics/pneumatic_isobaric", "full"), std::pair("hydraulics/pumped_storage", "full")}) {
        CAPTURE(name);
        Machine machine = machine_of(name, scene);
        System& system = *machine.system;
        REQUIRE(all_proven(system));
        for (ex& rate : system.state_rates) flipped_is_wrong(system, rate, "the rate of a state");
        // Between reservoirs nothing is stored.
        for (FlowState& flow : system.fluids.flows)
            if (flow.from_volume != nullptr || flow.to_volume != nullptr) flipped_is_wrong(system, flow.mass_flow, "mass flow " + flow.member.name());
        for (VolumeBalance& balance : system.fluids.balances) flipped_is_wrong(system, balance.heat, "a heat");
        for (ex& force : system.fluids.force) flipped_is_wrong(system, force, "the force of the fluid");
        flipped_is_wrong(system, system.internal_energy, "the internal energy");
        flipped_is_wrong(system, system.exchanged_power, "the exchanged power");
        CHECK(all_proven(system));
    }
}

TEST_CASE("the states that a user may choose say the same") {
    const auto rate_of_density = [](const std::string& states, const std::string& named) {
        const Machine machine = machine_from(oil + leak + states + "[volumes.vessel]\nmedium = \"oil\"\nvolume = \"V\"\n" + named + "temperature = \"T\"\n"
                                                                   "[outputs]\nrate = { value = \"dot(density[vessel])\" }\nheating = { value = \"dot(temperature[vessel])\" }\n");
        CHECK(all_proven(*machine.system));
        const GiNaC::exmap start = Values(machine.system->scene, machine.system->translate).substitution();
        GiNaC::exmap rates;
        for (std::size_t i = 0; i < 2; ++i) rates[machine.system->symbols.get(SymbolKind::state_rate, i)] = machine.system->state_rates[i];
        std::vector<double> result;
        for (const OutputEquation& output : machine.system->outputs) result.push_back(cln::double_approx(*value_at(output.value.subs(rates), start, 30)));
        return result;
    };
    const std::string T = "T = { unit = \"K\", start = 310 }\n";
    const std::string rho = "850*exp(49/15000 - 7e-4*10)";
    const auto by_pressure = rate_of_density("[states]\np = { unit = \"Pa\", start = 5e6 }\n" + T, "pressure = \"p\"\n");
    const auto by_density = rate_of_density("[states]\nrho = { unit = \"kg/m^3\", start = \"" + rho + "\" }\n" + T, "density = \"rho\"\n");
    const auto by_mass = rate_of_density("[states]\nm = { unit = \"kg\", start = \"0.001*" + rho + "\" }\n" + T, "mass = \"m\"\n");
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(by_pressure[i] < 0);
        CHECK(by_density[i] == doctest::Approx(by_pressure[i]).epsilon(1e-13));
        CHECK(by_mass[i] == doctest::Approx(by_pressure[i]).epsilon(1e-13));
    }
}

TEST_CASE("a medium by its density alone gets the energy (3.79) by integration") {
    const Machine machine = machine_from(oil +
                                         "[media.same]\nlaw = \"given\"\ndensity = \"(p, T) -> rho_0*exp((p - p_0)/beta - alpha*(T - T_0))\"\n"
                                         "isochoric_heat = \"c_v\"\nreference_pressure = \"p_0\"\nreference_temperature = \"T_0\"\n"
                                         "[states]\np = { unit = \"bar\", start = 50 }\nT = { unit = \"K\", start = 300 }\n"
                                         "[volumes.vessel]\nmedium = \"same\"\nvolume = \"V\"\npressure = \"p\"\ntemperature = \"T\"\nheat = \"G*p*p\"\n"
                                         "[outputs]\nleft = { value = \"specific_energy[same, p, T]\" }\nright = { value = \"specific_energy[oil, p, T]\" }\n");
    CHECK(all_proven(*machine.system));
    Prover prover(*machine.system);
    CHECK(prover.proven_equal(machine.system->outputs[0].value, machine.system->outputs[1].value));
    for (const MediumModel& medium : machine.system->fluids.containers.media)
        for (const MediumIdentity& identity : medium_identities(medium)) {
            CAPTURE(identity.name);
            CHECK(prover.proven_equal(identity.left, identity.right));
        }
}

TEST_CASE("a pump turns the pressure into a torque on its shaft") {
    const Machine machine = machine_from(
        oil +
        "[parameters.D]\nvalue = 1e-6\nunit = \"m^3\"\n[parameters.theta]\nvalue = 0.1\nunit = \"kg*m^2\"\n"
        "[coordinates]\nphi = { unit = \"rad\" }\n[bodies.shaft]\nrotation = \"phi\"\ninertia = \"theta\"\n"
        "[states]\np = { unit = \"bar\", start = 50 }\n[volumes.vessel]\nmedium = \"oil\"\nvolume = \"V\"\npressure = \"p\"\n"
        "[reservoirs.tank]\nmedium = \"oil\"\npressure = \"p_0\"\n"
        "[flows.pump]\nfrom = \"tank\"\nto = \"vessel\"\nlaw = \"pump\"\ndisplacement = \"D\"\nspeed = \"dot(phi)\"\n");
    CHECK(all_proven(*machine.system));
    CHECK(written(machine, machine.system->fluids.force[0]) == "p_0*D - D*p");
}

TEST_CASE("a volume that can vanish is told of") {
    const auto warnings = [](const std::string& range) {
        const auto model = model_from(oil + leak +
                                      "[parameters.A]\nvalue = 1e-3\nunit = \"m^2\"\n[parameters.l]\nvalue = 0.5\nunit = \"m\"\n[parameters.m]\nvalue = 1\nunit = \"kg\"\n"
                                      "[coordinates]\ns = { unit = \"m\", start = 0.1" + range + " }\n[bodies.piston]\nmass = \"m\"\nposition = [\"s\", 0, 0]\n"
                                      "[states]\np = { unit = \"bar\", start = 50 }\n[volumes.vessel]\nmedium = \"oil\"\nvolume = \"A*(l - s)\"\npressure = \"p\"\n");
        Diagnostics diagnostics;
        warn_of_vanishing(model->model, diagnostics);
        return diagnostics.all();
    };
    CHECK(warnings(", range = [0.01, 0.4]").empty());
    REQUIRE(warnings("").size() == 1);
    CHECK(warnings("").front().message.find("'s' has no range that keeps it away from zero") != std::string::npos);
    REQUIRE(warnings(", range = [0, 0.5]").size() == 1);
    CHECK(warnings(", range = [0, 0.5]").front().message.find("gets down to 0 m^3") != std::string::npos);
}

TEST_CASE("a level that is integrated as its root empties at a constant rate") {
    const Machine machine = machine_of("hydraulics/torricelli", "book");
    const System& system = *machine.system;
    CHECK(system.symbols.all(SymbolKind::state)[0].name == "sqrt(h)");
    CHECK(partial(system.state_rates[0].subs(unit_step(system.symbols.get(SymbolKind::state, 0)) == 1), system.symbols.get(SymbolKind::state, 0)).is_zero());
    REQUIRE(system.guards.size() == 1);
    CHECK_FALSE(system.guards[0].ends);
}

TEST_CASE("all that acts on a coordinate includes the pressure") {
    const Machine machine = machine_from(oil +
                                         "[parameters.A]\nvalue = 1e-3\nunit = \"m^2\"\n[parameters.m]\nvalue = 1\nunit = \"kg\"\n"
                                         "[coordinates]\ns = { unit = \"m\", start = 0.1 }\n[bodies.piston]\nmass = \"m\"\nposition = [\"s\", 0, 0]\n"
                                         "[states]\np = { unit = \"bar\", start = 50 }\n[volumes.vessel]\nmedium = \"oil\"\nvolume = \"V + A*s\"\npressure = \"p\"\n"
                                         "[outputs]\nforce = { value = \"generalised_force[s]\" }\n");
    CHECK(written(machine, machine.system->outputs[0].value) == "A*p");
}

TEST_CASE("a chain of volumes as a family") {
    const Machine machine = machine_from(oil +
                                         "[states]\np = { unit = \"bar\", start = 50, for = \"k = 1..3\" }\nT = { unit = \"K\", start = 300, for = \"k = 1..3\" }\n"
                                         "[volumes.cell]\nfor = \"k = 1..3\"\nmedium = \"oil\"\nvolume = \"V\"\npressure = \"p[k]\"\ntemperature = \"T[k]\"\n"
                                         "[flows.between]\nfor = \"k = 1..2\"\nfrom = \"cell[k]\"\nto = \"cell[k+1]\"\nlaw = \"laminar\"\nconductance = \"G\"\n");
    CHECK(all_proven(*machine.system));
    CHECK(machine.system->fluids.flows.size() == 2);
    CHECK(machine.audit.balances.size() == 6);
}

TEST_CASE("a tank that is pressed empty by more than its own head ends there") {
    const auto guards = [](const std::string& pressure) {
        const Machine machine = machine_from("[parameters]\nrho = { value = 1000, unit = \"kg/m^3\", range = [1, 2000] }\ng = { value = 9.81, unit = \"m/s^2\", range = [1, 20] }\n"
                                             "p_0 = { value = 1, unit = \"bar\", range = [0.1, 10] }\nA = { value = 1, unit = \"m^2\", range = [0.1, 10] }\n"
                                             "[states]\nh = { unit = \"m\", start = 1 }\n[media.water]\nlaw = \"incompressible\"\ndensity = \"rho\"\n"
                                             "[reservoirs.ambient]\nmedium = \"water\"\npressure = \"p_0\"\n"
                                             "[volumes.tank]\nmedium = \"water\"\nvolume = \"A*h\"\nfilling = \"h\"\npressure = \"" + pressure + "\"\nhead = \"h\"\ngravity = \"g\"\n"
                                             "[flows.opening]\nfrom = \"tank\"\nto = \"ambient\"\nlaw = \"hydraulic_orifice\"\narea = \"0.001*A\"\ncoefficient = 1\n");
        CHECK(all_proven(*machine.system));
        return std::count_if(machine.system->guards.begin(), machine.system->guards.end(), [](const Guard& guard) { return guard.ends; });
    };
    CHECK(guards("p_0") == 0);
    CHECK(guards("2*p_0") == 1);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Networks of heat: what is derived, what is proven of them, and that no wrong sign passes the proofs.
#include <algorithm>

#include "graph/notation.hpp"
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "graph/field_code.hpp"
#include "elements/verdict.hpp"
#include "symbolic/functions.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string plate_and_room =
    "[parameters]\n"
    "C = { value = 200, unit = \"J/K\", range = [1, 1e4] }\n"
    "R = { value = 3, unit = \"K/W\", range = [0.01, 100] }\n"
    "A = { value = 0.2, unit = \"m^2\", range = [0.01, 10] }\n"
    "eps = { value = 0.7, unit = \"1\", range = [0.01, 1] }\n"
    "P = { value = 30, unit = \"W\", range = [1, 1000] }\n"
    "T_0 = { value = 293, unit = \"K\", range = [200, 400] }\n"
    "[states]\nT = { unit = \"K\", start = 300, range = [200, 1000] }\n"
    "[nodes]\nplate = { temperature = \"T\", capacity = \"C\", heat = \"P\" }\nlid = {}\nair = { temperature = \"T_0\" }\n";

bool proven_equal(const System& system, const ex& a, const ex& b) { return Prover(system).proven_equal(a, b); }

bool is_passive_network(const std::string& text) { return !machine_from(text).audit.eigenvalues.empty(); }

}  // namespace

TEST_CASE("a node that stores nothing has its temperature from its balance") {
    const Machine machine = machine_from(plate_and_room + "[links]\na = { from = \"plate\", to = \"lid\", resistance = \"R\" }\n"
            "b = { from = \"lid\", to = \"air\", resistance = \"2*R\" }\n");
    const System& system = *machine.system;
    CHECK(all_proven(system));
    const ex T = system.symbols.get(SymbolKind::state, 0);
    const auto parameter = [&](const char* name) { return system.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    CHECK(proven_equal(system, system.heat.find_node("lid")->warmth.temperature, (2 * T + parameter("T_0")) / 3));
    CHECK(proven_equal(system, system.state_rates[0], (parameter("P") - (T - parameter("T_0")) / (3 * parameter("R"))) / parameter("C")));
}

TEST_CASE("nodes that radiate and store nothing, one behind the other") {
    const std::string links =
        "[links]\na = { from = \"plate\", to = \"lid\", law = \"radiation\", emissivity = \"eps\", area = \"A\" }\n"
        "b = { from = \"lid\", to = \"air\", law = \"radiation\", emissivity = \"eps\", area = \"A\" }\n";
    SUBCASE("by radiation alone: fourth powers") {
        const Machine machine = machine_from(plate_and_room + links);
        const System& system = *machine.system;
        CHECK(all_proven(system));
        const ex T = system.symbols.get(SymbolKind::state, 0);
        const ex T_0 = system.symbols.find(SymbolKind::parameter, "T_0", 0)->symbol;
        CHECK(proven_equal(system, pow(system.heat.find_node("lid")->warmth.temperature, 4), (pow(T, 4) + pow(T_0, 4)) / 2));
    }
    SUBCASE("with convection too: the root of a*T^4 + T = b") {
        const Machine machine = machine_from(plate_and_room + links + "c = { from = \"lid\", to = \"air\", resistance = \"R\" }\n");
        CHECK(all_proven(*machine.system));
        CHECK(is_ex_the_function(machine.system->heat.find_node("lid")->warmth.temperature, radiant_temperature));
    }
}

TEST_CASE("heat along links into and out of volumes is counted once") {
    const std::string oil =
        "[parameters]\n"
        "rho_0 = { value = 850, unit = \"kg/m^3\", range = [500, 1500] }\nbeta = { value = 1.5e9, unit = \"Pa\", range = [1e8, 1e10] }\n"
        "c_v = { value = 1900, unit = \"J/(kg*K)\", range = [100, 5000] }\np_0 = { value = 1, unit = \"bar\", range = [0.1, 10] }\n"
        "T_0 = { value = 300, unit = \"K\", range = [200, 400] }\nV = { value = 1, unit = \"l\", range = [0.01, 100] }\n"
        "C = { value = 500, unit = \"J/K\", range = [1, 1e4] }\nR = { value = 2, unit = \"K/W\", range = [0.01, 100] }\n"
        "[states]\np = { unit = \"bar\", start = 50, range = [1, 400] }\nT_w = { unit = \"K\", start = 350, range = [250, 500] }\nSTATE\n"
        "[media.oil]\nlaw = \"liquid\"\ndensity = \"rho_0\"\nbulk_modulus = \"beta\"\nexpansion = \"1/(1000*T_0)\"\n"
                "isochoric_heat = \"c_v\"\n"
        "reference_pressure = \"p_0\"\nreference_temperature = \"T_0\"\n"
        "[reservoirs.ambient]\nmedium = \"oil\"\npressure = \"p_0\"\n"
        "[volumes.vessel]\nmedium = \"oil\"\nvolume = \"V\"\npressure = \"p\"\nTEMPERATURE\n"
        "[nodes]\nwall = { temperature = \"T_w\", capacity = \"C\" }\nair = { temperature = \"T_0\" }\n"
        "[links]\nin = { from = \"wall\", to = \"vessel\", resistance = \"R\" }\n"
                "out = { from = \"wall\", to = \"air\", resistance = \"3*R\" }\n"
        "side = { from = \"vessel\", to = \"ambient\", resistance = \"5*R\" }\n";
    for (const auto& [state, temperature] : {std::pair("T = { unit = \"K\", start = 300, range = [250, 500] }",
            "temperature = \"T\""), std::pair("", "isothermal = \"T_0\"")}) {
        std::string text = oil;
        text.replace(text.find("STATE"), 5, state);
        text.replace(text.find("TEMPERATURE"), 11, temperature);
        CAPTURE(temperature);
        CHECK(all_proven(*machine_from(text).system));
    }
}

TEST_CASE("no sign of a network can be wrong unseen") {
    for (const auto& [name, scene] : {std::pair("heat/voltage_regulator", "cooled"), std::pair("heat/fin", "convective"),
            std::pair("heat/friction_heat", "")}) {
        CAPTURE(name);
        Machine machine = machine_of(name, scene);
        System& system = *machine.system;
        REQUIRE(all_proven(system));
        for (ex& rate : system.state_rates) flipped_is_wrong(system, rate, "the rate of a state");
        for (LinkState& link : system.heat.links) flipped_is_wrong(system, link.heat, "link " + link.name);
        flipped_is_wrong(system, system.internal_energy, "the internal energy");
        flipped_is_wrong(system, system.exchanged_power, "the exchanged power");
        CHECK(all_proven(system));
    }
}

TEST_CASE("passive networks are known by the signs of their parts") {
    const std::string linear = plate_and_room + "[links]\na = { from = \"plate\", to = \"lid\", resistance = \"R\" }\n"
            "b = { from = \"lid\", to = \"air\", resistance = \"2*R\" }\n";
    CHECK(is_passive_network(linear));
    CHECK_FALSE(machine_of("heat/fin", "convective", {{"N", 200}}).audit.eigenvalues.empty());
    // Radiation is not linear; heat that grows with the temperature is not passive.
    CHECK_FALSE(is_passive_network(linear + "c = { from = \"plate\", to = \"air\", law = \"radiation\", emissivity = \"eps\", "
            "area = \"A\" }\n"));
    std::string heated = linear;
    heated.replace(heated.find("heat = \"P\""), 10, "heat = \"P*T/T_0\"");
    CHECK_FALSE(is_passive_network(heated));
    CHECK(is_passive_network(heated.replace(heated.find("P*T/T_0"), 7, "-P*T/T_0")));
    // A link whose sign is not known.
    CHECK_FALSE(is_passive_network(linear + "c = { from = \"plate\", to = \"air\", conductance = \"1/R - P/T_0\" }\n"));
}

void is_proven_and_a_wrong_one_is_seen(const Machine& machine) {
    const auto code = make_field_code(*machine.system);
    for (const AuditEntry& entry : verify_fields(*code)) CHECK(entry.result.verdict == Verdict::proven);
    FieldFunctions& field = code->fields[0];
    std::vector<FunctionCode*> all{&field.faces.back().heat, &field.faces.back().slopes, &field.cells.back().rate};
    for (SideFunctions& side : field.sides) all.push_back(&side.heat);
    for (FunctionCode* one : all) {
        const NodeId right = one->results.back();
        one->results.back() = one->program.negated(right);
        const auto entries = verify_fields(*code);
        CHECK(std::any_of(entries.begin(), entries.end(), [](const AuditEntry& entry) { return entry.result.verdict == Verdict::wrong; }));
        one->results.back() = right;
    }
}

TEST_CASE("the code of a cell is proven, and a wrong one is seen") {
    is_proven_and_a_wrong_one_is_seen(machine_of("heat/fin", "convective", {{"N", 200}}));
    const Machine plate = machine_of("../tests/physics/heat/plate", "looped");
    CHECK(plate.system->heat.fields[0].sides.size() == 8);
    is_proven_and_a_wrong_one_is_seen(plate);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes that store nothing and hold each other in balance: what is proven of them, and that a wrong sign does not pass.
#include <fmt/format.h>

#include <algorithm>

#include "elements/verdict.hpp"
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "graph/code.hpp"
#include "graph/verify.hpp"
#include "symbolic/network_functions.hpp"
#include "tier.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

/// Nodes between a room and the air, in any pattern of links.
std::string nodes(int count, const std::string& links) {
    return fmt::format(
               "[parameters]\n"
               "C = {{ value = 200, unit = \"J/K\", range = [1, 1e4] }}\n"
               "R = {{ value = 3, unit = \"K/W\", range = [0.01, 100] }}\n"
               "A = {{ value = 0.2, unit = \"m^2\", range = [0.01, 10] }}\n"
               "eps = {{ value = 0.7, unit = \"1\", range = [0.01, 1] }}\n"
               "P = {{ value = 30, unit = \"W\", range = [1, 1000] }}\n"
               "T_0 = {{ value = 293, unit = \"K\", range = [200, 400] }}\n"
               "[states]\nT = {{ unit = \"K\", start = 300, range = [200, 1000] }}\n"
               "[nodes]\nroom = {{ temperature = \"T\", capacity = \"C\" }}\nair = {{ temperature = \"T_0\" }}\n"
               "foil = {{ for = \"i = 1..{}\", heat = \"P*i\" }}\n[links]\n"
               "in = {{ from = \"room\", to = \"foil[1]\", resistance = \"R\" }}\nout = {{ from = \"foil[{}]\", to = \"air\", resistance = "
               "\"2*R\" }}\n",
               count, count) +
           links;
}

std::string chain(const char* name, int last, const char* law) {
    return fmt::format("{} = {{ for = \"i = 1..{}\", from = \"foil[i]\", to = \"foil[i+1]\", {} }}\n", name, last, law);
}
const char* const conducts = "resistance = \"R*i\"";
const char* const radiates = "law = \"radiation\", emissivity = \"eps\", area = \"A\"";

bool proven(const Machine& machine) {
    const auto good = [](const AuditEntry& entry) {
        if (entry.result.verdict != Verdict::proven) MESSAGE(entry.name, ": ", to_string(entry.result.verdict), " ", entry.result.reason);
        return entry.result.verdict == Verdict::proven;
    };
    const auto emitted = verify(*make_code(*machine.system));
    return machine.audit.all_proven() && std::all_of(emitted.begin(), emitted.end(), good);
}

bool has_network_function(const ex& e) { return std::any_of(e.preorder_begin(), e.preorder_end(), is_network_function); }

}  // namespace

TEST_CASE("short chains have a closed form, rings and long chains do not") {
    const Machine closed = machine_from(nodes(3, chain("a", 2, conducts)));
    CHECK(proven(closed));
    CHECK_FALSE(has_network_function(closed.system->state_rates[0]));
    for (const std::string& links : {chain("a", 11, conducts), chain("a", 11, radiates)}) {
        const Machine machine = machine_from(nodes(12, links));
        CHECK(proven(machine));
        CHECK(has_network_function(machine.system->state_rates[0]));
    }
    const Machine ring =
        machine_from(nodes(4, chain("a", 3, conducts) + "back = { from = \"foil[4]\", to = \"foil[1]\", resistance = \"5*R\" }\n" +
                                  "side = { from = \"foil[2]\", to = \"air\", resistance = \"7*R\" }\n"));
    CHECK(proven(ring));
}

TEST_CASE("nodes that conduct and radiate to each other") {
    const Machine machine = machine_from(nodes(3, chain("a", 2, conducts) + chain("b", 2, radiates)));
    CHECK(proven(machine));
    CHECK(has_network_function(machine.system->state_rates[0]));
    CHECK(machine.audit.eigenvalues.empty());
}

TEST_CASE("a network of nodes that store nothing is passive where its links are") {
    CHECK_FALSE(machine_from(nodes(6, chain("a", 5, conducts))).audit.eigenvalues.empty());
    CHECK(machine_from(nodes(6, chain("a", 5, conducts) + "b = { from = \"foil[2]\", to = \"foil[5]\", conductance = \"1/R - P/T_0\" }\n"))
              .audit.eigenvalues.empty());
}

TEST_CASE("the balance that defines a temperature is that of its node") {
    Machine machine = machine_from(nodes(3, chain("a", 2, conducts) + chain("b", 2, radiates)));
    System& system = *machine.system;
    REQUIRE(system.heat.defined.size() == 3);
    CHECK_FALSE(any_wrong(system));
    for (LinkState& link : system.heat.links) flipped_is_wrong(system, link.heat, link.name);
}

TEST_CASE("derivatives of a network are those of its balances" * doctest::skip(!is_full_tier())) {
    // dT/dp from the function against the linear system that the balances give when p changes.
    const Machine machine = machine_from(nodes(2, chain("a", 1, conducts) + chain("b", 1, radiates)));
    const System& system = *machine.system;
    for (const auto& [node, heat] : system.heat.defined)
        for (const char* name : {"R", "eps", "T_0"}) {
            CAPTURE(node->name);
            CAPTURE(name);
            const Variable& parameter = *system.symbols.find(SymbolKind::parameter, name, 0);
            // The balance stays zero, so its derivative does.
            CHECK(Prover(system).equal(system.symbols.derivative_by_parameter(heat, parameter.position), 0).verdict != Verdict::wrong);
        }
}

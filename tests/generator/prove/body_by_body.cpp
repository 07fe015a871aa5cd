// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia and gravity of chains and trees, one body at a time.
#include "prove/body_by_body.hpp"

#include "form/random_points.hpp"
#include "mechanics/dalembert.hpp"

#include "generator/machine.hpp"

using namespace dalembert;

namespace {

const std::vector<std::pair<std::string, std::map<std::string, int>>> chains{
    {"rods", {{"N", 5}}}, {"two_arms", {}}, {"free_base", {}}, {"leg", {}}};

bool is_proven(const System& system) {
    Prover prover(system);
    return BodyByBody(system, prover).inertia_is_proven();
}

}  // namespace

TEST_CASE("inertia of chains and trees is proven body by body") {
    for (const auto& [name, sizes] : chains) {
        CAPTURE(name);
        const Machine machine = chain_of(name, sizes);
        CHECK(is_proven(*machine.system));
        CHECK(machine.audit.all_proven());
    }
    CHECK(is_proven(*machine_of("arm_6r", "plain").system));
    CHECK(is_proven(*machine_of("n_pendulum", "", {{"N", 6}}).system));
    CHECK_FALSE(is_proven(*machine_of("cart_pendulum", "ideal").system));  // no chain: few coordinates
}

TEST_CASE("what is wrong in M, in energies or in a link is no proof body by body") {
    for (const auto& [name, sizes] : chains) {
        CAPTURE(name);
        const Machine machine = chain_of(name, sizes);
        System& system = *machine.system;
        REQUIRE(system.chain);
        const auto is_seen = [&](GiNaC::ex& value) {
            const GiNaC::ex right = std::exchange(value, 2 * value);
            REQUIRE_FALSE(right.is_zero());
            const bool result = !is_proven(system);
            value = right;
            return result;
        };
        CHECK(is_seen(system.mass(1, 1)));
        CHECK(is_seen(system.kinetic[1]));
        const auto moving = std::find_if(system.coriolis.begin(), system.coriolis.end(), [](const GiNaC::ex& e) { return !e.is_zero(); });
        REQUIRE(moving != system.coriolis.end());
        CHECK(is_seen(*moving));
        for (ChainLink& link : system.chain->links) {
            const auto each_is_seen = [&](auto& values) {
                for (GiNaC::ex& value : values)
                    if (!value.is_zero()) CHECK(is_seen(value));
            };
            for (auto& row : link.transfer)
                for (std::size_t k = 0; link.base && k < 6; ++k)  // of what never moves nothing is handed on
                    if (!row[k].is_zero() && !system.chain->links[*link.base].letters[k].second.is_zero()) CHECK(is_seen(row[k]));
            for (auto& direction : link.directions) each_is_seen(direction);
            for (auto& row : link.inertia) each_is_seen(row);
            each_is_seen(link.remainder);
            each_is_seen(link.force);
            for (auto& [letter, value] : link.letters)
                if (!value.is_zero()) CHECK(is_seen(value));
        }
        CHECK(is_proven(system));
    }
}

TEST_CASE("gravity of bodies on bodies that turn in space is proven without what is between them") {
    const Machine machine = machine_of("arm_6r", "plain");
    System& system = *machine.system;
    Prover prover(system);
    const auto is_proven = [&](std::size_t potential) { return BodyByBody(system, prover).gravity_is_proven(potential); };
    int proven = 0;
    for (std::size_t i = 0; i < system.potentials.size(); ++i) {
        Potential& p = system.potentials[i];
        if (!is_proven(i)) continue;
        ++proven;
        const GiNaC::ex energy = std::exchange(p.energy, 2 * p.energy);
        CHECK_FALSE(is_proven(i));
        p.energy = energy;
        for (GiNaC::ex& force : p.force) {
            const GiNaC::ex right = std::exchange(force, force + 1);
            CHECK_FALSE(is_proven(i));
            force = right;
        }
    }
    CHECK(proven >= 3);
}

TEST_CASE("M and forces of composite bodies are sums over bodies") {
    for (const auto& machine : {chain_of("leg"), machine_of("drives/quadcopter")}) {
        System& system = *machine.system;
        REQUIRE(system.composites);
        const InertialForces sums = ::dalembert::dalembert(system.bodies, system.symbols);
        std::vector<GiNaC::ex> differences;
        for (unsigned i = 0; i < system.symbols.degrees(); ++i) {
            for (unsigned j = 0; j < system.symbols.degrees(); ++j) differences.push_back(system.mass(i, j) - sums.mass(i, j));
            differences.push_back(system.coriolis[i] - sums.coriolis[i]);
            GiNaC::ex gravity = 0;
            for (const Potential& p : system.potentials)
                if (p.body) gravity += p.force[i];
            differences.push_back(system.gravity[i] - gravity);
        }
        RandomPoints points(system);
        for (int k = 0; k < 3; ++k)
            for (ValuesAtPoint value_of(system.symbols, points.next(), 60); const GiNaC::ex& difference : differences) {
                const auto value = value_of(difference);
                REQUIRE(value);
                CHECK(cln::abs(*value) < cln::expt(cln::cl_RA(10), -50));
            }
    }
}

TEST_CASE("what is wrong in gravity of composite bodies is seen") {
    const Machine machine = chain_of("leg");
    System& system = *machine.system;
    Prover prover(system);
    const auto is_proven = [&] { return BodyByBody(system, prover).total_gravity_is_proven(); };
    CHECK(is_proven());
    const auto is_seen = [&](GiNaC::ex& value) {
        const GiNaC::ex right = std::exchange(value, value + 1);
        const bool result = !is_proven();
        value = right;
        return result;
    };
    for (GiNaC::ex& force : system.gravity) CHECK(is_seen(force));
    for (Potential& p : system.potentials)
        if (p.body)
            for (GiNaC::ex& force : p.force) CHECK(is_seen(force));
    CHECK(is_proven());
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia and gravity of chains and trees, one body at a time.
#include "prove/body_by_body.hpp"

#include "generator/machine.hpp"

using namespace dalembert;

namespace {

const std::vector<std::pair<std::string, std::map<std::string, int>>> chains{{"rods", {{"N", 5}}}, {"two_arms", {}}, {"free_base", {}}};

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
    const BodyByBody bodies(system, prover);
    int proven = 0;
    for (Potential& p : system.potentials) {
        if (!bodies.gravity_is_proven(p)) continue;
        ++proven;
        const GiNaC::ex energy = std::exchange(p.energy, 2 * p.energy);
        CHECK_FALSE(bodies.gravity_is_proven(p));
        p.energy = energy;
        for (GiNaC::ex& force : p.force) {
            const GiNaC::ex right = std::exchange(force, force + 1);
            CHECK_FALSE(bodies.gravity_is_proven(p));
            force = right;
        }
    }
    CHECK(proven >= 3);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Motions that are solved for from body to body.
#include <algorithm>

#include "elements/verdict.hpp"
#include "generator/machine.hpp"
#include "graph/verify.hpp"
#include "graph/verify_links.hpp"
#include "prove/audit.hpp"
#include "tier.hpp"

using namespace dalembert;

namespace {

std::unique_ptr<Code> body_to_body(const System& system) {
    return make_code(system, {.passes = {.rewriting = false}, .chain = ChainUse::wherever_possible});
}

Verdict worst_of(const Code& code) {
    Verdict worst = Verdict::proven;
    for (const AuditEntry& entry : verify(code))
        if (is_worse(entry.result.verdict, worst)) worst = entry.result.verdict;
    return worst;
}

const std::string six_coordinates =
    "[parameters]\nm = { value = 1, unit = \"kg\" }\n[coordinates]\na = { for = \"k = 1..6\", unit = \"m\" }\n";

}  // namespace

TEST_CASE("operations of a chain grow with its links") {
    const auto count = [](int n, Function function) {
        const Machine machine = machine_of("n_pendulum", "", {{"N", n}});
        return make_code(*machine.system)->count(function).total();
    };
    for (const Function function : {Function::rhs, Function::rhs_and_jacobian, Function::jacobian_p}) {
        CAPTURE(name_of(function));
        const int ten = count(10, function), fourteen = count(14, function), eighteen = count(18, function);
        CHECK(eighteen - fourteen == fourteen - ten);
    }
}

TEST_CASE("chains and trees in the plane and in space are proven") {
    for (const auto& [name, sizes] :
         std::vector<std::pair<std::string, std::map<std::string, int>>>{
             {"rods", {{"N", 4}}}, {"two_arms", {}}, {"free_base", {}}, {"leg", {}}}) {
        CAPTURE(name);
        const Machine machine = chain_of(name, sizes);
        REQUIRE(machine.system->chain);
        const auto code = body_to_body(*machine.system);
        REQUIRE((*code)[Function::rhs].chain);
        REQUIRE((*code)[Function::jacobian_p].loop);
        CHECK(worst_of(*code) == Verdict::proven);
    }
}

TEST_CASE("a chain whose masses do not change with its motion is proven, too" * doctest::skip(!is_full_tier())) {
    const Machine machine = machine_from(
        six_coordinates + "[bodies.block]\nfor = \"k = 1..6\"\non = \"block[k-1]\"\nmass = \"m\"\nposition = [\"a[k]\", 0, 0]\n");
    const auto code = body_to_body(*machine.system);
    CHECK((*code)[Function::rhs].chain);
    CHECK(worst_of(*code) == Verdict::proven);
}

TEST_CASE("what is wrong in code from body to body is seen") {
    const Machine machine = chain_of("two_arms");
    const auto is_seen = [&](const auto& spoil) {
        const auto code = body_to_body(*machine.system);
        spoil(*code);
        return worst_of(*code) == Verdict::wrong;
    };
    CHECK_FALSE(is_seen([](Code&) {}));
    const auto doubled = [](FunctionCode& f, NodeId& id) { id = f.program.sum({{false, id}, {false, id}}); };
    CHECK(is_seen([&](Code& code) { doubled(code[Function::rhs], code[Function::rhs].chain->links[2].inertia[3][3]); }));
    CHECK(is_seen([&](Code& code) { doubled(code[Function::rhs], code[Function::rhs].chain->links[3].transfer[4][4]); }));
    CHECK(is_seen([&](Code& code) { doubled(code[Function::rhs], code[Function::rhs].chain->loads.ground[5]); }));
    CHECK(is_seen([&](Code& code) { doubled(code[Function::jacobian_u], code[Function::jacobian_u].loop->loads.rest[1]); }));
    // Of the solve, which is not M*x = b then.
    CHECK(is_seen([&](Code& code) { doubled(code[Function::rhs], code[Function::rhs].accelerations[4]); }));
    CHECK(is_seen([&](Code& code) { doubled(code[Function::rhs_and_jacobian], code[Function::rhs_and_jacobian].chain->inverses[2]); }));
    CHECK(is_seen([&](Code& code) { doubled(code[Function::jacobian_u], code[Function::jacobian_u].loop->results[0]); }));
}

TEST_CASE("what is wrong in the slopes of a link is seen in the letters of the links") {
    const Machine machine = chain_of("two_arms");
    const auto code = body_to_body(*machine.system);
    Prover prover(*machine.system);
    const std::map<Function, By> functions{{Function::rhs_and_jacobian, By::state}, {Function::jacobian_p, By::parameter}};
    for (const auto& [function, by] : functions) {
        CAPTURE(name_of(function));
        const FunctionCode& f = (*code)[function];
        const By columns = by;
        const ChainSlopes<GiNaC::ex> derived = chain_slopes(*machine.system, {by});
        REQUIRE(f.loop);
        // How many values differ, at points.
        const auto differing = [&](const ChainSlopes<GiNaC::ex>& slopes) {
            int wrong = 0;
            SumBySum by_sums(prover, machine.system->symbols);
            LinkProof proof(f, *code, cached_meaning(*code), prover, by_sums,
                            [&](const Prover::Evaluation& evaluate, const GiNaC::ex& emitted, const GiNaC::ex& meant) {
                                if (++wrong == 1) CHECK(prover.compare_at_points(evaluate, emitted, meant).verdict == Verdict::wrong);
                            });
            proof.links();
            proof.columns(slopes, columns);
            return wrong;
        };
        CHECK(differing(derived) == 0);
        const auto doubled = [&](const auto& slopes_of) {
            ChainSlopes<GiNaC::ex> slopes = derived;
            for (ChainSlope<GiNaC::ex>& slope : slopes_of(slopes.links[3]))
                for (auto* values : {&slope.letters, &slope.parts})
                    for (GiNaC::ex& value : *values) value *= 2;
            return differing(slopes);
        };
        CHECK(doubled([](LinkSlopes<GiNaC::ex>& link) -> auto& { return link.by_base; }) > 0);
        CHECK(doubled([](LinkSlopes<GiNaC::ex>& link) -> auto& { return link.by_own; }) > 0);
        CHECK(doubled([&](LinkSlopes<GiNaC::ex>& link) -> auto& { return link.by[static_cast<std::size_t>(columns)]; }) > 0);
    }
}

TEST_CASE("composite bodies that are not those of the links prove no code") {
    const Machine machine = chain_of("leg");
    System& system = *machine.system;
    REQUIRE(system.composites);
    CHECK(worst_of(*body_to_body(system)) == Verdict::proven);
    GiNaC::ex& transfer = system.chain->links.back().transfer[3][3];
    REQUIRE_FALSE(transfer.is_zero());
    transfer *= 2;
    CHECK(worst_of(*body_to_body(system)) == Verdict::wrong);
}

TEST_CASE("what acts on bodies far out is handed on, with the power that it has there") {
    const Machine machine = chain_of("leg");
    System& system = *machine.system;
    std::size_t handed_on = 0;
    Prover prover(system);
    for (const Supply& supply : system.supplies) {
        handed_on += supply.wrenches.size();
        for (std::size_t j = 0; j < system.symbols.degrees(); ++j)
            CHECK(prover.equal(supply.force[j], partial(supply.power, system.symbols.get(SymbolKind::velocity, j))).verdict ==
                  Verdict::proven);
    }
    CHECK(handed_on == 5);
    CHECK(audit(system).power_balance.result.verdict == Verdict::proven);
    const auto jet = std::find_if(system.supplies.begin(), system.supplies.end(), [](const Supply& s) { return s.name == "force jet"; });
    system.supplied_power += jet->power;
    jet->power *= 2;
    CHECK(audit(system).power_balance.result.verdict == Verdict::wrong);
}

TEST_CASE("bodies that are not placed on each other, or share a coordinate, are no chain") {
    const auto has_chain = [](const std::string& bodies) { return machine_from(six_coordinates + bodies).system->chain.has_value(); };
    CHECK(has_chain("[bodies.block]\nfor = \"k = 1..6\"\non = \"block[k-1]\"\nmass = \"m\"\nposition = [\"a[k]\", 0, 0]\n"));
    CHECK(has_chain("[bodies.block]\nfor = \"k = 1..6\"\nmass = \"m\"\nposition = [\"a[k]\", 0, 0]\n"));
    CHECK_FALSE(has_chain("[bodies.block]\nfor = \"k = 1..6\"\nmass = \"m\"\nposition = [\"sum(j, 1, k, a[j])\", 0, 0]\n"));
    CHECK(chain_of("free_base").system->chain);
    CHECK_FALSE(machine_of("four_bar").system->chain);
    CHECK_FALSE(machine_of("n_pendulum", "", {{"N", 3}}).system->chain);  // few coordinates are solved for at once
}

TEST_CASE("solving with M can be had instead") {
    const Machine machine = machine_of("n_pendulum", "", {{"N", 9}});
    CHECK((*make_code(*machine.system))[Function::rhs].chain);
    const auto code = make_code(*machine.system, {.chain = ChainUse::never});
    CHECK_FALSE((*code)[Function::rhs].chain);
    CHECK(worst_of(*code) == Verdict::proven);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs in letters for sums that are kept whole, and the numbers by which sums are found to be alike.
#include "prove/sum_by_sum.hpp"

#include "generator/machine.hpp"
#include "symbolic/functions.hpp"

using namespace dalembert;
using GiNaC::cos;
using GiNaC::ex;
using GiNaC::pow;
using GiNaC::sin;

namespace {

const std::string letters =
    "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\na = { unit = \"rad\" }\nb = { unit = \"rad\" }\n"
    "[parameters]\nm = { value = 1, unit = \"kg\" }\n[bodies]\np = { mass = \"m\", position = [\"x\", \"y\", 0] }\n"
    "q = { mass = \"m\", position = [\"a*(1 m)\", \"b*(1 m)\", 0] }\n";

struct TwoAngles {
    Machine machine = machine_from(letters);
    const System& system = *machine.system;
    ex x = symbol_named(system, SymbolKind::coordinate, "x"), y = symbol_named(system, SymbolKind::coordinate, "y"),
       a = symbol_named(system, SymbolKind::coordinate, "a"), b = symbol_named(system, SymbolKind::coordinate, "b");
    Prover prover{system};
    SumBySum sums{prover, system.symbols};
};

}  // namespace

TEST_CASE("sums that are alike are one letter, whatever is between them") {
    TwoAngles l;
    const ex inner = whole(l.x * cos(l.a) + l.y * sin(l.a)), other = whole(l.y * sin(l.a) + l.x * cos(l.a));
    const ex derived = whole(inner * cos(l.b) + l.y) * inner;
    CHECK(l.sums.proven_equal(whole(other * cos(l.b) + l.y) * other, derived));
    CHECK(l.sums.proven_equal(-whole(-other * cos(l.b) - l.y) * other, derived));
    CHECK(l.sums.proven_equal((l.y + cos(l.b) * (l.x * cos(l.a) + l.y * sin(l.a))) * inner, derived));
    CHECK_FALSE(l.sums.proven_equal(whole(other * cos(l.b) - l.y) * other, derived));
    CHECK_FALSE(l.sums.proven_equal(2 * derived, derived));
}

TEST_CASE("the length of a vector stays what it is when it is turned, however often") {
    TwoAngles l;
    std::array<ex, 2> v{l.x, l.y};
    for (int i = 0; i < 12; ++i) {
        const ex& angle = i % 2 == 0 ? l.a : l.b;
        v = {whole(cos(angle) * v[0] - sin(angle) * v[1]), whole(sin(angle) * v[0] + cos(angle) * v[1])};
    }
    CHECK(l.sums.proven_equal(pow(l.x, 2) + pow(l.y, 2), pow(v[0], 2) + pow(v[1], 2)));
    CHECK_FALSE(l.sums.proven_equal(pow(l.x, 2) - pow(l.y, 2), pow(v[0], 2) + pow(v[1], 2)));
}

TEST_CASE("what is zero and is divided by is no letter") {
    TwoAngles l;
    const ex zero = whole(pow(sin(l.a), 2) + pow(cos(l.a), 2) - 1);
    CHECK_FALSE(l.sums.proven_equal(1, zero / whole(1 - pow(sin(l.a), 2) - pow(cos(l.a), 2))));
    CHECK_FALSE(l.sums.proven_equal(whole(zero * l.x + l.y) / zero, whole(zero * l.x + l.y) / zero + 1));
}

TEST_CASE("fingerprints are the same for what is equal, and tell most else apart") {
    TwoAngles l;
    Fingerprints print(l.system.symbols);
    const auto are_alike = [&](const ex& one, const ex& other) { return print(one) == print(other); };
    CHECK(are_alike(pow(sin(l.a), 2) + pow(cos(l.a), 2), 1));
    CHECK(are_alike(cos(2 * l.a - l.b), cos(l.b) * (1 - 2 * pow(sin(l.a), 2)) + sin(l.b) * 2 * sin(l.a) * cos(l.a)));
    CHECK(are_alike(sin(l.a / 2) * cos(l.a / 2), sin(l.a / 2) * cos(-l.a / 2)));
    CHECK(are_alike(pow(l.x + l.y, 3) / (l.x + l.y), pow(l.x, 2) + 2 * l.x * l.y + pow(l.y, 2)));
    CHECK(are_alike(GiNaC::numeric(1, 3) * l.x + l.x / 6, l.x / 2));
    CHECK(are_alike(whole(l.x - l.y), -whole(l.y - l.x)));
    CHECK_FALSE(are_alike(l.x, l.y));
    CHECK_FALSE(are_alike(sin(l.a), sin(l.b)));
    CHECK_FALSE(are_alike(GiNaC::exp(l.x), GiNaC::exp(l.y)));
    CHECK_FALSE(are_alike(GiNaC::sqrt(l.x), l.x));
    const Machine machine =
        machine_from("[attitudes.e]\nstart_rate = [1, 2, 3]\n[parameters]\nJ = { value = 1, unit = \"kg*m^2\" }\n"
                     "[bodies]\np = { origin = [0, 0, 0], attitude = \"e\", inertia = [\"J\", \"J\", \"J\"] }\n");
    Fingerprints of_attitude(machine.system->symbols);
    ex squares = 0;
    for (const std::size_t part : machine.system->symbols.attitudes().front().parts)
        squares += pow(machine.system->symbols.get(SymbolKind::state, part), 2);
    CHECK(of_attitude(squares) == of_attitude(1));
}

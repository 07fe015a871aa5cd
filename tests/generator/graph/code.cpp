// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/code.hpp"

#include <set>
#include <utility>

#include "generator/machine.hpp"
#include "graph/extract.hpp"
#include "graph/factorisation.hpp"
#include "graph/lower.hpp"
#include "graph/notation.hpp"
#include "graph/verify.hpp"
#include "graph/verify_solve.hpp"
#include "symbolic/functions.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

int operations(const std::string& system, const std::string& scene, Function function, const std::map<std::string, int>& sizes = {}) {
    const Machine machine = machine_of(system, scene, sizes);
    return make_code(*machine.system)->count(function).total();
}

}  // namespace

TEST_CASE("what the emitted code costs") {
    // Upper bounds: whoever makes them smaller may lower them, nobody may raise them unnoticed.
    CHECK(operations("pendulum", "", Function::rhs) <= 4);
    CHECK(operations("cart_pendulum", "ideal", Function::rhs) <= 22);
    CHECK(operations("cart_pendulum", "lab", Function::rhs) <= 24);
    CHECK(operations("cart_pendulum", "lab", Function::rhs_and_jacobian) <= 50);
    CHECK(operations("spherical_pendulum", "free", Function::rhs) <= 16);
    CHECK(operations("ball_on_beam", "", Function::rhs) <= 28);
    CHECK(operations("n_pendulum", "", Function::rhs, {{"N", 2}}) <= 31);
    CHECK(operations("n_pendulum", "", Function::rhs, {{"N", 3}}) <= 78);
    CHECK(operations("n_pendulum", "", Function::rhs, {{"N", 12}}) <= 619);
    CHECK(operations("n_pendulum", "", Function::rhs_and_jacobian, {{"N", 12}}) <= 1148);
    CHECK(operations("hydraulics/hydraulic_cylinder", "real", Function::rhs) <= 122);
    CHECK(operations("hydraulics/hydraulic_cylinder", "real", Function::rhs_and_jacobian) <= 338);
    CHECK(operations("heat/immersion_heater", "heating", Function::jacobian_p) <= 52);  // resistances in a row are added
}

TEST_CASE("a pivot that does not change comes first, so that the ball on the beam divides once") {
    const Machine machine = machine_of("ball_on_beam");
    CHECK(make_code(*machine.system)->count(Function::rhs).divisions == 1);
}

TEST_CASE("rates, Jacobian, outputs and energies together share what they have in common") {
    struct Case {
        const char *system, *scene;
        std::map<std::string, int> sizes = {};
    };
    for (const Case& one : {Case{"cart_pendulum", "lab"}, {"n_pendulum", "", {{"N", 3}}}, {"n_pendulum", "", {{"N", 8}}},
                            {"n_pendulum", "", {{"N", 12}}}, {"slider_crank", ""}, {"hydraulics/valve_cylinder", "smooth"},
                            {"heat/fin", ""}}) {
        CAPTURE(one.system);
        const Machine machine = machine_of(one.system, one.scene, one.sizes);
        const auto code = make_code(*machine.system, {.functions = {Function::together}});
        const auto angles = [&](Function f) { return code->count(f).trigonometric; };
        CHECK(angles(Function::together) <= std::max(angles(Function::rhs_and_jacobian), angles(Function::output)));
        const auto verdict = [&] {
            for (const AuditEntry& entry : verify(*code))
                if (entry.name == "emitted = derived, together") return entry.result.verdict;
            return Verdict::wrong;
        };
        CHECK(verdict() == Verdict::proven);
        // An output or an energy that is another value is seen.
        std::vector<NodeId>& results = (*code)[Function::together].results;
        const std::size_t rates = machine.system->state_rates.size();
        REQUIRE(results.size() == rates + machine.system->outputs.size() + 3);
        for (std::size_t i = rates; i < results.size(); ++i) {
            const NodeId right = std::exchange(results[i], (*code)[Function::together].program.constant(7));
            CHECK(verdict() == Verdict::wrong);
            results[i] = right;
        }
    }
    CHECK_FALSE(make_code(*machine_of("cart_pendulum").system)->wished.contains(Function::together));
}

TEST_CASE("a solve with a defect is not proven") {
    const Machine machine = machine_from(block);
    const Atoms atoms(machine.system->symbols);
    // Rows of the lower triangle of M, x where it is not zero; the last ones are those of constraints.
    struct Case {
        std::vector<std::string> rows;
        std::size_t constraints;
    };
    for (const Case& one : {Case{{"x", "xx", "xxx"}, 0}, {{"x", "0x", "xxx", "0x0x", "x0xxx"}, 0}, {{"x", "xx", "0xx", "00xx"}, 0},
                            {{"x", "0x", "00x", "xx00", "0xx00"}, 2}}) {
        const std::size_t n = one.rows.size();
        std::vector<bool> is_zero;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j) is_zero.push_back(one.rows[i][j] != 'x');
        Program program;
        SolveNodes nodes = solve_in_letters(program, n, one.constraints, is_zero);
        const auto verdict = [&] { return solve_gives_solution(program, nodes, n, one.constraints, is_zero, atoms).verdict; };
        CHECK(verdict() == Verdict::proven);
        std::set<std::size_t> on_diagonal;
        for (std::size_t i = 0; i < n; ++i) on_diagonal.insert(lower_index(i, i));
        for (auto* part : {&nodes.scaled, &nodes.factors, &nodes.halfway, &nodes.solved})
            for (std::size_t k = 0; k < part->size(); ++k) {
                if (part == &nodes.scaled && on_diagonal.contains(k)) continue;
                const NodeId right = std::exchange((*part)[k], program.sum({{false, (*part)[k]}, {true, program.constant(7)}}));
                CHECK(verdict() == Verdict::wrong);
                (*part)[k] = right;
            }
    }
}

TEST_CASE("columns with one entry in the same row are solved together") {
    Program program;
    const NodeId a = program.cached(0), b = program.cached(1), zero = program.constant(0), one = program.constant(1);
    const std::vector<NodeId> factors = factorise(program, 2, 0, {a, b, b, a});
    const auto columns = solve_columns(program, 2, factors, {{a, zero}, {b, zero}, {a, b}, {zero, a}, {zero, b}});
    const std::vector<NodeId> unit = solve(program, 2, factors, {one, zero});
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(columns[0][i] == program.product({unit[i], a}));
        CHECK(columns[1][i] == program.product({unit[i], b}));
    }
    CHECK(columns[2] == solve(program, 2, factors, {a, b}));
    CHECK(columns[3] == solve(program, 2, factors, {zero, a}));
    // The same column twice is computed once anyway.
    CHECK(solve_columns(program, 2, factors, {{a, zero}, {a, zero}})[1] == solve(program, 2, factors, {a, zero}));
}

TEST_CASE("sine squared and cosine squared are folded, also through two angles") {
    const Machine machine = machine_of("spherical_pendulum", "free");
    const auto code = make_code(*machine.system);
    // M = diag(m l^2, m l^2 sin^2(theta)): no trace of phi.
    CHECK(code->count(Function::mass_matrix).total() <= 3);
}

TEST_CASE("sine and cosine of an angle are computed once") {
    const Machine machine = machine_of("n_pendulum", "", {{"N", 4}});
    CHECK(make_code(*machine.system)->count(Function::rhs_and_jacobian).trigonometric == 8);
}

TEST_CASE("the larger and the smaller of two with one factor are their sum") {
    const Machine machine = machine_from(block);
    const Symbols& symbols = machine.system->symbols;
    const ex x = symbols.get(SymbolKind::coordinate, 0), v = symbols.get(SymbolKind::velocity, 0);
    const ex m = symbols.get(SymbolKind::parameter, 0);
    Atoms atoms(symbols);
    const auto same = [&](const ex& a, const ex& b) { return lower(a, atoms) == lower(b, atoms); };
    CHECK(same(m * maximum(x, v) + m * minimum(x, v), m * (x + v)));
    CHECK(same(2 * maximum(x, 0) * v + 2 * minimum(0, x) * v, 2 * x * v));
    CHECK_FALSE(same(m * maximum(x, v) + minimum(x, v), m * (x + v)));
    CHECK_FALSE(same(maximum(x, v) - minimum(x, v), x + v));
    CHECK_FALSE(same(maximum(x, v) * minimum(x, v), x * v));  // it is, but of another rule
}

TEST_CASE("quarters and eighths of powers are roots of roots, and whole exponents need no other power") {
    const Machine machine = machine_from(block);
    const Symbols& symbols = machine.system->symbols;
    const ex x = symbols.get(SymbolKind::coordinate, 0), m = symbols.get(SymbolKind::parameter, 0);
    const auto to_the = [](const ex& base, int numerator, int denominator) { return pow(base, GiNaC::numeric(numerator, denominator)); };
    Atoms atoms(symbols);
    const auto product = [&](const ex& a, const ex& b) { return Polynomial::product(lower(a, atoms), lower(b, atoms), SIZE_MAX); };
    for (const ex& base : {x, x + m}) {
        CAPTURE(base);
        for (const int denominator : {4, 8}) {
            const Polynomial root = lower(to_the(base, 1, denominator), atoms);
            REQUIRE(root.is_monomial());
            const LetterPower letter = root.terms().begin()->first.front();
            CHECK(atoms[letter.letter].op == Op::sqrt);
            CHECK(lower(to_the(base, -3, denominator), atoms) == Polynomial::letter(letter.letter, -3));
            CHECK(lower(to_the(base, -denominator - 1, denominator), atoms) == product(1 / base, to_the(base, -1, denominator)));
        }
        CHECK(lower(to_the(base, -6, 5), atoms) == product(1 / base, to_the(base, -1, 5)));
        CHECK_FALSE(lower(to_the(base, 3, 4), atoms) == lower(to_the(base, 1, 4), atoms));
    }
    CHECK(lower(to_the(x, 5, 4), atoms) == product(x, to_the(x, 1, 4)));
    CHECK(lower(to_the(x, 9, 5), atoms) == product(x, to_the(x, 4, 5)));
    CHECK(Notation(symbols, Style::text)(to_the(x + m, -5, 4)) == "(m + x)^(-5/4)");
}

TEST_CASE("a sum that is zero once it is multiplied out: its square is zero, and a fraction of it has no value") {
    const Machine machine = machine_from(block);
    const Symbols& symbols = machine.system->symbols;
    const ex x = symbols.get(SymbolKind::coordinate, 0), m = symbols.get(SymbolKind::parameter, 0);
    const ex c = symbols.get(SymbolKind::parameter, 1);
    const ex nothing = m * (m + c) - m * m - m * c;
    Atoms atoms(symbols);
    CHECK(lower(x + pow(nothing, 2), atoms) == lower(x, atoms));
    CHECK(lower(x * whole(nothing), atoms).is_zero());
    CHECK_THROWS_AS(lower(x / nothing, atoms), GiNaC::pole_error);
}

TEST_CASE("a voltage divider whose rest is nothing: the square of what vanishes is proven to vanish") {
    Machine machine = machine_from("[parameters]\nR_1 = { value = 10, unit = \"Ohm\", range = [1, 100] }\n"
                                   "R_2 = { value = 10, unit = \"Ohm\", range = [1, 100] }\nT = { value = 1, unit = \"s\" }\n"
                                   "[states]\nu = { unit = \"V\", start = 2, derivative = \"-u/T\" }\n"
                                   "[outputs]\ng = { value = \"(u - u*R_1/(R_1 + R_2) - u*R_2/(R_1 + R_2))^2\", unit = \"V^2\" }\n");
    (void)generate(machine);
    CHECK(proofs_of(machine).all_proven());
}

TEST_CASE("the sign of a difference in a denominator does not depend on how it is written") {
    const auto machine = [](const char* law) {
        return machine_from("[parameters]\nm = { value = 1, unit = \"kg\" }\nk = { value = 1, unit = \"N*m\" }\n"
                            "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\n"
                            "[bodies.a]\nmass = \"m\"\nposition = [\"x\", \"y\", 0]\n"
                            "[generalised_forces.f]\ncoordinate = \"x\"\nforce = \"" + std::string(law) + "\"\n");
    };
    Machine one = machine("k/(x - y)");
    Machine two = machine("-k/(y - x)");
    CHECK(generate(one).text == generate(two).text);
}

TEST_CASE("common sums and products are found across functions") {
    // f = a*c + b*c, g = a*d + b*d: (a + b) is computed once.
    Network network{10, {{{1, {0, 2}}, {1, {1, 2}}}, {{1, {0, 3}}, {1, {1, 3}}}}};
    extract(network);
    REQUIRE(network.functions.size() == 3);
    CHECK(network.functions[0].size() == 1);
    CHECK(network.functions[1].size() == 1);
    CHECK(network.functions[2].size() == 2);
    // 2ac - 2bc and 3ad - 3bd share a - b too.
    Network scaled{10, {{{2, {0, 2}}, {-2, {1, 2}}}, {{3, {0, 3}}, {-3, {1, 3}}}}};
    extract(scaled);
    CHECK(scaled.functions.size() == 3);
    // Nothing in common: nothing is added.
    Network different{10, {{{1, {0}}, {1, {1}}}, {{1, {2}}, {1, {3}}}}};
    extract(different);
    CHECK(different.functions.size() == 2);
}

namespace {

/// Every place from which something is emitted is made wrong, one after the other; each must be noticed. `wished`: of these functions
/// alone.
void check_every_defect(const System& system, const std::set<Function>& wished = {}) {
    const auto good = make_code(system, {.functions = wished});
    CHECK(good->wished == wished);
    for (const AuditEntry& entry : verify(*good)) CHECK(entry.result.verdict == Verdict::proven);
    for (std::size_t i = 0; i < function_count; ++i) {
        const auto function = static_cast<Function>(i);
        if (!wished.empty() && !wished.contains(function)) continue;
        const auto lists = [&](FunctionCode& f) {
            std::vector<std::vector<NodeId>*> all{&f.results, &f.below.entries, &f.by_output.entries, &f.by_acceleration.entries};
            if (f.by_loops) all.insert(all.end(), {&f.mass, &f.force, &f.right.entries});
            else all.insert(all.end(), {&f.accelerations, &f.solved.entries});
            if (!f.second) return all;
            FunctionCode::SecondOrder& second = *f.second;
            all.insert(all.end(), {&f.right.entries, &second.right, &second.solved, &second.direct, &second.mixed.entries});
            return all;
        };
        for (std::size_t list = 0; list < lists((*good)[function]).size(); ++list) {
            const std::size_t count = lists((*good)[function])[list]->size();
            for (std::size_t k = 0; k < count; ++k) {
                const auto code = make_code(system, {.functions = wished});
                FunctionCode& f = (*code)[function];
                NodeId& node = (*lists(f)[list])[k];
                node = f.program.sum({{false, node}, {false, f.program.constant(1)}});
                bool found = false;
                for (const AuditEntry& entry : verify(*code)) found = found || entry.result.verdict != Verdict::proven;
                INFO(name_of(function), ", list ", list, ", entry ", k);
                CHECK(found);
            }
        }
    }
}

}  // namespace

TEST_CASE("a defect anywhere in the code is found") {
    check_every_defect(*machine_of("cart_pendulum", "lab").system);
    check_every_defect(*machine_of("coupled_springs", "full").system);  // M is constant, its factors are cached
    check_every_defect(*machine_of("drive_train", "damped").system);
}

TEST_CASE("a defect anywhere in the slopes of outputs by parameters and time is found") {
    for (const char* name : {"cart_pendulum", "coupled_springs", "spherical_pendulum_xyz"}) {
        CAPTURE(name);
        check_every_defect(*machine_of(name).system, {Function::output_jacobian_p, Function::output_jacobian_t});
    }
}

TEST_CASE("a defect anywhere in the code of second derivatives is found") {
    for (const char* name : {"cart_pendulum", "coupled_springs", "spherical_pendulum_xyz"}) {
        CAPTURE(name);
        check_every_defect(*machine_of(name).system, {Function::hessian});
    }
}

TEST_CASE("large chains solve by loops, diagonal ones never") {
    const auto chain = [](int n) {
        return machine_from("[sizes]\nN = 3\n[parameters]\nm = { value = 1, unit = \"kg\" }\nc = { value = 1, unit = \"N/m\" }\n"
                            "[coordinates]\nx = { for = \"k = 1..N\", unit = \"m\" }\n"
                            "[bodies.b]\nfor = \"k = 1..N\"\nmass = \"m\"\nposition = [\"x[k]\", 0, 0]\n"
                            "[springs.s]\nfor = \"k = 1..N-1\"\nelongation = \"x[k+1] - x[k]\"\nstiffness = \"c\"\n",
                            "", {{"N", n}});
    };
    const Machine machine = chain(20);
    const auto code = make_code(*machine.system);
    CHECK(code->solve.unrolled);
    CHECK(code->solve.is_constant);
    CHECK(code->count(Function::rhs).divisions == 0);
    CHECK_FALSE(make_code(*machine_of("n_pendulum", "", {{"N", 8}}).system)->solve.unrolled);
}

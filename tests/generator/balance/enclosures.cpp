// SPDX-License-Identifier: GPL-3.0-or-later
// Radiation in enclosures: exchange factors against (4.51) and (4.53), view factors of polygons against closed forms and (4.56).
#include <fmt/format.h>

#include <cmath>

#include "balance/net_radiation.hpp"
#include "elements/verdict.hpp"
#include "generator/machine.hpp"
#include "symbolic/functions.hpp"
#include "tier.hpp"

using namespace dalembert;
using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::numeric;

namespace {

const std::string any_state =
    "[parameters]\nC = { value = 1, unit = \"J/K\", range = [0.1, 10] }\none = { value = 1, unit = \"m\", range = [0.1, 10] }\n"
    "K = { value = 1, unit = \"K\", range = [0.1, 10] }\n[states]\nT = { unit = \"K\", start = 300, range = [1, 1000] }\n";

/// n surfaces: one stores heat, the others are held at temperatures that differ.
std::string nodes(std::size_t n) {
    std::string text = "[nodes]\nn1 = { temperature = \"T\", capacity = \"C\" }\n";
    for (std::size_t i = 2; i <= n; ++i) text += fmt::format("n{} = {{ temperature = \"{}*K\" }}\n", i, 100 * i);
    return text;
}

template <class Part>
std::string list(std::size_t n, const Part& part) {
    std::string text = "[";
    for (std::size_t i = 0; i < n; ++i) text += (i == 0 ? "" : ", ") + part(i);
    return text + "]";
}

Machine prism(const std::vector<std::array<std::string, 2>>& corners, const std::string& emissivity = "0.5",
              const std::string& parameters = "") {
    const std::size_t n = corners.size();
    return machine_from(
        any_state + parameters + nodes(n) +
        "[enclosures.room]\nheight = \"2*one\"\nsurfaces = " + list(n, [](std::size_t i) { return fmt::format("\"n{}\"", i + 1); }) +
        "\nemissivities = " + list(n, [&](std::size_t) { return emissivity; }) + "\npolygon = " +
        list(n, [&](std::size_t i) { return fmt::format("[\"({})*one\", \"({})*one\"]", corners[i][0], corners[i][1]); }) + "\n");
}

GiNaC::exmap start_of(const Machine& machine) {
    GiNaC::exmap point = Values(machine.system->scene, machine.system->translate).substitution();
    add_steps(point, machine.system->symbols, 60);
    return point;
}

double number(const ex& e, const GiNaC::exmap& point) { return cln::double_approx(*value_at(e, point, 40)); }

/// (4.56) by midpoints of both sides, where the line between two points meets no other side.
double by_integration(const std::vector<std::array<double, 2>>& corners, std::size_t i, std::size_t j) {
    const std::size_t n = corners.size();
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    const auto point = [&](std::size_t side, double s) {
        const auto& a = corners[side];
        const auto& b = corners[(side + 1) % n];
        return std::array<double, 2>{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
    };
    const auto inward_normal = [&](std::size_t side) {  // of corners that go round to the left
        const auto& a = corners[side];
        const auto& b = corners[(side + 1) % n];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        return std::array<double, 3>{(a[1] - b[1]) / length, (b[0] - a[0]) / length, length};
    };
    const auto is_blocked = [&](const std::array<double, 2>& p, const std::array<double, 2>& q) {
        for (std::size_t k = 0; k < n; ++k) {
            if (k == i || k == j) continue;
            const auto& a = corners[k];
            const auto& b = corners[(k + 1) % n];
            const double one = cross(q[0] - p[0], q[1] - p[1], a[0] - p[0], a[1] - p[1]);
            const double two = cross(q[0] - p[0], q[1] - p[1], b[0] - p[0], b[1] - p[1]);
            const double three = cross(b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]);
            const double four = cross(b[0] - a[0], b[1] - a[1], q[0] - a[0], q[1] - a[1]);
            if (one * two < 0 && three * four < 0) return true;
        }
        return false;
    };
    constexpr int parts = 400;
    const auto ni = inward_normal(i);
    const auto nj = inward_normal(j);
    double sum = 0;
    for (int a = 0; a < parts; ++a)
        for (int b = 0; b < parts; ++b) {
            const auto p = point(i, (a + 0.5) / parts);
            const auto q = point(j, (b + 0.5) / parts);
            const double r = std::hypot(q[0] - p[0], q[1] - p[1]);
            const double from = ((q[0] - p[0]) * ni[0] + (q[1] - p[1]) * ni[1]) / r;
            const double to = ((p[0] - q[0]) * nj[0] + (p[1] - q[1]) * nj[1]) / r;
            if (from <= 0 || to <= 0 || is_blocked(p, q)) continue;
            sum += from * to / (2 * r);
        }
    return sum * nj[2] / (parts * parts);
}

/// Surfaces whose A_i*F_ij are given above and on the diagonal; areas are what the rows add up to.
Surroundings surroundings_of(const std::vector<std::vector<ex>>& direct, const std::vector<ex>& emissivities) {
    Surroundings s{{}, emissivities, direct};
    for (const auto& row : direct) s.areas.push_back(GiNaC::add(GiNaC::exvector(row.begin(), row.end())));
    return s;
}

matrix diagonal(const std::vector<ex>& entries) {
    const auto n = static_cast<unsigned>(entries.size());
    matrix m(n, n);
    for (unsigned i = 0; i < n; ++i) m(i, i) = entries[i];
    return m;
}

matrix view_factors(const Surroundings& s) {
    const auto n = static_cast<unsigned>(s.areas.size());
    matrix F(n, n);
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) F(i, j) = s.direct[i][j] / s.areas[i];
    return F;
}

/// The two forms of (4.51): heat fluxes over sigma*T^4.
std::pair<matrix, matrix> printed_forms(const Surroundings& s) {
    const auto n = static_cast<unsigned>(s.areas.size());
    const matrix E = GiNaC::ex_to<matrix>(GiNaC::unit_matrix(n));
    const matrix F = view_factors(s);
    const matrix eps = diagonal(s.emissivities);
    return {E.sub(F).mul(E.sub(E.sub(eps).mul(F)).inverse()).mul(eps), eps.mul(E.sub(F.mul(E.sub(eps))).inverse()).mul(E.sub(F))};
}

}  // namespace

TEST_CASE("two parallel plates exchange eps_1*eps_2/(eps_1 + eps_2 - eps_1*eps_2) (4.53)") {
    const Machine machine = machine_of("heat/parallel_plates", "bare");
    const System& system = *machine.system;
    const auto letter = [&](const char* name) { return system.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const ex a = letter("eps_1");
    const ex b = letter("eps_2");
    CHECK(Prover(system).equal(system.heat.enclosures.at(0).radiation.exchange[0][1], letter("A") * a * b / (a + b - a * b)).verdict ==
          Verdict::proven);
}

TEST_CASE("the exchange factors of two and three surfaces are both forms of (4.51), for all view factors and emissivities") {
    Machine machine = prism({{"0", "0"}, {"1", "0"}, {"0", "1"}});
    for (const unsigned n : {2U, 3U}) {
        std::vector<std::vector<ex>> direct(n, std::vector<ex>(n));
        std::vector<ex> emissivities;
        for (unsigned i = 0; i < n; ++i) {
            emissivities.push_back(GiNaC::possymbol(fmt::format("e{}", i)));
            for (unsigned j = i; j < n; ++j) direct[i][j] = direct[j][i] = GiNaC::possymbol(fmt::format("s{}{}", i, j));
        }
        const Surroundings s = surroundings_of(direct, emissivities);
        Steps written_out(machine.system->symbols, "any", false);
        const NetRadiation radiation = net_radiation(s, written_out);
        // G = A*eps*B with (E - F*rho)*B = F*eps, B_ij = reach_ij*eps_j/A_i: the inverse need not be formed.
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) {
                ex sum = direct[i][j] - radiation.reach[i][j];
                for (unsigned l = 0; l < n; ++l) sum += direct[i][l] * (1 - emissivities[l]) / s.areas[l] * radiation.reach[l][j];
                CHECK(in_elementary_functions(sum).normal().is_zero());
            }
        if (n > 2) continue;
        const auto [first, second] = printed_forms(s);
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) {
                CHECK((first(i, j) - second(i, j)).normal().is_zero());
                const ex sign = i == j ? 1 : -1;  // of two surfaces
                CHECK((s.areas[i] * first(i, j) - sign * in_elementary_functions(radiation.exchange[0][1])).normal().is_zero());
            }
    }
}

TEST_CASE("three to six surfaces with random view factors and emissivities: both forms of (4.51), exactly") {
    Machine machine = prism({{"0", "0"}, {"1", "0"}, {"0", "1"}});
    unsigned seed = 1;
    const auto random = [&] {
        seed = seed * 1664525U + 1013904223U;
        return numeric(static_cast<long>(seed >> 20U) + 1, 4097);
    };
    for (unsigned n = 3; n <= 6; ++n)
        for (int repeat = 0; repeat < 4; ++repeat) {
            std::vector<std::vector<ex>> direct(n, std::vector<ex>(n));
            std::vector<ex> emissivities;
            for (unsigned i = 0; i < n; ++i) {
                // A black one, and one that re-radiates, now and then.
                emissivities.push_back(repeat == 1 && i == 0       ? numeric(0)
                                       : repeat == 2 && i + 1 == n ? numeric(1)
                                       : repeat == 3 && i == 1     ? numeric(0)
                                                                   : random());
                for (unsigned j = i; j < n; ++j) direct[i][j] = direct[j][i] = random();
            }
            const Surroundings s = surroundings_of(direct, emissivities);
            Steps numbers(machine.system->symbols, "any", false);
            const NetRadiation radiation = net_radiation(s, numbers);
            const auto [first, second] = printed_forms(s);
            for (unsigned i = 0; i < n; ++i)
                for (unsigned j = 0; j < n; ++j) {
                    CHECK(first(i, j) == second(i, j));
                    if (i != j) CHECK(s.areas[i] * first(i, j) == -radiation.exchange[i][j]);
                }
        }
}

TEST_CASE("perfect mirrors exchange nothing") {
    Machine machine = prism({{"0", "0"}, {"1", "0"}, {"0", "1"}}, "0");
    const auto& exchange = machine.system->heat.enclosures.at(0).radiation.exchange;
    for (const auto& row : exchange)
        for (const ex& factor : row) CHECK(factor.is_zero());
    const Machine by_parameter =
        prism({{"0", "0"}, {"1", "0"}, {"0", "1"}}, "\"e\"", "[parameters.e]\nvalue = 0\nunit = \"1\"\nrange = [0, 1]\n");
    const GiNaC::exmap start = start_of(by_parameter);
    for (const auto& row : by_parameter.system->heat.enclosures.at(0).radiation.exchange)
        for (const ex& factor : row) CHECK(number(factor, start) == 0);
}

TEST_CASE("view factors of a square and of a triangle with equal sides") {
    const Machine square = prism({{"0", "0"}, {"1", "0"}, {"1", "1"}, {"0", "1"}});
    const auto F = [](const Machine& machine, std::size_t i, std::size_t j) {
        return number(machine.system->heat.enclosures.at(0).view_factors[i][j], start_of(machine));
    };
    CHECK(F(square, 0, 2) == doctest::Approx(std::sqrt(2.0) - 1).epsilon(1e-15));
    CHECK(F(square, 0, 1) == doctest::Approx(1 - std::sqrt(0.5)).epsilon(1e-15));
    CHECK(F(square, 0, 0) == 0);
    const Machine triangle = prism({{"0", "0"}, {"1", "0"}, {"1/2", "sqrt(3)/2"}});
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) CHECK(F(triangle, i, j) == doctest::Approx(i == j ? 0 : 0.5).epsilon(1e-15));
}

TEST_CASE("view factors of polygons that are not convex: (4.56) by integration, and rows that add up to 1" *
          doctest::skip(!is_full_tier())) {
    const std::vector<std::vector<std::array<double, 2>>> shapes{
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},                          // an L
        {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 0.5}, {1, 0.75}, {1, 2.25}, {0, 2}},  // a U with a crooked wall
        {{0, 0}, {4, 0}, {4, 1}, {2.5, 0.75}, {2, 2.5}, {1.5, 0.5}, {0, 1}},       // two rooms and a niche
        {{0, 0}, {1, 0}, {2, 0}, {2, 1.5}, {0.5, 1}},                              // a wall of two pieces in one line
    };
    for (const auto& corners : shapes)
        for (const bool reversed : {false, true}) {
            std::vector<std::array<double, 2>> points = corners;
            if (reversed) std::reverse(points.begin(), points.end());
            std::vector<std::array<std::string, 2>> written;
            for (const auto& [x, y] : points) written.push_back({fmt::format("{}", x), fmt::format("{}", y)});
            const Machine machine = prism(written);
            const auto& F = machine.system->heat.enclosures.at(0).view_factors;
            const GiNaC::exmap start = start_of(machine);
            const std::size_t n = points.size();
            for (std::size_t i = 0; i < n; ++i) {
                double sum = 0;
                for (std::size_t j = 0; j < n; ++j) {
                    const double factor = number(F[i][j], start);
                    sum += factor;
                    if (reversed || i == j) continue;
                    CAPTURE(i);
                    CAPTURE(j);
                    CHECK(std::abs(factor - by_integration(points, i, j)) < 0.003);
                }
                CHECK(sum == doctest::Approx(1).epsilon(1e-14));
            }
        }
}

TEST_CASE("all heat that leaves a surface arrives at others, and none flows at equal temperatures") {
    const Machine machine = prism({{"0", "0"}, {"2", "0"}, {"2", "1"}, {"1", "1"}, {"1", "3"}, {"0", "3"}});
    const System& system = *machine.system;
    ex sum = 0;
    for (const NodeState& node : system.heat.nodes) sum += system.heat.heat_into(node);
    CHECK(sum.is_zero());
    for (const LinkState& link : system.heat.links) {
        CHECK(link.from.node->name != link.to.node->name);
        if (link.from.node->name == "n1")
            CHECK(link.heat.subs(system.symbols.get(SymbolKind::state, 0) == link.to.node->warmth.temperature).is_zero());
    }
}

TEST_CASE("derivatives of exchange factors by parameters: closed forms against differences with 60 digits") {
    const std::string parameters =
        "[parameters.a]\nvalue = 2\nunit = \"m\"\n[parameters.e]\nvalue = 0.3\nunit = \"1\"\n[parameters.A]\nvalue = 1.5\nunit = "
        "\"m^2\"\n[parameters.F]\nvalue = 0.4\nunit = \"1\"\n";
    const std::vector<std::string> enclosures{
        "height = \"a/2\"\npolygon = [[0, 0], [\"a\", 0], [\"2*a/3\", \"a/2\"], [0, \"one\"]]\nemissivities = [\"e\", 0.5, \"e^2\", 1]\n",
        "areas = [\"A\", \"2*one^2\", \"a^2\", \"A\"]\nemissivities = [\"e\", 0.5, \"1 - e\", 1]\n"
        "view_factors = [[\"?\", \"F/2\", \"F/3\", 0.1], [\"?\", \"?\", \"F/2\", 0.2], [\"?\", \"?\", \"?\", 0.05], [\"?\", \"?\", \"?\", "
        "\"?\"]]\n",
    };
    for (const std::string& enclosure : enclosures) {
        const Machine machine = machine_from(any_state + parameters + nodes(4) +
                                             "[enclosures.room]\nsurfaces = [\"n1\", \"n2\", \"n3\", \"n4\"]\n" + enclosure);
        const Symbols& symbols = machine.system->symbols;
        const GiNaC::exmap start = Values(machine.system->scene, machine.system->translate).substitution();
        const auto at = [&](const ex& e, const ex& letter, const numeric& step) {
            GiNaC::exmap point = start;
            point[letter] += step;
            add_steps(point, symbols, 80);
            return value_at(e, point, 80).value();
        };
        for (const Variable& p : symbols.all(SymbolKind::parameter))
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = i + 1; j < 4; ++j) {
                    const ex G = machine.system->heat.enclosures.at(0).radiation.exchange[i][j];
                    const numeric h = GiNaC::pow(numeric(10), numeric(-20));
                    const cln::cl_R difference = (at(G, p.symbol, h) - at(G, p.symbol, -h)) / cln::the<cln::cl_R>((2 * h).to_cl_N());
                    const cln::cl_R closed = at(symbols.derivative_by_parameter(G, p.position), p.symbol, 0);
                    CAPTURE(p.name);
                    CHECK(std::abs(cln::double_approx(closed - difference)) < 1e-30);
                }
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Solids: integrals against quadrature in 50 digits, tensors of placed and turned solids, bodies that take what they are from a solid.
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "mechanics/solid.hpp"
#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Place = std::array<Digits50, 3>;
using Density = std::function<Digits50(const Place&)>;

const std::string lengths =
    "[parameters]\n"
    "rho = { value = 7, unit = \"kg/m^3\", range = [1, 10] }\n"
    "m = { value = 3, unit = \"kg\", range = [1, 10] }\n"
    "R = { value = 0.3, unit = \"m\", range = [0.2, 1] }\n"
    "r = { value = 0.1, unit = \"m\", range = [0.05, 0.2] }\n"
    "h = { value = 0.7, unit = \"m\", range = [0.1, 1] }\n"
    "k = { value = 0.4, unit = \"1/m\", range = [0.1, 1] }\n"
    "a = { value = 0.5, unit = \"rad\", range = [0, 1] }\n"
    "b = { value = 1.1, unit = \"rad\", range = [0, 2] }\n";
const Digits50 R = Digits50(3) / 10, r = Digits50(1) / 10, h = Digits50(7) / 10, k = Digits50(4) / 10;

Machine with_solid(const std::string& solid) { return machine_from(lengths + solid + "[outputs]\ny = \"solid_mass[s]\"\n"); }

Digits50 value(const System& system, const ex& e) {
    const Values defaults(system.scene, system.translate);
    const auto number = value_at(system.symbols.without_definitions(e), defaults.substitution(), 50);
    REQUIRE(number.has_value());
    const cln::cl_RA scaled = cln::rational(*number);  // to 50 digits as a whole number over a power of ten
    const cln::cl_I whole = cln::round1(scaled * cln::expt(cln::cl_RA(10), 60));
    std::ostringstream text;
    text << whole;
    return Digits50(text.str()) / pow(Digits50(10), 60);
}

/// Sums of weights times function(place): mass, first and second moments.
struct Moments {
    Digits50 mass = 0;
    Place first{};
    std::array<Place, 3> second{};
    void add(const Digits50& weight, const Place& p) {
        mass += weight;
        for (std::size_t i = 0; i < 3; ++i) {
            first[i] += weight * p[i];
            for (std::size_t j = 0; j < 3; ++j) second[i][j] += weight * p[i] * p[j];
        }
    }
    Digits50 inertia(std::size_t i, std::size_t j) const { return (i == j ? second[0][0] + second[1][1] + second[2][2] : Digits50(0)) - second[i][j]; }
};

/// Calls visit(x, weight) at the points of Gauss over an interval.
template <class Visit>
void gauss(const Digits50& from, const Digits50& to, Visit visit) {
    using Rule = boost::math::quadrature::gauss<Digits50, 15>;
    const Digits50 middle = (from + to) / 2, half = (to - from) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const Digits50 x = Rule::abscissa()[i], w = Rule::weights()[i] * half;
        visit(middle + half * x, w);
        if (x != 0) visit(middle - half * x, w);
    }
}

/// Around: exact for polynomials in sine and cosine of lower degree than points.
template <class Visit>
void around(Visit visit) {
    constexpr int points = 16;
    const Digits50 pi = boost::math::constants::pi<Digits50>();
    for (int i = 0; i < points; ++i) visit(2 * pi * i / points, 2 * pi / points);
}

/// Round about z between two radii that depend on z.
Moments of_round(const Density& density, const Digits50& from, const Digits50& to, const std::function<Digits50(Digits50)>& inner, const std::function<Digits50(Digits50)>& outer) {
    Moments sum;
    gauss(from, to, [&](const Digits50& z, const Digits50& wz) {
        gauss(inner(z), outer(z), [&](const Digits50& s, const Digits50& ws) {
            around([&](const Digits50& phi, const Digits50& wp) {
                const Place p{s * cos(phi), s * sin(phi), z};
                sum.add(density(p) * s * wz * ws * wp, p);
            });
        });
    });
    return sum;
}

void agrees(const Machine& machine, const Moments& expected) {
    const System& system = *machine.system;
    const SolidProperties& solid = system.solids.of("s");
    const auto near = [&](const ex& found, const Digits50& wanted, const char* what) {
        CAPTURE(what);
        CHECK(static_cast<double>(abs(value(system, found) - wanted)) < 1e-30);
    };
    near(solid.mass, expected.mass, "mass");
    for (std::size_t i = 0; i < 3; ++i) {
        near(solid.mass * solid.centre[i], expected.first[i], "first moment");
        for (std::size_t j = 0; j < 3; ++j) near(solid.about_origin[i][j], expected.inertia(i, j), "inertia");
    }
    CHECK(all_proven(system));
}

const Density even = [](const Place&) { return Digits50(7); };
const Density uneven = [](const Place& p) { return Digits50(7) * (1 + k * p[2] + k * k * p[0] * p[1] + k * p[1]); };
const std::string uneven_text = "density = \"rho*(1 + k*z + k^2*x*y + k*y)\"\n";

}  // namespace

TEST_CASE("integrals over boxes and what is round about an axis agree with quadrature in 50 digits") {
    const auto constant = [](const Digits50& c) { return [c](const Digits50&) { return c; }; };
    SUBCASE("hollow cylinder of uneven density") {
        agrees(with_solid("[solids.s]\nshape = \"cylinder\"\nradius = \"R\"\ninner_radius = \"r\"\nheight = \"h\"\n" + uneven_text), of_round(uneven, -h / 2, h / 2, constant(r), constant(R)));
    }
    SUBCASE("cone of uneven density") {
        agrees(with_solid("[solids.s]\nshape = \"cone\"\nradius = \"R\"\nheight = \"h\"\n" + uneven_text), of_round(uneven, 0, h, constant(0), [](const Digits50& z) { return R * (1 - z / h); }));
    }
    SUBCASE("frustum") {
        agrees(with_solid("[solids.s]\nshape = \"cone\"\nradius = \"R\"\ntop_radius = \"r\"\nheight = \"h\"\ndensity = \"rho\"\n"), of_round(even, 0, h, constant(0), [](const Digits50& z) { return R + (r - R) * z / h; }));
    }
    SUBCASE("box of uneven density") {
        Moments sum;
        gauss(-R / 2, R / 2, [&](const Digits50& x, const Digits50& wx) {
            gauss(-r / 2, r / 2, [&](const Digits50& y, const Digits50& wy) {
                gauss(-h / 2, h / 2, [&](const Digits50& z, const Digits50& wz) { sum.add(uneven({x, y, z}) * wx * wy * wz, {x, y, z}); });
            });
        });
        agrees(with_solid("[solids.s]\nshape = \"box\"\nsize = [\"R\", \"r\", \"h\"]\n" + uneven_text), sum);
    }
}

TEST_CASE("integrals over balls and half ones agree with quadrature in 50 digits") {
    for (const bool is_half : {false, true}) {
        const Digits50 inner = is_half ? Digits50(0) : r;
        Moments sum;
        gauss(inner, R, [&](const Digits50& s, const Digits50& ws) {
            // Over the cosine of the angle from the pole, which leaves a polynomial.
            gauss(is_half ? 0 : -1, 1, [&](const Digits50& c, const Digits50& wc) {
                around([&](const Digits50& phi, const Digits50& wp) {
                    const Digits50 across = s * sqrt(1 - c * c);
                    const Place p{across * cos(phi), across * sin(phi), s * c};
                    sum.add(uneven(p) * s * s * ws * wc * wp, p);
                });
            });
        });
        const std::string shape = is_half ? "shape = \"hemisphere\"\nradius = \"R\"\n" : "shape = \"sphere\"\nradius = \"R\"\ninner_radius = \"r\"\n";
        agrees(with_solid("[solids.s]\n" + shape + uneven_text), sum);
    }
}

TEST_CASE("closed forms of handbooks, with the mass given") {
    const auto moment = [](const std::string& shape, std::size_t i, const std::string& expected) {
        CAPTURE(shape);
        const Machine machine = machine_from(lengths + "[solids.s]\n" + shape + "mass = \"m\"\n[definitions]\nexpected = \"" + expected + "\"\n[outputs]\ny = \"solid_mass[s]\"\nJ = \"expected\"\n");
        const System& system = *machine.system;
        const ex wanted = system.symbols.definition_values()[0];
        CHECK(is_zero_for_all(system.solids.of("s").about_centre[i][i] - wanted));
    };
    const std::string R_and_h = "radius = \"R\"\nheight = \"h\"\n";
    moment("shape = \"box\"\nsize = [\"R\", \"r\", \"h\"]\n", 2, "m*(R^2 + r^2)/12");
    moment("shape = \"cylinder\"\n" + R_and_h, 2, "m*R^2/2");
    moment("shape = \"cylinder\"\n" + R_and_h, 0, "m*(3*R^2 + h^2)/12");
    moment("shape = \"cylinder\"\ninner_radius = \"r\"\n" + R_and_h, 0, "m*(3*(R^2 + r^2) + h^2)/12");
    moment("shape = \"cone\"\n" + R_and_h, 2, "3*m*R^2/10");
    moment("shape = \"cone\"\n" + R_and_h, 0, "3*m*(4*R^2 + h^2)/80");
    moment("shape = \"cone\"\ntop_radius = \"r\"\n" + R_and_h, 2, "3*m*(R^5 - r^5)/(10*(R^3 - r^3))");
    moment("shape = \"sphere\"\nradius = \"R\"\n", 1, "2*m*R^2/5");
    moment("shape = \"sphere\"\nradius = \"R\"\ninner_radius = \"r\"\n", 1, "2*m*(R^5 - r^5)/(5*(R^3 - r^3))");
    moment("shape = \"hemisphere\"\nradius = \"R\"\n", 0, "83*m*R^2/320");
}

TEST_CASE("a turned tensor keeps its trace and its products with the axes, and a ball does not turn") {
    const Machine machine = with_solid("[solids.s]\nshape = \"box\"\nsize = [\"R\", \"r\", \"h\"]\nmass = \"m\"\nturns = [[\"z\", \"a\"], [\"x\", \"b\"]]\nat = [\"h\", 0, \"-R\"]\n");
    const System& system = *machine.system;
    const SolidProperties& solid = system.solids.of("s");
    const auto letter = [&](const char* name) { return system.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const ex own[]{letter("m") * (pow(letter("r"), 2) + pow(letter("h"), 2)) / 12, letter("m") * (pow(letter("R"), 2) + pow(letter("h"), 2)) / 12, letter("m") * (pow(letter("R"), 2) + pow(letter("r"), 2)) / 12};
    const Orientation turned = by_turns({{2, letter("a")}, {0, letter("b")}}, system.symbols);
    for (std::size_t i = 0; i < 3; ++i) {
        // Each column e of the axes is an eigenvector: J e = J_own e.
        const SpaceVector e = transposed(turned.axes)[i];
        const SpaceVector image = solid.about_centre * e;
        for (std::size_t j = 0; j < 3; ++j) CHECK(is_zero_for_all(image[j] - own[i] * e[j]));
    }
    CHECK(all_proven(system));
    const Machine ball = with_solid("[solids.s]\nshape = \"sphere\"\nradius = \"R\"\nmass = \"m\"\nturns = [[\"z\", \"a\"], [\"x\", \"b\"]]\n");
    CHECK(ball.system->solids.of("s").about_centre[0][1].is_zero());
    CHECK_FALSE(ball.system->solids.of("s").about_centre[0][0].has(GiNaC::sin(GiNaC::wild())));
}

TEST_CASE("two halves are the whole, a bore is what a hollow cylinder lacks, and the order does not matter") {
    const auto same = [](const std::string& solids, const std::string& one, const std::string& other) {
        const Machine machine = machine_from(lengths + solids + "[outputs]\ny = \"solid_mass[" + one + "]\"\nz = \"solid_mass[" + other + "]\"\n");
        const System& system = *machine.system;
        const SolidProperties &a = system.solids.of(one), &b = system.solids.of(other);
        CHECK(is_zero_for_all(a.mass - b.mass));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(is_zero_for_all(a.centre[i] - b.centre[i]));
            for (std::size_t j = 0; j < 3; ++j) CHECK(is_zero_for_all(a.about_centre[i][j] - b.about_centre[i][j]));
        }
        CHECK(all_proven(system));
    };
    const std::string half = "shape = \"hemisphere\"\nradius = \"R\"\ndensity = \"rho\"\n";
    same("[solids.upper]\n" + half + "[solids.lower]\n" + half + "turns = [[\"x\", \"pi\"]]\n[solids.both]\nof = [\"upper\", \"lower\"]\n[solids.ball]\nshape = \"sphere\"\nradius = \"R\"\ndensity = \"rho\"\n", "both", "ball");
    const std::string cylinder = "shape = \"cylinder\"\nheight = \"h\"\ndensity = \"rho\"\n";
    same("[solids.full]\n" + cylinder + "radius = \"R\"\n[solids.bore]\n" + cylinder + "radius = \"r\"\n[solids.drilled]\nof = [\"full\"]\nwithout = [\"bore\"]\n[solids.hollow]\n" + cylinder +
             "radius = \"R\"\ninner_radius = \"r\"\n", "drilled", "hollow");
    const std::string points = "[solids.p]\nshape = \"point\"\nmass = \"m\"\nat = [\"h\", 0, 0]\n[solids.q]\nshape = \"point\"\nmass = \"rho*R^3\"\nat = [0, \"r\", \"R\"]\n";
    same(points + "[solids.pq]\nof = [\"p\", \"q\"]\n[solids.qp]\nof = [\"q\", \"p\"]\n", "pq", "qp");
}

TEST_CASE("a body takes mass, centre and inertia from a solid") {
    const std::string placed = lengths + "g = { value = 9.81, unit = \"m/s^2\" }\n[coordinates]\nphi = { unit = \"rad\" }\n[gravity]\nacceleration = [0, \"-g\", 0]\n"
                                         "[solids.rod]\nshape = \"box\"\nsize = [\"h\", \"r\", \"R\"]\nat = [\"h/2\", 0, 0]\nmass = \"m\"\n";
    const Machine planar = machine_from(placed + "[bodies.rod]\nsolid = \"rod\"\nposition = [\"h/2*cos(phi)\", \"h/2*sin(phi)\"]\nrotation = \"phi\"\n");
    const Machine space = machine_from(placed + "[bodies.rod]\nsolid = \"rod\"\nturns = [[\"z\", \"phi\"]]\n");
    const Machine by_hand = machine_from(placed + "[bodies.rod]\nmass = \"m\"\ninertia = \"m*(h^2 + r^2)/12\"\nposition = [\"h/2*cos(phi)\", \"h/2*sin(phi)\"]\nrotation = \"phi\"\n");
    const auto residual = [](const Machine& machine) {
        // Letters of different machines differ; their values do not.
        return machine.system->residual[0].subs(Values(machine.system->scene, machine.system->translate).substitution()).subs(
            GiNaC::lst{machine.system->symbols.get(SymbolKind::acceleration, 0) == 3});
    };
    CHECK(is_zero_for_all(residual(planar) - residual(by_hand)));
    CHECK(is_zero_for_all(residual(space) - residual(by_hand)));
    CHECK(space.audit.all_proven());
}

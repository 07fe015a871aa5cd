// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of coordinates, (2.12)-(2.27), of systems that are not in the book, against what is known of them; and what ranges allow.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "generator/machine.hpp"
#include "prove/equivalence.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

/// A point with coordinates and ranges as given, and outputs of any kind.
std::string point(const std::string& coordinates, const std::string& position, const std::string& outputs) {
    return "[parameters]\nm = { value = 1, unit = \"kg\", range = [0.1, 10] }\nR = { value = 2, unit = \"m\", range = [1, 10] }\n[coordinates]\n" +
           coordinates + "\n[bodies.p]\nmass = \"m\"\nposition = " + position + "\n[outputs]\n" + outputs + "\n";
}

ex output(const System& system, const std::string& name) {
    for (const OutputEquation& one : system.outputs)
        if (one.name == name) return one.value;
    return 0;
}

/// An expression of the coordinates of a system, written in the model language.
bool holds(const std::string& text) {
    const Machine machine = machine_from(text);
    const System& system = *machine.system;
    Prover prover(system);
    return prover.equal(output(system, "found"), output(system, "expected")).verdict == Verdict::proven;
}

}  // namespace

TEST_CASE("roots come out as far as the ranges allow") {
    const std::string sphere = R"x(["R*sin(a)*cos(b)", "R*sin(a)*sin(b)", "R*cos(a)"])x";
    const auto of_range = [&](const std::string& range, const std::string& expected) {
        return holds(point("a = { unit = \"rad\", start = 1" + range + " }\nb = { unit = \"rad\" }", sphere, "found = { value = \"scale_factor[p, b]\", unit = \"m\" }\nexpected = { value = \"" + expected + "\", unit = \"m\" }"));
    };
    CHECK(of_range(", range = [0, \"pi\"]", "R*sin(a)"));
    CHECK(of_range(", range = [0.1, 3]", "R*sin(a)"));
    CHECK_FALSE(of_range(", range = [0, 3.2]", "R*sin(a)"));  // beyond pi
    CHECK_FALSE(of_range(", range = [-0.1, 3]", "R*sin(a)"));
    CHECK_FALSE(of_range("", "R*sin(a)"));
    CHECK(of_range("", "R*abs(sin(a))"));
    // Latitude instead of the angle from the pole.
    const std::string globe = R"x(["R*cos(a)*cos(b)", "R*cos(a)*sin(b)", "R*sin(a)"])x";
    CHECK(holds(point("a = { unit = \"rad\", start = 1, range = [\"-pi/2\", \"pi/2\"] }\nb = { unit = \"rad\" }", globe, "found = { value = \"scale_factor[p, b]\", unit = \"m\" }\nexpected = { value = \"R*cos(a)\", unit = \"m\" }")));
}

TEST_CASE("lines of other coordinates") {
    const auto pair = [](const std::string& found, const std::string& expected, const std::string& unit) {
        return "found = { value = \"" + found + "\", unit = \"" + unit + "\" }\nexpected = { value = \"" + expected + "\", unit = \"" + unit + "\" }";
    };
    // Elliptic cylinder coordinates: both lines have the same scale.
    const std::string angles = "u = { unit = \"rad\", start = 1, range = [0.1, 3] }\nw = { unit = \"rad\" }";
    const std::string ellipse = R"x(["R*cosh(u)*cos(w)", "R*sinh(u)*sin(w)", 0])x";
    CHECK(holds(point(angles, ellipse, pair("scale_factor[p, u]", "R*sqrt(sinh(u)^2 + sin(w)^2)", "m"))));
    CHECK(holds(point(angles, ellipse, pair("christoffel[p, u, u, u]", "sinh(u)*cosh(u)/(sinh(u)^2 + sin(w)^2)", "1"))));
    CHECK(holds(point(angles, ellipse, pair("christoffel[p, u, w, w]", "-sinh(u)*cosh(u)/(sinh(u)^2 + sin(w)^2)", "1"))));
    // A helix is one line: its acceleration along itself is that of its length.
    CHECK(holds(point("s = { unit = \"m\" }", R"x(["R*cos(s/R)", "R*sin(s/R)", "s"])x", pair("acceleration_along[p, s]", "sqrt(2)*ddot(s)", "m/s^2"))));
    // Skew lines have Christoffel symbols, too: of x = q^2/(2 R) + p, y = p the second kind is the first over the metric.
    const std::string skew = R"x(["q^2/(2*R) + p", "p", 0])x";
    const std::string lengths = "q = { unit = \"m\", start = 1, range = [1, 2] }\np = { unit = \"m\" }";
    CHECK(holds(point(lengths, skew, pair("christoffel[p, q, q, q]", "1/q", "1/m"))));
    CHECK(holds(point(lengths, skew, pair("christoffel[p, p, q, q]", "0/q", "1/m"))));
    CHECK(holds(point(lengths, skew, pair("christoffel_first[p, p, q, q]", "1/R", "1/m"))));
}

TEST_CASE("a place that moves by itself adds to components") {
    // A turntable that turns with the angle w t, and a slot along its radius: Coriolis and centripetal acceleration.
    const std::string text = "[parameters]\nm = { value = 1, unit = \"kg\" }\nw = { value = 1, unit = \"1/s\" }\n[coordinates]\n"
                             "r = { unit = \"m\", range = [0, 10] }\na = { unit = \"rad\" }\n[bodies.p]\nmass = \"m\"\nposition = [\"r*cos(a + w*t)\", \"r*sin(a + w*t)\", 0]\n[outputs]\n";
    CHECK(holds(text + "found = { value = \"velocity_along[p, a]\" }\nexpected = { value = \"r*(dot(a) + w)\" }"));
    CHECK(holds(text + "found = { value = \"acceleration_along[p, r]\" }\nexpected = { value = \"ddot(r) - r*(dot(a) + w)^2\" }"));
    CHECK(holds(text + "found = { value = \"acceleration_along[p, a]\" }\nexpected = { value = \"r*ddot(a) + 2*dot(r)*(dot(a) + w)\" }"));
}

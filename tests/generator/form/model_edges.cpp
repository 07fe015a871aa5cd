// SPDX-License-Identifier: GPL-3.0-or-later
// Which functions of a model become edges of its right-hand side, and at which times a run knows of them beforehand.
#include "form/model_edges.hpp"

#include "form/input_kinks.hpp"
#include "generator/machine.hpp"

using namespace dalembert;

namespace {

const std::string with_force = block + "[parameters.tau]\nvalue = 1\nunit = \"s\"\n[inputs]\nu = { unit = \"N\" }\n[forces.f]\non = \"block\"\nforce = [\"u + ";

Machine pushed_by(const std::string& force) { return machine_from(with_force + force + "\", 0, 0]\n"); }

std::vector<std::string> edges(const Machine& machine) {
    std::vector<std::string> names;
    for (const Guard& guard : machine.system->guards)
        if (!guard.ends) names.push_back(guard.name);
    return names;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("kinks and jumps of what moves are edges") {
    CHECK(edges(pushed_by("c*max(x - l, 0)")) == Texts{"l - x"});
    CHECK(edges(pushed_by("c*abs(x)*sign(tau*dot(x) - l)")) == Texts{"dot(x)*tau - l", "x"});
    CHECK(edges(pushed_by("max(u, 0)")) == Texts{"u"});
    CHECK(edges(pushed_by("c*l*step(t - tau)")) == Texts{"t - tau"});
    CHECK(edges(pushed_by("c*l*pulse(t - tau, tau/2)")) == Texts{"2*t - 3*tau", "t - tau"});
    CHECK(edges(pushed_by("c*l*mod(x/l, 1/4)")) == Texts{"sin(4*pi*x/l)"});
    CHECK(edges(pushed_by("if(x < l and dot(x) > 0, -d*dot(x), c*x)")) == Texts{"dot(x)", "l - x"});
    CHECK(edges(pushed_by("c*l*max(x/l, 0)^(3/2)")) == Texts{"x/l"});
}

TEST_CASE("no edge: of parameters, smooth enough by its order or by the model's word") {
    CHECK(edges(pushed_by("c*max(l - d*l/m*tau, 0)")).empty());
    CHECK(edges(pushed_by("m/l*abs(dot(x))*dot(x)")).empty());
    CHECK(edges(pushed_by("c*max(x - l, 0)^2/l")).empty());
    CHECK(edges(pushed_by("unlocated(c*max(x - l, 0) + d*abs(dot(x)))")).empty());
    CHECK(edges(pushed_by("c*max(x - l, 0) + unlocated(d*abs(dot(x)))")) == Texts{"l - x"});
}

TEST_CASE("the same place is one edge, and a law of a spring has its own") {
    CHECK(edges(pushed_by("c*max(x - l, 0) + c*abs(l - x) - 2*c*min(3*x, 3*l)")) == Texts{"l - x"});
    CHECK(edges(machine_from(block + "[springs.s]\nelongation = \"x - l\"\nforce = \"e -> c*ramp(e)\"\nenergy = \"e -> c*ramp(e)^2/2\"\n")) == Texts{"l - x"});
}

TEST_CASE("edges of the time are known before the run, with the inputs of the run inserted") {
    const Machine machine = pushed_by("max(u, 0) + c*l*pulse(mod(t, 2*tau), tau/1000)");
    const System& system = *machine.system;
    const Values values(system.scene, system.translate);
    const std::vector<double> found = input_kinks(system, {GiNaC::sin(system.symbols.time())}, values, 5);
    const std::vector<double> expected{0.001, 2, 2.001, 3.14159265358979323846, 4, 4.001};
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-14));
}

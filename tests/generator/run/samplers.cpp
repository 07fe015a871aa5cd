// SPDX-License-Identifier: GPL-3.0-or-later
// Controllers that sample, beside recursions and closed forms of their own.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "generator/command/verb.hpp"
#include "tier.hpp"

using namespace dalembert;

namespace {

std::string text_of(const std::string& name, const std::string& text) { return "[model]\nformat = 1\nname = \"" + name + "\"\n" + text; }

/// The last row of a run, by the titles of its columns without units.
std::map<std::string, double> last_row(const Folder& folder, const std::string& model, std::vector<std::string> options) {
    options.insert(options.begin(), model);
    options.insert(options.end(), {"--no-plot", "-o", folder.path()});
    const Answer answer = ask("simulate", options);
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    const std::string stem = std::filesystem::path(model).stem();
    std::ifstream in(folder.path() / (stem + "_full.csv"));
    std::string titles, line, last;
    std::getline(in, titles);
    while (std::getline(in, line)) last = line;
    std::map<std::string, double> row;
    std::istringstream names(titles), values(last);
    for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
        row[name.substr(0, name.find(" ["))] = std::stod(value);
    return row;
}

/// The controller of all motors here.
const std::string pi = SOURCE_DIR "/systems/controllers/pi.toml";

}  // namespace

TEST_CASE("a PI loop is its recursion: a million samples, and no drift") {
    const Folder folder;
    const std::string model = folder.write("motor.toml", text_of("motor", R"m(
[samplers.speed]
file = ")m" + pi + R"m("
parameters = { T_s = "1 ms", K = 3, T_i = "50 ms", T_t = "20 ms" }
measures = { w = "0.5*sin(3*t/(1 s)) + 0.3", y = "dot(phi)/(100 rad/s)" }
sets = { out = "duty" }
[parameters]
J = { value = 0.01, unit = "kg*m^2" }
d = { value = 0.02, unit = "N*m*s/rad" }
k = { value = 5, unit = "N*m" }
[coordinates]
phi = { unit = "rad" }
[inputs]
duty = { unit = "1" }
[bodies.rotor]
rotation = "phi"
inertia = "J"
[dampers.bearing]
rate = "dot(phi)"
coefficient = "d"
[torques.drive]
on = "rotor"
torque = "k*duty"
)m"));
    const long samples = is_full_tier() ? 1000000 : 20000;
    const auto row = last_row(folder, model, {"--until", std::to_string(samples) + "*1ms", "--samples", "10", "--tolerance", "1e-13"});
    // Between samples the motor is known exactly.
    const long double decay = std::exp(-0.02L * 0.001L / 0.01L), gain = 5 / 0.02L * (1 - decay);
    long double w = 0, z = 0, duty = 0;
    for (long i = 0; i < samples; ++i) {
        const long double error = 0.5L * std::sin(0.003L * i) + 0.3L - w / 100, v = 3 * error + z;
        duty = std::min(std::max(v, -1.0L), 1.0L);
        z += 0.001L * (3 * error / 0.05L + (duty - v) / 0.02L);
        w = decay * w + gain * duty;
    }
    CHECK(std::fabs(row.at("dot(phi)") - static_cast<double>(w)) < 1e-12 * 80);
    CHECK(std::fabs(row.at("speed_z") - static_cast<double>(z)) < 1e-12);
    CHECK(std::fabs(row.at("duty") - static_cast<double>(duty)) < 1e-12);
}

TEST_CASE("several rates, an offset and a delay: inputs change at the instants that these say, by every method") {
    const Folder folder;
    folder.write("count.toml", text_of("count", R"m(
[sampling]
every = "T"
offset = "T_0"
delay = "T_d"
[parameters]
T = { value = 1, unit = "s" }
T_0 = { value = 0, unit = "s" }
T_d = { value = 0, unit = "s" }
[inputs]
x = { unit = "m" }
[states]
k = { unit = "1", start = 1, next = "k + 1" }
[outputs]
u = { value = "(k*(1 m) - x)/(1 s)", unit = "m/s" }
)m"));
    const std::string model = folder.write("sum.toml", text_of("sum", R"m(
[samplers.a]
file = "count.toml"
parameters = { T = 0.3, T_0 = 0.1, T_d = 0.05 }
measures = { x = "x" }
sets = { u = "u_a" }
[samplers.b]
file = "count.toml"
parameters = { T = 0.2, T_d = 0.2 }
measures = { x = "2*x + u_a*(1 s)" }
sets = { u = "u_b" }
[inputs]
u_a = { unit = "m/s" }
u_b = { unit = "m/s" }
[states]
x = { unit = "m", start = 0.25, derivative = "u_a - u_b" }
)m"));
    // In units of 10 ms; of instants that agree, effects come first, then samples in order.
    double x = 0.25, k_a = 1, k_b = 1, u_a = 1 - x, u_b = 1 - (2 * x + u_a), next_a = 0, next_b = 0;
    for (int i = 0; i < 1000; ++i) {
        if (i >= 15 && (i - 15) % 30 == 0) u_a = next_a;
        if (i >= 20 && i % 20 == 0) u_b = next_b;
        if (i >= 10 && (i - 10) % 30 == 0) next_a = k_a++ - x;
        if (i % 20 == 0) next_b = k_b++ - (2 * x + u_a);
        x += (u_a - u_b) * 0.01;
    }
    for (const char* method : {"automatic", "dopri5", "fehlberg78", "bulirsch_stoer", "rk4", "euler"}) {
        INFO(method);
        const auto row = last_row(folder, model, {"--until", "10", "--samples", "37", "--method", method, "--step", "0.013"});
        CHECK(std::fabs(row.at("x") - x) < 1e-9 * std::fabs(x));
        CHECK(row.at("a_k") == k_a);
        CHECK(row.at("b_k") == k_b);
    }
}

TEST_CASE("parameters of controllers may be made of those of the machine, which studies vary") {
    const Folder folder;
    folder.write("hold.toml", text_of("hold", R"m(
[sampling]
every = "T"
[parameters]
T = { value = 1, unit = "s" }
K = { value = 1, unit = "1/s" }
[inputs]
x = { unit = "m" }
[outputs]
u = { value = "-K*x", unit = "m/s" }
)m"));
    const std::string model = folder.write("decay.toml", text_of("decay", R"m(
[samplers.c]
file = "hold.toml"
parameters = { T = "T_s", K = "0.1/T_s" }
measures = { x = "x" }
sets = { u = "u" }
[parameters]
T_s = { value = 0.5, unit = "s" }
[inputs]
u = { unit = "m/s" }
[states]
x = { unit = "m", start = 1, derivative = "u" }
)m"));
    // Each sample takes a tenth of x away.
    const auto closed = [](double T) { return std::pow(0.9, std::floor(10 / T)) * (1 - 0.1 * (10 / T - std::floor(10 / T))); };
    CHECK(std::fabs(last_row(folder, model, {"--until", "10"}).at("x") - std::pow(0.9, 20)) < 1e-12);
    CHECK(std::fabs(last_row(folder, model, {"--until", "10", "--parameter", "T_s=0.3"}).at("x") - closed(0.3)) < 1e-12);
    const Answer study =
        ask("study", {model, "--vary", "T_s=0.3:0.7:3", "--observe", "end(x)", "--until", "10", "--no-plot", "-o", folder.path()});
    INFO(study.err);
    REQUIRE(study.code == 0);
    std::ifstream in(folder.path() / "decay_full_study.csv");
    std::string line;
    std::vector<double> ends;
    while (std::getline(in, line))
        if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])) != 0)
            ends.push_back(std::stod(line.substr(line.rfind(',') + 1)));
    REQUIRE(ends.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::fabs(ends[i] - closed(0.3 + 0.2 * static_cast<double>(i))) < 1e-9);
}

TEST_CASE("samples and events, also at the same time: a block that a controller pushes every other second") {
    const Folder folder;
    folder.write("push.toml", text_of("push", R"m(
[sampling]
every = "1 s"
[parameters]
F = { value = 1.5, unit = "N" }
[inputs]
v = { unit = "m/s" }
[states]
k = { unit = "1", next = "1 - k" }
n = { unit = "1", next = "n + 1" }
[outputs]
F_out = { value = "F*(1 - k)", unit = "N" }
)m"));
    const auto block = [&](const std::string& force) {
        return folder.write("block.toml", text_of("block", R"m(
[samplers.push]
file = "push.toml"
parameters = { F = )m" + force + R"m( }
measures = { v = "dot(x)" }
sets = { F_out = "F" }
[inputs]
F = { unit = "N" }
[coordinates]
x = { unit = "m" }
[bodies.block]
mass = "1 kg"
position = ["x", 0, 0]
[forces.push]
on = "block"
force = ["F", 0, 0]
[frictions.ground]
rate = "dot(x)"
normal_force = "1 N"
coefficient = 1
)m"));
    };
    // A second at (F - 1 N)/m, then braked at 1 m/s^2 to rest: with 1.5 N before the next push, with 2 N just then.
    for (const auto& [force, way] : {std::pair("1.5", 0.25 + 0.125), std::pair("2", 0.5 + 0.5), std::pair("1.2", 0.1 + 0.02)}) {
        INFO(force);
        const auto row = last_row(folder, block(force), {"--until", "20.5", "--samples", "41"});
        const double a = std::stod(force) - 1;
        CHECK(row.at("push_n") == 21);
        CHECK(std::fabs(row.at("x") - (10 * way + a * 0.125)) < 1e-9);
        CHECK(std::fabs(row.at("dot(x)") - a * 0.5) < 1e-9);
    }
}

TEST_CASE("at rest an input that a controller sets is one as others; studies cannot vary it") {
    const Folder folder;
    folder.write("spring_control.toml", text_of("spring_control", R"m(
[sampling]
every = "1 ms"
[inputs]
x = { unit = "m" }
[outputs]
F = { value = "-x*(1 N/m)", unit = "N" }
)m"));
    const std::string model = folder.write("oscillator.toml", text_of("oscillator", R"m(
[samplers.c]
file = "spring_control.toml"
measures = { x = "x" }
sets = { F = "F" }
[inputs]
F = { unit = "N" }
[coordinates]
x = { unit = "m" }
[bodies.b]
mass = "1 kg"
position = ["x", 0, 0]
[springs.s]
stiffness = "4 N/m"
elongation = "x"
[forces.f]
on = "b"
force = ["F", 0, 0]
)m"));
    const Answer modal = ask("modal", {model, "--input", "F=2"});
    INFO(modal.err);
    CHECK(modal.code == 0);
    const Answer study = ask("study", {model, "--vary", "F=0:1:2", "--observe", "x", "--until", "1", "--no-plot", "-o", folder.path()});
    CHECK(study.code == 2);
    CHECK(study.err.find("input 'F' cannot be varied: sampler 'c' sets it") != std::string::npos);
}

TEST_CASE("a sample on a jump of an input sees what holds behind it") {
    const Folder folder;
    folder.write("copy.toml", text_of("copy", R"m(
[sampling]
every = "T"
[parameters]
T = { value = 0.1, unit = "s" }
[inputs]
r = { unit = "m/s" }
[states]
n = { unit = "1", next = "n + 1" }
[outputs]
w = { value = "r", unit = "m/s" }
)m"));
    const auto way = [&](const std::string& period, const std::string& input, const std::string& offset) {
        const std::string model = folder.write("follow.toml", text_of("follow", R"m(
[samplers.c]
file = "copy.toml"
parameters = { T = )m" + period + R"m( }
measures = { r = "r" }
sets = { w = "w" }
[inputs]
r = { unit = "m/s" }
w = { unit = "m/s" }
[states]
x = { unit = "m", derivative = "w" }
)m"));
        return last_row(folder, model, {"--until", "3", "--input", "r=" + input, "--samples", offset}).at("x");
    };
    for (const char* period : {"0.1", "0.125", "0.25", "0.3"}) {
        INFO(period);
        CHECK(std::fabs(way(period, "step(t - 1.5)", "7") - 1.5) < 1e-12);
        // A wave that is up for 0.75 s, as samples see it.
        const double seen = period == std::string("0.1") ? 1.6 : period == std::string("0.3") ? 1.8 : 1.5;
        CHECK(std::fabs(way(period, "if(mod(t, 1.5) < 0.75, 1, 0)", "30") - seen) < 1e-12);
    }
}

TEST_CASE("a controller in float computes in float") {
    const Folder folder;
    const auto controller = [&](const std::string& numbers) {
        return folder.write("third.toml", text_of("third", "[sampling]\nevery = \"1 s\"\nnumbers = \"" + numbers + R"m("
[inputs]
x = { unit = "m" }
[states]
z = { unit = "m", next = "z + x/3" }
[outputs]
u = { value = "z", unit = "m" }
)m"));
    };
    const std::string model = folder.write("line.toml", text_of("line", R"m(
[samplers.c]
file = "third.toml"
measures = { x = "x" }
sets = { u = "u" }
[inputs]
u = { unit = "m" }
[states]
x = { unit = "m", start = 1, derivative = "0*u/(1 s)" }
)m"));
    float z = 0;
    double exact = 0;
    for (int i = 0; i < 10; ++i) z += 1.0F / 3, exact += 1.0 / 3;
    controller("float");
    CHECK(last_row(folder, model, {"--until", "9.5"}).at("c_z") == static_cast<double>(z));
    controller("double");
    CHECK(last_row(folder, model, {"--until", "9.5"}).at("c_z") == exact);
}

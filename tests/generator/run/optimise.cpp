// SPDX-License-Identifier: GPL-3.0-or-later
// The best parameter of a run: against the formulas of (2.64) and (2.65), against an integration by hand, and where there is none.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "generator/command/verb.hpp"
#include "run/optimum.hpp"

using namespace dalembert;

namespace {

Answer optimise(const std::vector<std::string>& arguments) { return ask("optimise", arguments); }

const std::string projectile = SOURCE_DIR "/systems/mechanics/projectile.toml";
constexpr double g = 9.81, h = 1.8, v = 25, m = 0.145, drag = 0.47 * 42.5e-4 * 1.2 / 2;

/// Distance of a throw with drag: RK4 with small steps, the last one by Newton's method onto the ground.
double distance_with_drag(double alpha) {
    using State = std::array<double, 4>;
    const auto rate = [](const State& x) {
        const double speed = std::hypot(x[2], x[3]);
        return State{x[2], x[3], -drag / m * speed * x[2], -g - drag / m * speed * x[3]};
    };
    const auto step = [&](const State& x, double dt) {
        const auto ahead = [&](const State& k, double by) {
            State y = x;
            for (std::size_t i = 0; i < 4; ++i) y[i] += by * k[i];
            return y;
        };
        const State a = rate(x), b = rate(ahead(a, dt / 2)), c = rate(ahead(b, dt / 2)), d = rate(ahead(c, dt));
        State y = x;
        for (std::size_t i = 0; i < 4; ++i) y[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        return y;
    };
    State x{0, h, v * std::cos(alpha), v * std::sin(alpha)};
    constexpr double dt = 1e-3;
    for (State next = step(x, dt); next[1] > 0; next = step(x, dt)) x = next;
    double left = 0;
    for (int i = 0; i < 20; ++i) left -= step(x, left)[1] / step(x, left)[3];
    return step(x, left)[0];
}

}  // namespace

TEST_CASE("the best angle in vacuum is (2.65), its distance (2.64)") {
    const Answer answer =
        optimise({projectile, "--run", "flight_vacuum", "--maximise", "distance", "--over", "alpha=10deg:80deg", "--format", "json"});
    REQUIRE(answer.code == 0);
    CHECK(answer.err.empty());
    const auto json = answer.json();
    const double alpha = std::atan(v / std::sqrt(v * v + 2 * g * h));
    const double distance = v * std::cos(alpha) * (v * std::sin(alpha) + std::sqrt(v * v * std::pow(std::sin(alpha), 2) + 2 * g * h)) / g;
    CHECK(std::fabs(json.at("at").get<double>() - alpha) < 1e-7);
    CHECK(std::fabs(json.at("at").get<double>() - alpha) <= json.at("at_error").get<double>() + 1e-11);
    CHECK(std::fabs(json.at("value").get<double>() / distance - 1) < 1e-12);
    CHECK(json.at("place") == "inside");
    CHECK(json.at("event") == "ground");
    CHECK(json.at("others").empty());
    const auto x = [](double a) {
        return v * std::cos(a) * (v * std::sin(a) + std::sqrt(v * v * std::pow(std::sin(a), 2) + 2 * g * h)) / g;
    };
    const double curvature = (x(alpha + 1e-3) - 2 * x(alpha) + x(alpha - 1e-3)) / 1e-6;
    CHECK(std::fabs(json.at("second_derivative").get<double>() / curvature - 1) < 1e-4);
}

TEST_CASE("with drag, where no formula exists") {
    const Answer answer =
        optimise({projectile, "--run", "flight", "--maximise", "distance", "--over", "alpha=10deg:80deg", "--format", "json"});
    REQUIRE(answer.code == 0);
    const auto json = answer.json();
    const double alpha = json.at("at").get<double>();
    CHECK(std::fabs(json.at("value").get<double>() / distance_with_drag(alpha) - 1) < 1e-9);
    // The slope of the integration by hand vanishes there.
    const double slope = (distance_with_drag(alpha + 1e-3) - distance_with_drag(alpha - 1e-3)) / 2e-3;
    CHECK(std::fabs(slope / json.at("second_derivative").get<double>()) < 1e-6);
    CHECK(alpha < std::atan(v / std::sqrt(v * v + 2 * g * h)));
}

TEST_CASE("what is minimised, several optima, ends of the range, runs that stop") {
    const Folder folder;
    const std::string head =
        "[model]\nformat = 1\nname = \"waves\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\nw = { value = 1, unit = \"1/s\" }\n"
        "[coordinates]\nq = { unit = \"m\", start_rate = 1 }\n[bodies.b]\nmass = \"m\"\nposition = [\"q\", 0, 0]\n[runs.reference]\nuntil "
        "= 1\n";
    const std::string waves = folder.write("waves.toml", head + "[outputs]\ny = { value = \"q*sin(w*t)*exp(-w*t/10)\", unit = \"m\" }\n");
    const Answer several = optimise({waves, "--maximise", "y", "--over", "w=0.5:10", "--format", "json"});
    REQUIRE(several.code == 0);
    CHECK(several.err.find("another local optimum") != std::string::npos);
    CHECK(several.json().at("others").size() == 1);
    CHECK(std::fabs(several.json().at("at").get<double>() - std::atan(10.0)) < 1e-6);
    const Answer least = optimise({waves, "--minimise", "y", "--over", "w=3:6", "--format", "json"});
    REQUIRE(least.code == 0);
    CHECK(std::fabs(least.json().at("at").get<double>() - std::atan(10.0) - std::acos(-1.0)) < 1e-6);
    CHECK(least.json().at("value").get<double>() < 0);
    CHECK(least.json().at("second_derivative").get<double>() > 0);
    const Answer end = optimise({waves, "--maximise", "y", "--over", "w=2:4", "--format", "json"});
    REQUIRE(end.code == 0);
    CHECK(end.err.find("at the lower end of the range of 'w'") != std::string::npos);
    CHECK(end.json().at("place") == "low");
    CHECK(end.json().at("at").get<double>() == 2);
    CHECK(end.json().at("second_derivative").is_null());
    const Answer energy = optimise({waves, "--maximise", "kinetic_energy", "--over", "m=1:2"});
    REQUIRE(energy.code == 0);
    CHECK(energy.out.find("kinetic_energy 1 J,") != std::string::npos);
    const std::string breaks = folder.write("breaks.toml", head + "[states]\nz = { unit = \"1\", start = 1, derivative = \"w*z^2\" }\n");
    const Answer stopped = optimise({breaks, "--maximise", "z", "--over", "w=0.1:2"});
    CHECK(stopped.code == 4);
    CHECK(stopped.err.find("the run does not reach its end") != std::string::npos);
    CHECK(stopped.out.empty());
}

TEST_CASE("bad questions") {
    const auto asked = [](std::vector<std::string> arguments, const char* sentence) {
        arguments.insert(arguments.begin(), projectile);
        const Answer answer = optimise(arguments);
        CAPTURE(answer.err);
        CHECK(answer.code == 2);
        CHECK(answer.out.empty());
        CHECK(answer.err.find(sentence) != std::string::npos);
    };
    asked({"--run", "flight", "--maximise", "distanse", "--over", "alpha=10deg:80deg"}, "has no output or state 'distanse'");
    asked({"--run", "flight", "--maximise", "distance", "--over", "beta=10deg:80deg"}, "'beta' of scene 'flight' does not exist");
    asked({"--run", "flying", "--maximise", "distance", "--over", "alpha=10deg:80deg"}, "the model has no run 'flying'");
    asked({"--run", "flight", "--maximise", "distance", "--over", "alpha=80deg:10deg"}, "give the smaller value first");
    asked({"--run", "flight", "--maximise", "distance", "--over", "alpha=0deg:80deg"}, "its range begins at");
    asked({"--run", "flight", "--maximise", "distance", "--over", "alpha=10m:80m"},
          "the value of 'alpha' must be in '1', but '10m' is in 'm'");
    asked({"--run", "flight", "--maximise", "distance", "--over", "alpha=10deg"}, "is not of the form PARAMETER=LOW:HIGH");
    asked({"--run", "flight", "--over", "alpha=10deg:80deg"}, "give either --maximise OUTPUT or --minimise OUTPUT");
}

TEST_CASE("the largest value of a function") {
    const OptimumSearch smooth = find_maximum([](double x) { return std::sin(x); }, 0, 3, 5);
    CHECK(std::fabs(smooth.best.at - std::acos(0.0)) < 1e-9);
    CHECK(std::fabs(*smooth.curvature + 1) < 1e-6);
    const OptimumSearch kink = find_maximum([](double x) { return -std::fabs(x - 1.2345); }, 0, 3, 9);
    CHECK(std::fabs(kink.best.at - 1.2345) < 1e-6);
    const OptimumSearch tiny = find_maximum([](double x) { return x * (2e-6 - x); }, 0, 3e-6, 9);
    CHECK(std::fabs(tiny.best.at / 1e-6 - 1) < 1e-7);
    const OptimumSearch global = find_maximum([](double x) { return std::sin(x) + x / 10; }, 0, 17, 33);
    CHECK(global.best.at > 13);
    CHECK(global.others.size() == 2);
    CHECK(find_maximum([](double) { return 2.0; }, 0, 1, 5).is_constant);
    CHECK(find_maximum([](double x) { return x; }, 0, 1, 5).best.place == Optimum::Place::at_high);
}

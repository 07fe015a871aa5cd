// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy against time: the errors that are told against integrations by hand and formulas, references, stopped measurements, budgets.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "generator/command/verb.hpp"
#include "report/budget.hpp"
#include "report/precision_table.hpp"

using namespace dalembert;

namespace {

const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;  // each measurement compiles a program of its own

Answer cost(const std::vector<std::string>& arguments) { return ask("cost", arguments); }

/// q'' = c q/m from q = 1, q' = rate.
std::string one_mass(const char* stiffness, const char* rate, const char* until) {
    return std::string(
               "[model]\nformat = 1\nname = \"mass\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\na = { value = 1, unit = \"m\" }\nc = "
               "{ value = ") +
           stiffness + ", unit = \"N/m\" }\n[coordinates]\nq = { unit = \"m\", start = 1, start_rate = " + rate +
           " }\n[bodies.b]\nmass = \"m\"\nposition = [\"q\", 0, 0]\n[potentials.p]\nenergy = \"c*q^2/2\"\n[runs.reference]\nuntil = " +
           until + "\n";
}

/// The classical Runge-Kutta method for q'' = -q in double, seen at 51 points: largest errors of q and q', which are 1 at most.
double error_of_rk4(std::size_t steps, double until) {
    std::array<double, 2> x{1, 0};
    const double h = until / static_cast<double>(steps);
    double error = 0;
    for (std::size_t i = 1; i <= steps; ++i) {
        const auto [q, v] = x;
        const double k1 = v, l1 = -q, k2 = v + h / 2 * l1, l2 = -(q + h / 2 * k1), k3 = v + h / 2 * l2, l3 = -(q + h / 2 * k2),
                     k4 = v + h * l3, l4 = -(q + h * k3);
        x = {q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)};
        const double t = h * static_cast<double>(i);
        if (i % (steps / 50) == 0) error = std::max({error, std::fabs(x[0] - std::cos(t)), std::fabs(x[1] + std::sin(t))});
    }
    return error;
}

}  // namespace

TEST_CASE("errors of an oscillator are those of an integration by hand, and a stopped measurement goes on" * doctest::skip(!is_full)) {
    const Folder place;
    const std::string model = place.write("mass.toml", one_mass("1", "0", "10"));
    const std::vector<std::string> call{model, "--methods", "rk4,dopri5", "--arithmetics", "float,double", "--limit",
                                        "2",   "--no-plot", "--format",   "json",          "-o",           place.path()};
    // Results cannot be written where a folder is in the way: what was measured stays.
    std::filesystem::create_directory(place.path() / "mass_cost.csv");
    const Answer stopped = cost(call);
    CHECK(stopped.code == 3);
    const std::filesystem::path unfinished = place.path() / "mass_full_cost.unfinished";
    REQUIRE(std::filesystem::exists(unfinished));
    std::filesystem::remove(place.path() / "mass_cost.csv");
    const Answer told = cost(call);
    REQUIRE(told.code == 0);
    CHECK(told.err.find("continues after") != std::string::npos);
    CHECK(!std::filesystem::exists(unfinished));
    CHECK(std::filesystem::exists(place.path() / "mass_cost.csv"));

    const nlohmann::json machine = told.json()["machines"][0];
    CHECK(machine["reference"]["arithmetic"] == "digits50");
    CHECK(machine["reference"]["error"] < 1e-18);
    CHECK(machine["reference"]["growth"] < 3);
    CHECK(machine["reference"]["counted_until"] == 10);
    double best_float = 1, best_double = 1, least = 1e300;
    int compared = 0;
    for (const auto& run : machine["runs"]) {
        REQUIRE(run["good"] == true);
        const double error = run["error_on_the_way"];
        CHECK(error >= run["error_at_end"]);
        double& best = run["arithmetic"] == "float" ? best_float : best_double;
        best = std::min(best, error);
        if (error <= 1e-6) least = std::min(least, run["microseconds"]["lowest"].get<double>());
        if (run["method"] != "rk4" || run["arithmetic"] != "double" || error < 1e-12) continue;
        const auto steps = static_cast<std::size_t>(std::lround(10 / run["step"].get<double>()));
        CHECK(run["steps"] == steps);
        CHECK(error == doctest::Approx(error_of_rk4(steps, 10)).epsilon(1e-3));
        ++compared;
    }
    CHECK(compared >= 6);
    CHECK(best_float > 1e-8);
    CHECK(best_float < 1e-4);
    CHECK(best_double < 1e-11);
    for (const auto& row : machine["cheapest"])
        if (row["error"] == 1e-6) CHECK(row["microseconds"] == least);
}

TEST_CASE("where a disturbance grows like exp(t), errors are counted as long as it is small" * doctest::skip(!is_full)) {
    const Folder place;
    const std::string model = place.write("mass.toml", one_mass("-1", "-1", "25"));
    const Answer told = cost(
        {model, "--methods", "dopri5", "--arithmetics", "double", "--limit", "2", "--no-plot", "--format", "json", "-o", place.path()});
    REQUIRE(told.code == 0);
    const nlohmann::json reference = told.json()["machines"][0]["reference"];
    CHECK(reference["growth"] > 1e10);
    CHECK(reference["growth"] < 1e11);
    CHECK(reference["counted_until"] == doctest::Approx(11.5).epsilon(0.05));  // exp(11.5) = 1e5
}

TEST_CASE("a closed form is the reference of its outputs; a wrong one is refused" * doctest::skip(!is_full)) {
    const Folder place;
    const std::string model = one_mass("1", "0", "10");
    const auto with = [&](const std::string& form) {
        return cost({place.write("mass.toml", model + "exact = { q = \"" + form + "\" }\n"), "--methods", "rk4", "--arithmetics", "double",
                     "--limit", "2", "--no-plot", "--format", "json", "-o", place.path()});
    };
    const Answer right = with("a*cos(sqrt(c/m)*t)");
    REQUIRE(right.code == 0);
    CHECK(right.json()["machines"][0]["reference"]["closed_forms"] == nlohmann::json{"q"});
    for (const auto& run : right.json()["machines"][0]["runs"])
        if (run["step"] == 0.1) CHECK(run["error_on_the_way"] == doctest::Approx(error_of_rk4(100, 10)).epsilon(1e-2));
    const Answer wrong = with("a*cos(1.001*sqrt(c/m)*t)");
    CHECK(wrong.code == 1);
    CHECK(wrong.err.find("the closed form of 'q' differs from the run: at t = 0.2 s") != std::string::npos);
}

TEST_CASE("a budget is kept, or refused with what would be needed") {
    const Folder place;
    const std::string model = place.write("mass.toml", one_mass("1", "0", "10"));
    const Answer fits = cost(
        {model, "--budget", "10 ms step, 1 ms", "--methods", "euler,rk4", "--arithmetics", "double", "--limit", "2", "--format", "json"});
    REQUIRE(fits.code == 0);
    const nlohmann::json json = fits.json();
    CHECK(json["budget"]["step"] == 0.01);
    CHECK(json["budget"]["time"] == 0.001);
    CHECK(json["best"]["method"] == "rk4");
    CHECK(json["best"]["arithmetic"] == "double");
    for (const auto& candidate : json["candidates"])
        if (candidate["method"] == "rk4" && candidate["arithmetic"] == "double" && candidate["parts"] == 1)
            CHECK(candidate["error"] == doctest::Approx(error_of_rk4(1000, 10)).epsilon(1e-2));
    const Answer never =
        cost({model, "--budget", "10 ms step, 1e-6 us", "--methods", "euler,rk4", "--arithmetics", "double", "--limit", "2"});
    CHECK(never.code == 1);
    CHECK(never.out.find("none fits: the fastest that reaches the end takes") != std::string::npos);
    const Answer coarse = cost({model, "--budget", "1 s step, 1 ms", "--methods", "rk4", "--limit", "2"});
    CHECK(coarse.code == 2);
    CHECK(coarse.err.find("takes 10 s, which is less than 50 steps of 1 s") != std::string::npos);
}

TEST_CASE("bad questions about cost") {
    const auto refused = [](const std::vector<std::string>& arguments, const std::string& sentence) {
        const Answer told = cost(arguments);
        CHECK(told.code == 2);
        CHECK_MESSAGE(told.err.find(sentence) != std::string::npos, told.err);
    };
    const std::string pendulum = SOURCE_DIR "/systems/mechanics/pendulum.toml";
    refused({pendulum, "--budget", "20 us"}, "'--budget 20 us' is not of the form 'STEP step, TIME'");
    refused({pendulum, "--budget", "1 kg step, 20 us"}, "a budget is a time, in 's', not in 'kg'");
    refused({pendulum, "--budget", "1 ms step, soon"}, "'soon' is not a time such as '20 us'");
    refused({pendulum, "--budget", "1 ms step, 0 us"}, "longer than zero");
    refused({pendulum, pendulum, "--scene", "full"}, "--scene needs a single model");
    refused({pendulum, pendulum, "--budget", "1 ms step, 20 us"}, "--budget needs a single model");
    refused({pendulum, "--methods", "rk5"}, "rk5");
    refused({pendulum, "--size", "N=3"}, "'N'");
}

TEST_CASE("rows of a measurement are read back, and only whole ones") {
    const WorkPoint point{{"double", "rk4", 0, 0.1}, "success", 10, 100, 0, 401, 12.5, 12, 13, 1e-7, 2e-7, 3e-8, 0, true};
    const std::string line = csv_line("full", "N=3", point);
    const auto read = read_csv_line(line.substr(0, line.size() - 1));
    REQUIRE(read);
    CHECK(csv_line("full", "N=3", *read) == line);
    CHECK(!read_csv_line(line.substr(0, line.size() / 2)));
}

TEST_CASE("differences are relative to columns, and what is zero but for errors is not compared") {
    const Rows exact{{0, 2, 1e-20L}, {1, -4, 0}, {2, 0, 3e-20L}}, other{{0, 2, 0}, {1, -4.04L, 5e-20L}, {2, 0.08L, 0}};
    const std::vector<double> scales = scales_of(exact, {{0, 2, 2e-20L}, {1, -4, 0}, {2, 1e-10L, 0}});
    CHECK(scales == std::vector<double>{4, 0});
    const std::vector<double> seen = differences(other, exact, scales);
    CHECK(seen[0] == 0);
    CHECK(seen[1] == doctest::Approx(0.01));
    CHECK(seen[2] == doctest::Approx(0.02));
}

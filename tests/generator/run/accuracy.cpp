// SPDX-License-Identifier: GPL-3.0-or-later
// The digits of generated functions: known losses are reported, exact functions are not accused, and every kind of point is what its name
// says.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "generator/command/verb.hpp"
#include "generator/machine.hpp"
#include "run/accuracy_measurement.hpp"
#include "tier.hpp"

using namespace dalembert;

namespace {

/// One body; y is what is looked at.
std::string model_with(const std::string& output, const std::string& range = "[0.0001, 1]") {
    return "[model]\nformat = 1\nname = \"digits\"\n[parameters]\nm = { value = 1, unit = \"kg\" }\nl = { value = 1, unit = \"m\" "
           "}\n[coordinates]\nx = { unit = \"1\", start = 0.5, range = " +
           range + " }\nz = { unit = \"1\", start = 0.5, range = " + range +
           " }\n[bodies.b]\nmass = \"m\"\nposition = [\"l*x\", \"l*z\", 0]\n[outputs]\ny = { value = \"" + output + "\", unit = \"1\" }\n";
}

nlohmann::json function(const nlohmann::json& told, const std::string& name) {
    for (const auto& row : told["functions"])
        if (row["function"] == name) return row["errors"];
    FAIL("no function " << name);
    return {};
}

Answer accuracy(const std::string& text, const std::vector<std::string>& more = {}) {
    const Folder place;
    std::vector<std::string> arguments{place.write("digits.toml", text), "--points", "400", "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Answer told = ask("accuracy", arguments);
    INFO(told.err);
    REQUIRE(told.code <= 1);
    return told;
}

}  // namespace

TEST_CASE("1 - cos(x) loses 1/x^2, and that is above the limit") {
    const Answer told = accuracy(model_with("1 - cos(x)"), {"--without", "rewriting"});
    CHECK(told.code == 1);
    for (const char* arithmetic : {"float", "double"}) {
        CAPTURE(arithmetic);
        const nlohmann::json worst = function(told.json(), "output")[arithmetic];
        const double x = worst["worst"]["at"]["x"], largest = worst["largest"];
        // cos(x) is rounded by up to 2^-p/2 below one; of x^2/2 an ulp is 2^-p times it at most and half of that at least, and half an ulp
        // of x moves it by as much as two of its own.
        CHECK(largest * x * x < 2);
        const bool all_is_lost = worst["worst"]["computed"] == 0.0;
        if (!all_is_lost)
            CHECK(largest * x * x > 0.02);
        else
            CHECK(largest > 1e6);
        CHECK(x < 0.01);
        const double expected = std::stod(worst["worst"]["exact"].get<std::string>());
        CHECK(std::fabs(expected / (2 * std::pow(std::sin(x / 2), 2)) - 1) < 1e-14);
    }
}

TEST_CASE("rewritten, 1 - cos(x) and sin(x)/x keep their digits") {
    const Answer wave = accuracy(model_with("1 - cos(x)"));
    CHECK(wave.code == 0);
    CHECK(function(wave.json(), "output")["double"]["largest"].get<double>() < 2);
    CHECK(function(wave.json(), "output")["float"]["largest"].get<double>() < 2);
    const Answer quotient = accuracy(model_with("sin(x)/x", "[-1, 1]"));
    CHECK(function(quotient.json(), "output")["double"]["largest"].get<double>() < 2);
    const Folder place;
    const Answer told = ask("accuracy", {place.write("digits.toml", model_with("1 - cos(x)")), "--points", "10", "--explain"});
    CHECK(told.out.find("1 - cos(x): outputs in 1 place") != std::string::npos);
}

TEST_CASE("a difference of squares loses digits of equal values, but no more than its inputs do") {
    const Answer told = accuracy(model_with("x^2 - z^2", "[0.5, 1]"));
    CHECK(told.code == 0);
    const nlohmann::json errors = function(told.json(), "output")["double"];
    CHECK(errors["largest_plain"].get<double>() > 1000);
    CHECK(errors["largest"].get<double>() < 1.5);
}

TEST_CASE("what is good is told to be good") {
    const Answer told = accuracy(model_with("2*x"));
    CHECK(told.code == 0);
    CHECK(function(told.json(), "output")["double"]["largest_plain"] == 0.0);
    const Answer root = accuracy(model_with("sqrt(x)"));
    CHECK(root.code == 0);
    CHECK(function(root.json(), "output")["double"]["largest_plain"].get<double>() <= 0.5);
    CHECK(function(root.json(), "output")["double"]["largest_plain"].get<double>() > 0.4);
}

TEST_CASE("the limit decides the exit code, and the seed the points") {
    const std::string text = model_with("sin(x) + z");
    CHECK(accuracy(text).code == 0);
    CHECK(accuracy(text, {"--limit", "0.1"}).code == 1);
    CHECK(accuracy(text).out == accuracy(text).out);
    CHECK(accuracy(text).out != accuracy(text, {"--seed", "2"}).out);
}

TEST_CASE("every kind of point is what it says") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 2, unit = \"kg\", range = [0.1, 10] }\nk = { value = 1, unit = \"kg\", range = [0.1, 10] }\n"
        "[coordinates]\nx = { unit = \"m\", range = [-1, 3] }\nz = { unit = \"m\", range = [0, 2] }\nphi = { unit = \"rad\" }\n"
        "[bodies.a]\nmass = \"m\"\nposition = [\"x\", \"z\", 0]\n[bodies.b]\nmass = \"k\"\nposition = [\"cos(phi)*x\", \"sin(phi)*x\", "
        "0]\n");
    const std::vector<const Variable*> inputs = ExactCode::inputs(*machine.system);
    for (const Arithmetic* arithmetic : {&float_arithmetic(), &double_arithmetic()}) {
        EdgePoints points(*machine.system, inputs, *arithmetic, 7);
        std::map<std::string, int> seen;
        for (int i = 0; i < 700; ++i) {
            const EdgePoint point = points.next();
            std::map<std::string, double> at;
            for (std::size_t k = 0; k < inputs.size(); ++k) {
                at[inputs[k]->name] = point.values[k];
                if (arithmetic->digits == 24) CHECK(static_cast<double>(static_cast<float>(point.values[k])) == point.values[k]);
            }
            const double x = at["x"], z = at["z"], phi = at["phi"];
            CHECK((x >= -1 && x <= 3 && z >= 0 && z <= 2));
            // The tenth of the range is not among the numbers: what lies next to it inside is.
            CHECK(exact(at["m"]) >= Rational(1) / 10);
            const std::string kind = point.kind;
            if (kind == "near zero" || kind == "tiny to huge") seen[kind] += std::fabs(x) < 1e-3 && x != 0;
            if (kind == "equal values") seen[kind] += x == z || at["m"] == at["k"];
            if (kind == "equal values") seen["next to each other"] += x != z && arithmetic->next(x, z) == z;
            if (kind == "ends of ranges") seen[kind] += x == -1 || x == 3;
            if (kind == "signs of zero") seen[std::signbit(x) ? "-0" : "+0"] += x == 0;
            if (kind == "quarter turns") seen[kind] += phi != 0 && std::fabs(std::remainder(phi, std::acos(-1.0) / 2)) < 1e-6;
        }
        for (const char* kind :
             {"near zero", "tiny to huge", "equal values", "next to each other", "ends of ranges", "-0", "+0", "quarter turns"}) {
            CAPTURE(kind);
            CHECK(seen[kind] >= 5);
        }
    }
}

TEST_CASE("an ulp is the distance of numbers") {
    for (const double value : {1.0, 1.5, 0.75, 3e-310, 1e300, 0.0})
        CHECK(double_arithmetic().ulp(value) == std::nextafter(value, std::numeric_limits<double>::infinity()) - value);
    for (const float value : {1.0F, 1.5F, 0.75F, 1e-40F, 0.0F})
        CHECK(float_arithmetic().ulp(value) ==
              static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity())) - static_cast<double>(value));
    CHECK(exact(0x1p-1074) == cln::expt(cln::cl_RA(2), -1074));
    CHECK(exact(-0.375) == Rational(-3) / 8);
}

TEST_CASE("exact numbers have slopes") {
    const ExactArithmetic arithmetic(60);
    const MaybeExact x = arithmetic.input(Rational(1) / 2, 0, 2), y = arithmetic.input(3, 1, 2);
    const auto slopes = [](const MaybeExact& number) { return std::pair{number->slopes[0], number->slopes[1]}; };
    CHECK(slopes(ExactArithmetic::product({&x, &y, &y})) == std::pair{9.0, 3.0});
    CHECK(slopes(ExactArithmetic::sum({&x, &y}, {false, true})) == std::pair{1.0, -1.0});
    CHECK(slopes(ExactArithmetic::reciprocal(x)).first == -4);
    CHECK(std::fabs(slopes(arithmetic.function(Op::tan, {&x})).first - 1 / std::pow(std::cos(0.5), 2)) < 1e-14);
    CHECK(std::fabs(slopes(arithmetic.function(Op::atan2, {&x, &y})).second + 0.5 / 9.25) < 1e-15);
    CHECK(slopes(arithmetic.function(Op::max, {&x, &y})) == std::pair{0.0, 1.0});
    const MaybeExact negative = arithmetic.constant(-1);
    CHECK(!arithmetic.function(Op::sqrt, {&negative}));
    CHECK(!ExactArithmetic::reciprocal(arithmetic.constant(0)));
    CHECK(cln::double_approx(arithmetic.function(Op::sin, {&x})->value) == std::sin(0.5));
}

TEST_CASE("nodes that are eliminated, enthalpies, and powers of flows that come and go keep their digits") {
    int seen = 0;
    for (const auto& one : {std::pair("heat/immersion_heater", "heating"), std::pair("heat/block", "steady"),
                            std::pair("heat/layered_wall", "gaps"), std::pair("heat/glazing", "mirrors"),
                            std::pair("hydraulics/hydraulic_cylinder", "real"), std::pair("hydraulics/torricelli", "book")}) {
        if (!is_full_tier() && ++seen > 2) break;
        CAPTURE(one.first);
        const std::filesystem::path path = std::filesystem::path(SOURCE_DIR) / "systems" / (std::string(one.first) + ".toml");
        CHECK(ask("accuracy", {path, "--scene", one.second, "--points", "100"}).code == 0);
    }
}

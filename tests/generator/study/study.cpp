// SPDX-License-Identifier: GPL-3.0-or-later
// Studies of a model with closed forms, and what is refused.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "generator/command/verb.hpp"
#include "text/process.hpp"

using namespace dalembert;

namespace {

const std::string forms = SOURCE_DIR "/tests/study/forms.toml";

Answer study(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), forms);
    return ask("study", arguments);
}

std::vector<std::string> lines_of(const std::string& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    return fields;
}

/// What is no number is NaN.
std::vector<double> numbers_of(const std::string& line) {
    std::vector<double> numbers;
    for (const std::string& field : fields_of(line)) {
        char* end = nullptr;
        const double number = std::strtod(field.c_str(), &end);
        numbers.push_back(end == field.c_str() ? std::nan("") : number);
    }
    return numbers;
}

}  // namespace

TEST_CASE("indices of what is linear are the parts of the variance, and the mean is that of the means") {
    const ScratchFolder scratch;
    const Answer answer =
        study({"--vary", "a=uniform(0, 1), b=uniform(0, 1)", "--vary", "v_0=normal(0, 0.1)", "--indices", "--runs", "5120", "--observe",
               "x, end(x)^2 + 1m^2, max(x) - min(x), ishigami", "--no-plot", "--format", "json", "-o", scratch.path()});
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    const auto json = answer.json();
    const auto& x = json.at("observed")[0];
    CHECK(std::fabs(x.at("mean").get<double>() - 0.75) < 0.002);
    const double of_a = 1.0 / 48, of_b = 1.0 / 12, of_v = 0.01, whole = of_a + of_b + of_v;
    const double parts[] = {of_a / whole, of_b / whole, of_v / whole};
    CHECK(std::fabs(x.at("deviation").get<double>() / std::sqrt(whole) - 1) < 0.01);
    for (std::size_t i = 0; i < 3; ++i)
        for (const char* kind : {"first", "total"}) {
            const auto& index = x.at("indices")[i];
            CHECK(std::fabs(index.at(kind).get<double>() - parts[i]) < 3 * index.at(std::string(kind) + "_error").get<double>());
        }
    CHECK(json.at("observed")[1].at("unit") == "m^2");
    CHECK(json.at("observed")[3].at("indices").empty());
}

TEST_CASE("parameters, start values and inputs: each row has the closed form") {
    const ScratchFolder scratch;
    const Answer answer = study({"--vary", "a=uniform(-5, 5), u=-1:1:3, x=normal(1, 10 %), dot(x)=uniform(-1, 1)", "--sampling", "sobol",
                                 "--runs", "30", "--observe", "x, start(x), end(t)", "--no-plot", "-o", scratch.path()});
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    const auto lines = lines_of(std::string(scratch.path()) + "/forms_full_study.csv");
    REQUIRE(lines.size() == 32);
    CHECK(lines[1] == "run,status,t [s],a [N],u [N],x [m],dot(x) [m/s],end(x) [m],start(x) [m],end(t) [s]");
    for (std::size_t run = 0; run < 30; ++run) {
        double a, u, x, v, end, start;
        unsigned long number;
        REQUIRE(std::sscanf(lines[run + 2].c_str(), "%lu,success,1,%lf,%lf,%lf,%lf,%lf,%lf", &number, &a, &u, &x, &v, &end, &start) == 7);
        CHECK(number == run);
        CHECK(start == x);
        CHECK(u == static_cast<double>(run % 3) - 1);
        CHECK(std::fabs(end - (x + v + (a + 2 + u) / 2)) < 1e-9);
    }
}

TEST_CASE("the end of a run does not depend on whether its samples are seen") {
    const auto ends = [](const std::string& observe) {
        const ScratchFolder scratch;
        const Answer answer = ask("study", {SOURCE_DIR "/systems/mechanics/cart_pendulum.toml", "--vary", "m_W=0.9:1.1:5", "--observe",
                                            observe, "--no-plot", "-o", scratch.path()});
        INFO(answer.err);
        REQUIRE(answer.code == 0);
        std::vector<std::string> values;
        for (const std::string& line : lines_of(std::string(scratch.path()) + "/cart_pendulum_lab_study.csv"))
            values.push_back(line.substr(line.rfind(',')));
        REQUIRE(values.size() == 7);
        values.erase(values.begin(), values.begin() + 2);
        return values;
    };
    CHECK(ends("s") == ends("max(s), s"));
}

TEST_CASE("a study keeps numbers of its runs, also where it asks for outputs or energies alone") {
    struct Case {
        const char *model, *vary, *column;
    };
    for (const Case& one : {Case{"mechanics/cart_pendulum", "m_W=0.9:1.1:3", "tip"},
                            Case{"mechanics/cart_pendulum", "m_W=0.9:1.1:3", "kinetic_energy"},
                            Case{"mechanics/bouncing_ball", "e=0.7:0.9:3", "potential_energy"},
                            Case{"mechanics/bouncing_ball", "e=0.7:0.9:3", "energy"},
                            Case{"mechanics/four_bar", "m_a=0.3:0.5:3", "kinetic_energy"},
                            Case{"mechanics/four_bar", "m_a=0.3:0.5:3", "f_x"},
                            Case{"drives/sampled_servo", "J=30:50:3", "work"},
                            Case{"drives/sampled_servo", "J=30:50:3", "phi"},
                            Case{"drives/sampled_servo", "J=30:50:3", "speed_z"}}) {
        INFO(one.model << " " << one.column);
        const ScratchFolder scratch;
        std::string observed;
        for (const char* kind : {"start", "end", "max", "min"}) observed += fmt::format("{}({}),", kind, one.column);
        observed.pop_back();
        std::vector<std::string> arguments{fmt::format("{}/systems/{}.toml", SOURCE_DIR, one.model), "--vary", one.vary, "--observe",
                                           observed, "--no-plot", "-o", scratch.path()};
        REQUIRE(ask("study", arguments).code == 0);
        arguments.insert(arguments.end(), {"--only", "1"});
        REQUIRE(ask("study", arguments).code == 0);
        std::vector<double> kept, column;
        for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
            const auto lines = lines_of(entry.path().string());
            if (entry.path().string().ends_with("_study.csv")) {
                kept = numbers_of(lines[3]);
                continue;
            }
            const auto titles = fields_of(lines[0]);
            const auto place = std::find_if(titles.begin(), titles.end(), [&](const std::string& title) {
                return title == one.column || title.starts_with(one.column + std::string(" ["));
            });
            REQUIRE(place != titles.end());
            for (std::size_t i = 1; i < lines.size(); ++i) column.push_back(numbers_of(lines[i])[place - titles.begin()]);
        }
        REQUIRE(column.size() > 2);
        const auto [least, most] = std::minmax_element(column.begin(), column.end());
        CHECK(std::vector<double>(kept.end() - 4, kept.end()) == std::vector<double>{column.front(), column.back(), *most, *least});
    }
}

TEST_CASE("a start value that is made of what varies moves with it") {
    const ScratchFolder scratch;
    const Answer answer = study({"--vary", "v_0=0:4:5", "--observe", "start(dot(x))", "--no-plot", "-o", scratch.path()});
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    const auto lines = lines_of(std::string(scratch.path()) + "/forms_full_study.csv");
    CHECK(lines[5] == "3,success,1,3,3");
}

TEST_CASE("a run that cannot be made is a row, and in no statistics") {
    const ScratchFolder scratch;
    const Answer answer = study({"--vary", "m=-1:2:4", "--observe", "x", "--no-plot", "--format", "json", "-o", scratch.path()});
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    CHECK(answer.json().at("left_out") == 2);
    CHECK(answer.json().at("observed")[0].at("count") == 2);
    const auto lines = lines_of(std::string(scratch.path()) + "/forms_full_study.csv");
    CHECK(lines[2].starts_with("0,refused: "));
    CHECK(lines[2].ends_with(",nan"));
}

TEST_CASE("what makes no study is refused with a sentence, and nothing is written") {
    const ScratchFolder scratch;
    const auto refused = [&](std::vector<std::string> arguments, const std::string& sentence) {
        arguments.insert(arguments.end(), {"--no-plot", "-o", scratch.path()});
        const Answer answer = study(arguments);
        CAPTURE(sentence);
        CAPTURE(answer.err);
        CHECK(answer.code == 2);
        CHECK(answer.err.find(sentence) != std::string::npos);
    };
    refused({}, "nothing is varied");
    refused({"--vary", "q=0:1:2"}, "has no parameter, coordinate, velocity, state or input 'q'");
    refused({"--vary", "a=0:1"}, "a grid is written LOW:HIGH:COUNT");
    refused({"--vary", "a=0:1:0"}, "is no number of grid points");
    refused({"--vary", "a=1:0:3"}, "must be smaller than the last one");
    refused({"--vary", "a=gauss(0, 1)", "--runs", "5"}, "is neither a grid LOW:HIGH:COUNT nor a distribution");
    refused({"--vary", "a=normal(0)", "--runs", "5"}, "normal takes 2 numbers");
    refused({"--vary", "a=normal(0, 5 %)", "--runs", "5"}, "the standard deviation of 'a' must be above zero");
    refused({"--vary", "a=normal(1, 2)"}, "give --runs");
    refused({"--vary", "b=-1:1:3"}, "but its range begins at 0 N");
    refused({"--vary", "b=normal(0, 1), a=0:1:2, b=0:1:2", "--runs", "4"}, "'b' is varied twice");
    refused({"--vary", "a=0:1:3", "--runs", "4"}, "the grid has 3 points, a run each");
    refused({"--vary", "a=0:1:3, b=uniform(0, 1)", "--runs", "4"}, "give --runs 3 or 6");
    refused({"--vary", "a=uniform(0, 1)", "--indices", "--runs", "7"}, "give --runs 6 or 9");
    refused({"--vary", "a=0:1:3", "--indices"}, "write uniform(low, high) instead");
    refused({"--vary", "a=0:1:100000, b=0:1:100000"}, "the limit is 10000000");
    refused({"--vary", "a=0:1:3", "--shard", "4/3"}, "write I/N");
    refused({"--vary", "a=0:1:3", "--shard", "1/4"}, "cannot be divided into 4 shards");
    refused({"--vary", "a=0:1:3", "--observe", "x + dot(x)"}, "but 'dot(x)' is in");
    refused({"--vary", "a=0:1:3", "--observe", "max(y)"}, "'y' is not recorded");
    refused({"--vary", "a=0:1:3", "--observe", "time(hit)"}, "does not switch");
    refused({"--vary", "a=1m:2m:3"}, "the value of 'a'");
    refused({"--vary", "u=0:1:3", "--input", "w=sin(t/1s)"}, "an input can be varied where all inputs are constant");
    refused({"--vary", "a=0:1:3", "--only", "3"}, "its runs are 0 to 2");
    CHECK(std::filesystem::is_empty(scratch.path()));
}

TEST_CASE("a study of a model whose part was changed is another study") {
    const ScratchFolder scratch;
    const std::string folder = scratch.path(), model = folder + "/m.toml";
    const auto write = [&](const std::string& file, const std::string& text) { std::ofstream(file) << "[model]\nformat = 1\n" << text; };
    const auto write_part = [&](const char* mass) {
        write(folder + "/part.toml", std::string("name = \"part\"\n[parameters]\nk = { value = 1, unit = \"N\" }\n"
                                                 "[coordinates]\nx = { unit = \"m\" }\n[bodies.b]\nmass = \"") + mass +
                                         "\"\nposition = [\"x\", 0, 0]\n[forces.f]\non = \"b\"\nforce = [\"k\", 0, 0]\n");
    };
    write(model, "name = \"m\"\n[use.a]\nfile = \"part.toml\"\n");
    const auto run = [&](const char* shard) {
        return ask("study", {model, "--vary", "a.k=1:2:4", "--until", "0.1", "--observe", "a.x", "--no-plot", "--shard", shard, "-o",
                             folder});
    };
    write_part("1 kg");
    const Answer first = run("1/2");
    INFO(first.err);
    REQUIRE(first.code == 0);
    write_part("2 kg");
    REQUIRE(run("2/2").code == 0);
    std::vector<std::string> shards;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".csv") shards.push_back(entry.path().string());
    REQUIRE(shards.size() == 2);
    const Answer merged = ask("study", {"--merge", shards[0], "--merge", shards[1], "-o", folder});
    CHECK(merged.code == 2);
    CHECK(merged.err.find("are not shards of the same study") != std::string::npos);
}

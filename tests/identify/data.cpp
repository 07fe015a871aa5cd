// SPDX-License-Identifier: GPL-3.0-or-later
// Data files, inputs that were measured, and what a fit says of data that are not good.
#include <doctest/doctest.h>

#include <cmath>

#include "identify/statistics.hpp"
#include "oscillator.hpp"

using namespace dalembert;

namespace {

/// Derivatives are those of differences.
void check_slopes(const FitRun& run, const std::vector<double>& x) {
    const RunBesideData here = run.compare(0, x, true);
    REQUIRE(here.failure.empty());
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double step = 1e-5 * x[k];
        std::vector<double> ahead = x, behind = x;
        ahead[k] += step;
        behind[k] -= step;
        const auto a = run.compare(0, ahead, false), b = run.compare(0, behind, false);
        double error = 0, size = 0;
        for (std::size_t i = 0; i < a.columns[0].simulated.size(); ++i) {
            const double slope = (a.columns[0].simulated[i] - b.columns[0].simulated[i]) / (2 * step);
            error = std::max(error, std::fabs(slope - here.columns[0].slopes[k][i]));
            size = std::max(size, std::fabs(slope));
        }
        CAPTURE(k);
        CHECK(error < 2e-5 * size);
    }
}

}  // namespace

TEST_CASE("data files are read with their units, missing values and places") {
    const DataFile file = data("# made by hand\nt [s];phi [deg];\"a;b\"\n0;1.5;2\n0.1;;NA\n0.2;-3e-1;+4\n");
    REQUIRE(file.columns.size() == 3);
    CHECK(file.columns[1].name == "phi");
    CHECK(file.columns[1].unit == "deg");
    CHECK(file.columns[2].name == "a;b");
    CHECK(std::isnan(file.columns[1].values[1]));
    CHECK(std::isnan(file.columns[2].values[1]));
    CHECK(file.columns[1].values[2] == -0.3);
    CHECK(file.columns[2].values[2] == 4);
    CHECK(file.place(2).text() == "0.2;-3e-1;+4");
    CHECK(says(problem_of([] { data("t,x\n0,1\n1\n"); }), "the line has 1 fields, but there are 2 titles"));
    CHECK(says(problem_of([] { data("t;x\n0;1,5\n"); }), "a decimal point and no comma"));
    CHECK(says(problem_of([] { data("t,x\n0,fast\n"); }), "'fast' is no number"));
    CHECK(says(problem_of([] { data("t,x,x\n0,1,2\n"); }), "two columns are called 'x'"));
    CHECK(says(problem_of([] { data("t,x\n"); }), "there are no data"));
}

TEST_CASE("inputs that were measured hold their values, or change linearly") {
    SampledInput input;
    input.times = {0, 1, 3};
    input.values = {2, 4, 0};
    CHECK(input(-1) == 2);
    CHECK(input(0.5) == 3);
    CHECK(input(2) == 2);
    CHECK(input(5) == 0);
    CHECK(input.kinks() == std::vector<double>{1, 3});
    input.is_held = true;
    CHECK(input(0.5) == 2);
    CHECK(input(1) == 4);
    CHECK(input.kinks() == std::vector<double>{1, 3});
    input.is_held = false;
    input.values = {1, 2, 4};
    CHECK(input.kinks() == std::vector<double>{3});
}

TEST_CASE("delays, units and names of columns: exact data lead back to the values that made them") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    const std::string text = data_of_step(model, 0.0713, "m=2.4,c=61,d=1.7,x_0=0.05");
    Options options;
    const FitRun run(model, options, "m, c, d, x_0, delay(f)", files_of(text));
    const Fit found = fit(run, {});
    const std::vector<double> truth{2.4, 61, 1.7, 0.05, 0.0713};
    REQUIRE(found.x.size() == truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k) CHECK(found.x[k] == doctest::Approx(truth[k]).epsilon(1e-5));
    CHECK(found.given_noise == std::vector<std::string>{"x"});
    CHECK(found.noise.at("x") == doctest::Approx(1e-4));
    // Also by the delay of an input that jumps, and of one that does not.
    check_slopes(run, truth);
    std::string straight = oscillator;
    straight.erase(straight.find("hold = true"), 11);
    options.tolerance = 1e-13;  // of the differences
    const FitRun linear(model_of(folder, straight), options, "m, c, d, x_0, delay(f)", files_of(text));
    check_slopes(linear, truth);
}

TEST_CASE("a pulse between samples that are far apart is not missed") {
    const ScratchFolder folder;
    std::string straight = oscillator;
    straight.erase(straight.find("hold = true"), 11);
    const auto model = model_of(folder, straight);
    // At rest up to a pulse of 4 ms in a run whose other samples are a second apart.
    const std::string coarse = "t,twice,current\n0,0,0\n1,0,0\n2,0,0\n2.001,,900\n2.003,,900\n2.004,0,0\n3,0,0\n4,0,0\n";
    std::string fine = "t,twice,current\n";
    for (int i = 0; i <= 4000; ++i) {
        const double t = 0.001 * i;
        fine += fmt::format("{},{},{}\n", t, i % 1000 == 0 ? "0" : "", t > 2.0005 && t < 2.0035 ? 900 : 0);
    }
    Options options;
    options.parameters = {"x_0=0"};
    const FitRun few(model, options, "c", files_of(coarse)), many(model, options, "c", files_of(fine));
    const double end = many.compare(0, {50}, false).columns[0].simulated.back();
    CHECK(std::fabs(end) > 0.01);
    CHECK(few.compare(0, {50}, false).columns[0].simulated.back() == doctest::Approx(end).epsilon(1e-6));
    CHECK(few.compare(0, {50}, true).columns[0].simulated.back() == doctest::Approx(end).epsilon(1e-6));
}

TEST_CASE("two held inputs that jump together have delays of their own") {
    const ScratchFolder folder;
    std::string two = oscillator;
    two.replace(two.find("f = { unit = \"N\" }"), 18, "f = { unit = \"N\" }\ng = { unit = \"N\" }");
    two.replace(two.find("force = [\"f\""), 12, "force = [\"f + 2*g\"");
    const auto model = model_of(folder, two);
    std::string text = "t,encoder 1,current,g\n";
    for (int i = 0; i <= 80; ++i) text += fmt::format("{},{},{},{}\n", 0.05 * i, 0.1 * i, i % 20 < 10 ? 1 : 3, i % 20 < 10 ? 2 : -1);
    Options options;
    options.held_inputs = {"g"};
    options.tolerance = 1e-13;  // of the differences
    const FitRun run(model, options, "c, delay(f), delay(g)", files_of(text));
    CHECK(run.start()[1] != run.start()[2]);
    check_slopes(run, run.start());
    check_slopes(run, {50, 1e-3, 0.05});
}

TEST_CASE("what a free oscillation does not tell is named") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    Options options;
    options.inputs = {"f=0"};
    std::string text = "t,x [m]\n";
    for (int i = 0; i <= 100; ++i) {
        const double t = 0.04 * i, a = 0.25, w = std::sqrt(25 - a * a);
        text += fmt::format("{},{}\n", t, 0.1 * std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)));
    }
    std::string plain = oscillator;
    plain.erase(plain.find("[measurements.x]"), plain.find("[runs") - plain.find("[measurements.x]"));
    const auto without = model_of(folder, plain);
    const FitRun run(without, options, "m, c, d", files_of(text));
    const Fit found = fit(run, {});
    const FitStatistics statistics = statistics_of(run, found, {});
    REQUIRE(statistics.unseen.size() == 1);
    CHECK(says(in_words(statistics.unseen[0], run), "the data do not tell 'm', 'c' and 'd' apart"));
    CHECK(std::isinf(statistics.errors[0]));
    CHECK(found.x[1] / found.x[0] == doctest::Approx(25).epsilon(1e-5));
    CHECK(found.x[2] / found.x[0] == doctest::Approx(0.5).epsilon(1e-5));
    // With d fixed at nothing the pair is left.
    Options undamped = options;
    undamped.parameters = {"d=0"};
    undamped.noise = {"x=1 mm"};
    std::string free = "t,x [m]\n";
    for (int i = 0; i <= 100; ++i) free += fmt::format("{},{}\n", 0.04 * i, 0.1 * std::cos(5 * 0.04 * i));
    const FitRun pair(without, undamped, "m, c", files_of(free));
    const FitStatistics of_pair = statistics_of(pair, fit(pair, {}), {});
    REQUIRE(of_pair.unseen.size() == 1);
    CHECK(says(in_words(of_pair.unseen[0], pair),
               "do not tell 'm' and 'c' apart: they stay the same where both grow by the same factor, and show m/c alone"));
    // What is known beforehand tells them apart.
    FitSettings prior;
    prior.priors = {{0, 2.0, 0.02}};
    const Fit with_prior = fit(pair, prior);
    const FitStatistics of_prior = statistics_of(pair, with_prior, prior);
    CHECK(of_prior.unseen.empty());
    CHECK(with_prior.x[0] == doctest::Approx(2).epsilon(1e-6));
    CHECK(of_prior.errors[0] == doctest::Approx(0.02).epsilon(1e-3));
}

TEST_CASE("outliers do little under a robust loss, and bounds hold") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    std::string text = data_of_step(model, 0, "c=61,d=1.7");
    // Two values that are far off.
    for (const int line : {40, 90}) {
        std::size_t at = 0;
        for (int i = 0; i < line; ++i) at = text.find('\n', at) + 1;
        const std::size_t comma = text.find(',', at), next = text.find(',', comma + 1);
        text.replace(comma + 1, next - comma - 1, "95");
    }
    const FitRun run(model, {}, "c, d", files_of(text));
    const Fit plain = fit(run, {});
    FitSettings robust;
    robust.loss = Loss::cauchy;
    const Fit found = fit(run, robust);
    CHECK(std::fabs(plain.x[1] - 1.7) > 0.05);
    CHECK(std::fabs(found.x[0] - 61) < 0.01);
    CHECK(std::fabs(found.x[1] - 1.7) < 0.001);
    CHECK(std::count_if(found.residuals.begin(), found.residuals.end(), [](const Residual& r) { return r.weight < 0.1; }) == 2);
    std::string narrow = oscillator;
    narrow.replace(narrow.find("range = [0, 1000]"), 17, "range = [0, 55]");
    const auto bounded = model_of(folder, narrow);
    const FitRun at_bound(bounded, {}, "c", files_of(data_of_step(model, 0, "c=61")));
    const Fit stopped = fit(at_bound, {});
    CHECK(stopped.x[0] == doctest::Approx(55));
    CHECK(statistics_of(at_bound, stopped, {}).at_bound[0] == 1);
}

TEST_CASE("data that do not fit the model are refused with a sentence") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    const auto refusal = [&](const std::string& text, const std::string& what = "c") {
        return problem_of([&] { fit(FitRun(model, {}, what, files_of(text)), {}); });
    };
    CHECK(says(refusal("time,current\n0,1\n1,2\n"), "no column is an output"));
    CHECK(says(refusal("x,current\n0,1\n1,2\n"), "no column 't'"));
    CHECK(says(refusal("t,twice [s],current\n0,1,0\n1,2,0\n"), "the column 'twice' is in s, but the model has it in m"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n0,2,0\n"), "is not behind that of the line before"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,NA\n"), "the input 'f' is missing where the data end"));
    CHECK(says(refusal("t,twice,current,m\n0,1,0,2\n1,2,0,3\n"), "'m' must have one value in an experiment"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,0\n", "c, d, m"), "2 values for 3 unknowns"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,0\n", "c, e"), "no parameter, coordinate, velocity or state 'e'"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,0\n", "x"), "for its value at the start write start(x)"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,0\n", "c, offset(x)"), "no data have a column 'x'"));
    CHECK(says(refusal("t,twice,current\n0,1,0\n1,2,0\n", "c, c"), "'c' is named twice"));
    CHECK(says(refusal("t,twice,current,c\n0,1,0,2\n1,2,0,2\n", "c"), "c cannot be fitted: 'run.csv' has a column with its value"));
    CHECK(says(refusal("t,x,encoder 1,current\n0,1,1,0\n1,2,2,0\n"), "the columns 'x' and 'encoder 1' are both 'x'"));
    const auto with = [&](const std::function<void(Options&)>& set) {
        Options options;
        set(options);
        return problem_of([&] { FitRun(model, options, "c", files_of("t,twice,current\n0,1,0\n1,2,0\n")); });
    };
    CHECK(says(with([](Options& o) { o.noise = {"phi=1"}; }), "no column 'phi' is compared with a run"));
    CHECK(says(with([](Options& o) { o.held_inputs = {"g"}; }), "no data have a column 'g' that is an input"));
    CHECK(says(with([](Options& o) { o.inputs = {"f=3"}; }), "the input 'f' has a column in the data"));
    CHECK(says(with([](Options& o) { o.noise = {"twice=0"}; }), "the noise of 'twice' must be above zero"));
    CHECK(says(problem_of([&] {
                   FitRun(model, {}, "c", {data("t,twice,current\n0,1,0\n1,2,0\n"), data("t,twice,current\n0,1,0\n1,2,0\n")});
               }),
               "'run.csv' is named twice"));
    CHECK(says(problem_of([&] { model_of(folder, std::string(oscillator) + "[measurements.y]\nunit = \"m\"\n"); }),
               "measurement 'y': 'y' is no output, coordinate"));
}

TEST_CASE("parameter files are read, and what is wrong in them has its place") {
    const ScratchFolder folder;
    const std::string file = (std::filesystem::path(folder.path()) / "fitted.toml").string();
    const auto values = [&](const std::string& text, const std::string& given = "") {
        std::ofstream(file) << text;
        const auto model = model_of(folder, oscillator);
        Options options;
        options.parameter_files = {file};
        if (!given.empty()) options.parameters = {given};
        const PreparedSimulation prepared = prepare_simulation(model, "", options);
        return prepared.run.parameters;
    };
    CHECK(values("[parameters]\nm = 3\n\"c\" = \"0.07 N/mm\"\n") == std::vector<double>{3, 70, 1, 0.1});
    CHECK(values("[parameters]\nm = 3\n", "m=4") == std::vector<double>{4, 50, 1, 0.1});
    const auto refusal = [&](const std::string& text) { return problem_of([&] { values(text); }); };
    CHECK(says(refusal("[parameter]\nm = 3\n"), "has the table [parameters] alone, and no 'parameter'"));
    CHECK(says(refusal("# nothing\n"), "[parameters], which is missing"));
    CHECK(says(refusal("[parameters]\nm = true\n"), "the value of 'm' is true or false, but must be a number"));
    CHECK(says(refusal("[parameters]\nmm = 3\n"), "mm"));
    CHECK(says(refusal("[parameters]\nm = \"3 N\"\n"), "fitted.toml:2:"));
    CHECK(says(refusal("[parameters]\nm = 1e9\n"), "fitted.toml:2:"));
    CHECK(says(problem_of([&] {
                   Options options;
                   options.parameter_files = {"nowhere.toml"};
                   parameter_settings(options);
               }),
               "there is no file 'nowhere.toml'"));
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Where the search goes: to values with which there is no machine, or one far too fast, and to parts of the data.
#include <doctest/doctest.h>

#include <cmath>

#include "identify/fit.hpp"
#include "oscillator.hpp"

using namespace dalembert;

namespace {

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
}

}  // namespace

TEST_CASE("a step to values with which there is no machine is taken back") {
    const ScratchFolder folder;
    const auto model = model_of(folder, replaced(oscillator, "start = \"x_0\"", "start = \"(100 mm)*sqrt(c/(1 N/m) - 40)\""));
    const FitRun run(model, {}, "c", files_of(data_of_step(model, 0, "c=41")));
    CHECK(says(run.compare(0, {39}, true).failure, "no value"));
    const Fit found = fit(run, {});
    CHECK(found.converged);
    CHECK(found.x[0] == doctest::Approx(41).epsilon(1e-6));
    Options options;
    options.parameters = {"c=39"};
    const std::string refused = problem_of([&] { FitRun(model, options, "c", files_of(data_of_step(model, 0, "c=41"))); });
    CHECK(says(refused, "the start value of 'x' is no real number with these parameters"));
    CHECK(says(refused, "oscillator.toml"));
}

TEST_CASE("the end of the model's run is not asked for where the data have their own") {
    const ScratchFolder folder;
    const auto model = model_of(folder, replaced(oscillator, "until = 4", "until = \"(4 s)/(1 - d/(10 N*s/m))\""));
    Options options;
    options.parameters = {"d=10"};
    const FitRun run(model, options, "d", files_of(data_of_step(model_of(folder, oscillator), 0, "d=1.7")));
    CHECK(fit(run, {}).x[0] == doctest::Approx(1.7).epsilon(1e-6));
}

TEST_CASE("runs far faster than the first one are given up") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    const FitRun run(model, {}, "c", files_of(data_of_step(model, 0, "c=61")));
    CHECK(run.compare(0, {1e4}, true).failure.empty());
    CHECK(says(run.compare(0, {1e12}, false).failure, "too many steps"));
    CHECK(says(run.compare(0, {1e12}, true).failure, "too many steps"));
}

TEST_CASE("a run to the first part of the data is the first part of the run") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    const FitRun run(model, {}, "c, delay(f)", files_of(data_of_step(model, 0.003, "c=61")));
    const std::vector<double> x{61, 0.003};
    const RunBesideData whole = run.compare(0, x, true), part = run.compare(0, x, true, 90);
    REQUIRE(part.columns[0].simulated.size() == 90);
    for (std::size_t i = 0; i < 90; ++i) {
        CHECK(std::fabs(part.columns[0].simulated[i] - whole.columns[0].simulated[i]) < 1e-8);
        for (std::size_t k = 0; k < x.size(); ++k)
            CHECK(std::fabs(part.columns[0].slopes[k][i] - whole.columns[0].slopes[k][i]) * x[k] < 1e-8);
    }
    CHECK(run.compare(0, x, true, 2).columns[0].simulated.size() == 2);
}

TEST_CASE("several starts, of which some grow with the data, find an oscillation three times as fast") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    std::string data = data_of_step(model, 0, "c=450,d=0.2");
    Options options;
    options.parameters = {"d=0.2"};
    const FitRun run(model, options, "c", files_of(data));
    FitSettings settings;
    const double alone = fit(run, settings).x[0];
    CHECK(std::fabs(alone - 450) > 10);
    settings.starts = 2;
    const Fit found = fit(run, settings);
    CHECK(found.x[0] == doctest::Approx(450).epsilon(1e-6));
    CHECK(found.start == 1);
    for (const Loss loss : {Loss::huber, Loss::cauchy}) {
        settings.loss = loss;
        CAPTURE(static_cast<int>(loss));
        CHECK(fit(run, settings).x[0] == doctest::Approx(450).epsilon(1e-6));
    }
}

TEST_CASE("data that begin with missing values, or have two times, are fitted from several starts, too") {
    const ScratchFolder folder;
    const auto model = model_of(folder, oscillator);
    std::string late = data_of_step(model, 0, "c=61");
    for (int line = 1; line <= 120; ++line) {  // of 201
        std::size_t at = 0;
        for (int i = 0; i < line; ++i) at = late.find('\n', at) + 1;
        const std::size_t comma = late.find(',', at), next = late.find(',', comma + 1);
        late.replace(comma + 1, next - comma - 1, "NA");
    }
    FitSettings settings;
    settings.starts = 6;
    CHECK(fit(FitRun(model, {}, "c", files_of(late)), settings).x[0] == doctest::Approx(61).epsilon(1e-6));
    const FitRun two(model, {}, "c", files_of("t,twice,current\n0,0.2,0\n0.1,0.19,0\n"));
    CHECK(fit(two, settings).cost <= fit(two, {}).cost + 1e-6);
}

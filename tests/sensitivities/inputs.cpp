// SPDX-License-Identifier: GPL-3.0-or-later
// How runs follow what their inputs are made of, and what has no derivative.
#include "comparison.hpp"

using namespace dalembert;

TEST_CASE("a plant knows how the inputs of its run follow the state and the parameters") {
    std::size_t compared = 0;
    for_each_run({"inputs_at_large_angles", "kinks_of_functions", "curve_of_time"}, [&](const std::string&, const std::string&,
                                                                                       const dalembert_plant& plant, const PlantRun& run) {
        if (plant.inputs_of_run == nullptr) return;
        const bool knows_slopes = plant.input_slopes != nullptr;
        REQUIRE(knows_slopes);
        const std::unique_ptr<void, void (*)(void*)> self(plant.create(), plant.destroy);
        const std::size_t n = plant.states, m = plant.inputs;
        std::vector<double> x = run.start, p = run.parameters, columns((n + plant.parameters) * m);
        const double t = 0.37 * run.until;
        for (std::size_t i = 0; i < n; ++i) x[i] += 0.01 * std::sin(1.0 + static_cast<double>(i));
        plant.set_parameters(self.get(), p.data());
        plant.input_slopes(self.get(), x.data(), t, columns.data());
        for (std::size_t c = 0; c < n + plant.parameters; ++c) {
            double& moved = c < n ? x[c] : p[c - n];
            const double now = moved, step = 1e-4 * (now == 0 ? 1 : std::fabs(now));
            std::vector<std::vector<double>> sides;
            for (const int times : {-2, -1, 1, 2}) {
                moved = now + times * step;
                plant.set_parameters(self.get(), p.data());
                sides.emplace_back(m);
                plant.inputs_of_run(self.get(), x.data(), t, sides.back().data());
            }
            moved = now;
            for (std::size_t j = 0; j < m; ++j) {
                const double found = columns[c * m + j], near = (sides[2][j] - sides[1][j]) / (2 * step),
                             far = (sides[3][j] - sides[0][j]) / (4 * step), expected = (4 * near - far) / 3;
                double size = 1e-3 * std::fabs(expected);
                for (const auto& side : sides) size = std::max(size, std::fabs(side[j]) / std::max(1.0, std::fabs(now)));
                CAPTURE(c);
                CAPTURE(found);
                CAPTURE(expected);
                CHECK(std::fabs(found - expected) <= 1e-6 * size + 10 * std::fabs(near - far));
                compared += found != 0;
            }
        }
    });
    CHECK(compared >= 5);
}

TEST_CASE("derivatives after many turns are those after none") {
    const double turn = 2 * 3.14159265358979323846;
    const auto ends = [](double start) {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {"J", "M", "w_0"};
        options.tolerance = tolerance;
        options.parameters = {fmt::format("phi_0={:.17g}", start)};
        const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions/inputs_at_large_angles.toml", diagnostics);
        const PreparedSimulation prepared = prepare_simulation(model, "", options);
        const PlantLibrary library(prepared.plant, prepared.cache);
        return simulate_plant(library.table(), prepared.run).sensitivities.rows.back();
    };
    const std::vector<double> few = ends(0.7), many = ends(0.7 + 20000 * turn);
    for (std::size_t i = 1; i < few.size(); ++i) CHECK(many[i] == doctest::Approx(few[i]).epsilon(1e-7));
}

TEST_CASE("the header that a run leaves behind has derivatives by all parameters") {
    const auto text = [](const char* by) {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {by};
        const auto model = load(std::filesystem::path(SOURCE_DIR) / "systems/mechanics/cart_pendulum.toml", diagnostics);
        return prepare_simulation(model, "", options).plant.header;
    };
    const std::string header = text("d_R");
    CHECK(header == text("m_W"));
    CHECK(header == text("phi"));
}

TEST_CASE("what has no derivative is refused") {
    const auto refusal = [](const char* file, const char* scene, const char* name) -> std::string {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {name};
        try {
            prepare_simulation(load(std::filesystem::path(SOURCE_DIR) / file, diagnostics), scene, options);
            return "";
        } catch (const Failure& failure) {
            return failure.diagnostics().front().message;
        }
    };
    CHECK(refusal("systems/mechanics/four_bar.toml", "", "alpha") == "");
    CHECK(refusal("systems/mechanics/four_bar.toml", "", "beta") == "the start of 'beta' cannot be varied: constraints determine it");
    CHECK(refusal("systems/mechanics/heavy_top.toml", "attitude", "e_1").find("a part of a quaternion") != std::string::npos);
    // A jump of `ons` and a pulse of `blows` fall together at 1.5 s; tau moves the one, T and width the other.
    CHECK(refusal("tests/regressions/kinks_of_functions.toml", "", "tau").find("some fall together") != std::string::npos);
    CHECK(refusal("tests/regressions/kinks_of_functions.toml", "", "width") == "");
}

TEST_CASE("rates that jump where the state and the time say so, at once") {
    const RunOfOne one("tests/regressions/kinks_of_functions.toml", "tau", {"tau=1.013"});  // at 1 the pulses come in between
    REQUIRE(one.result.of_sensitivities.status == Status::success);
    const Row& row = one.row;
    CAPTURE(row.of);
    CHECK(row.compared >= 30);
    CHECK(row.error <= allowed(row));
    const double tau = 1.013;
    const std::vector<double>& end = one.result.sensitivities.rows.back();
    CHECK(end[1] == doctest::Approx(-1 / (tau * tau)));  // x = 3/4 + t/(2 tau)
    CHECK(end[6] == doctest::Approx(-2 / (tau * tau)));  // late = t/tau - 3/2
}

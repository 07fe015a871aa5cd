// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/library.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "plant/simulation.hpp"
#include "text/diagnostic.hpp"
#include "text/process.hpp"

using namespace dalembert;

namespace {

/// dx/dt = rate, from a start that stands in its header as a number that libraries of one name would share.
PlantSource growing(const std::string& rate, const std::string& start) {
    return {"growing.hpp",
            "#pragma once\nnamespace growing { inline constexpr double rate = " + rate + "; inline constexpr double start[1] = {" + start + "}; }\n",
            R"(#include "growing.hpp"
#include "dalembert/plant.h"
#include <cstdlib>
extern "C" const dalembert_plant* dalembert_plant_table(void) {
    static const dalembert_quantity states[1] = {{"x", "1", "", -1, 1}};
    static const dalembert_plant plant = [] {
        dalembert_plant p{};
        p.version = DALEMBERT_PLANT_VERSION;
        p.size = sizeof(p);
        p.name = "growing";
        p.scene = "full";
        p.title = "";
        p.states = 1;
        p.state_table = states;
        p.start_values = growing::start;
        p.create = [] { return std::malloc(1); };
        p.destroy = [](void* self) { std::free(self); };
        p.set_parameters = [](void*, const double*) {};
        p.start_state = [](const void*, double* x) { x[0] = growing::start[0]; };
        p.rhs = [](const void*, unsigned, const double*, const double*, double, double* dxdt) { dxdt[0] = growing::rate; };
        p.rhs_and_jacobian = [](const void*, unsigned, const double*, const double*, double, double* dxdt, double* J) { dxdt[0] = growing::rate, J[0] = 0; };
        return p;
    }();
    return &plant;
}
)"};
}

double end_of(const PlantLibrary& library) {
    PlantRun run;
    run.states = {{"x", "1", 0, false}};
    run.until = 1;
    run.intervals = 2;
    const PlantRunResult result = simulate_plant(library.table(), run);
    CHECK(result.outcome.status == Status::success);
    CHECK(result.recording.rows.size() == 3);
    return result.recording.rows.back()[1];
}

/// A cache of its own for a test.
struct OwnCache {
    ScratchFolder folder;
    OwnCache() { ::setenv("XDG_CACHE_HOME", folder.path().c_str(), 1); }
    ~OwnCache() { ::unsetenv("XDG_CACHE_HOME"); }
};

}  // namespace

TEST_CASE("plants of one name keep their own numbers side by side") {
    const PlantLibrary first(growing("1", "0.5"), PlantCache::unused), second(growing("2", "0.25"), PlantCache::unused);
    CHECK(end_of(first) == doctest::Approx(1.5).epsilon(1e-12));
    CHECK(end_of(second) == doctest::Approx(2.25).epsilon(1e-12));
}

TEST_CASE("a plant comes from the cache where nothing of its text has changed") {
    const OwnCache cache;
    CHECK_FALSE(PlantLibrary(growing("1", "0.5"), PlantCache::used).origin().is_kept);
    const PlantLibrary again(growing("1", "0.5"), PlantCache::used), other(growing("3", "0.5"), PlantCache::used);
    CHECK(again.origin().is_kept);
    CHECK_FALSE(other.origin().is_kept);
    CHECK(end_of(again) == doctest::Approx(1.5).epsilon(1e-12));
    CHECK(end_of(other) == doctest::Approx(3.5).epsilon(1e-12));
    CHECK_FALSE(PlantLibrary(growing("1", "0.5"), PlantCache::unused).origin().is_kept);
    // A text that does not belong to the library beside it does not count.
    for (const auto& entry : std::filesystem::directory_iterator(plant_cache_folder()))
        if (entry.path().extension() == ".txt") std::ofstream(entry.path()) << "another";
    CHECK_FALSE(PlantLibrary(growing("1", "0.5"), PlantCache::used).origin().is_kept);
}

TEST_CASE("what is no plant is refused with what is missing") {
    PlantSource without = growing("1", "0.5");
    const std::string rhs = "        p.rhs = ";
    without.source.replace(without.source.find(rhs), rhs.size(), "        p.output = nullptr; auto unused = ");
    const auto message = [](const PlantSource& source) -> std::string {
        try {
            PlantLibrary library(source, PlantCache::unused);
            return "";
        } catch (const Failure& failure) {
            return failure.diagnostics().front().message;
        }
    };
    CHECK(message(without).find("its table has no rhs or rhs_and_jacobian") != std::string::npos);
    PlantSource old = growing("1", "0.5");
    old.source.replace(old.source.find("= DALEMBERT_PLANT_VERSION"), 25, "= 99");
    CHECK(message(old).find("its table has version 99") != std::string::npos);
}

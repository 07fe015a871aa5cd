// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs that fuzzers found, corpus/TARGET/*: each is answered, and soon.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "fuzz/targets.hpp"

namespace fs = std::filesystem;

TEST_CASE("what fuzzers found") {
    std::vector<fuzz::Target> targets(fuzz::readers().begin(), fuzz::readers().end());
    targets.push_back(fuzz::whole());
    int inputs = 0;
    for (const auto& folder : fs::directory_iterator(fs::path(SOURCE_DIR) / "tests" / "fuzz" / "corpus")) {
        const fuzz::Target* target = fuzz::find(targets, folder.path().filename().string());
        CAPTURE(folder.path().string());
        REQUIRE(target != nullptr);
        for (const auto& input : fs::directory_iterator(folder)) {
            CAPTURE(input.path().string());
            std::ifstream in(input.path(), std::ios::binary);
            std::ostringstream bytes;
            bytes << in.rdbuf();
            const auto begin = std::chrono::steady_clock::now();
            target->run(bytes.str());
            CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < 10);
            ++inputs;
        }
    }
    CHECK(inputs > 0);
}

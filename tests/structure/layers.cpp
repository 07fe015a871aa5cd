// SPDX-License-Identifier: GPL-3.0-or-later
// Lower layers of the generator never include higher ones.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> order{"text", "model", "symbolic", "mechanics", "balance", "form", "prove", "graph", "emit", "pipeline", "command", "main"};

std::size_t rank(const std::string& name) {
    for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i] == name) return i;
    return order.size();
}

}  // namespace

TEST_CASE("layers include only what is below them") {
    const fs::path generator = fs::path(SOURCE_DIR) / "generator";
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(generator)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".cpp" && extension != ".hpp") continue;
        const fs::path relative = fs::relative(entry.path(), generator);
        const std::string layer = relative.has_parent_path() ? relative.begin()->string() : relative.stem().string();
        CAPTURE(relative.string());
        REQUIRE(rank(layer) < order.size());
        ++files;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            if (!line.starts_with("#include \"")) continue;
            const std::string included = line.substr(10, line.find('"', 10) - 10);
            const fs::path path(included);
            const std::string below = path.has_parent_path() ? path.begin()->string() : path.stem().string();
            CAPTURE(included);
            CHECK(fs::exists(generator / included));
            CHECK(rank(below) <= rank(layer));
            CHECK_FALSE((layer == "balance" && below == "mechanics"));  // the two stand beside each other
        }
    }
    CHECK(files > 50);
}

TEST_CASE("the layers below symbolic know nothing of GiNaC") {
    const fs::path generator = fs::path(SOURCE_DIR) / "generator";
    for (const char* layer : {"text", "model"})
        for (const auto& entry : fs::directory_iterator(generator / layer)) {
            std::ifstream in(entry.path());
            const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
            CAPTURE(entry.path().string());
            CHECK(text.find("ginac") == std::string::npos);
        }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Lower layers of the generator never include higher ones, only those from `symbolic` on know GiNaC, and its files can be compiled
// together.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

/// From below. A layer is a folder of `generator` with all its subfolders, or a file beside them.
const std::vector<std::string> order{"text",      "plant",   "language", "elements", "check",    "read",  "scene",
                                     "printed",   "symbolic", "mechanics", "balance", "form",    "prove", "graph",
                                     "program",   "cpp",     "c",        "js",       "emit",  "pipeline", "book",  "run",
                                     "export",    "identify", "study",   "report",  "reference", "command", "main"};

std::size_t rank(const std::string& layer) {
    return std::size_t(std::find(order.begin(), order.end(), layer) - order.begin());
}

std::string layer_of(const fs::path& relative) {
    return relative.has_parent_path() ? relative.begin()->string() : relative.stem().string();
}

/// The files of `generator` with their lines, by their paths from there.
std::map<std::string, std::vector<std::string>> generator_files() {
    const fs::path generator = fs::path(SOURCE_DIR) / "generator";
    std::map<std::string, std::vector<std::string>> files;
    for (const auto& entry : fs::recursive_directory_iterator(generator)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".cpp" && extension != ".hpp") continue;
        std::ifstream in(entry.path());
        std::vector<std::string>& lines = files[fs::relative(entry.path(), generator).string()];
        for (std::string line; std::getline(in, line);) lines.push_back(line);
    }
    return files;
}

/// The class that a line at the left margin defines.
std::string defined_by(const std::string& line) {
    static const std::regex type(R"(^(?:struct|class|enum|enum class) (\w+)\b[^;]*\{.*)");
    std::smatch match;
    return std::regex_match(line, match, type) ? match[1].str() : std::string();
}

}  // namespace

TEST_CASE("layers include only what is below them") {
    const auto files = generator_files();
    CHECK(files.size() > 400);
    for (const auto& [path, lines] : files) {
        const std::string layer = layer_of(path);
        CAPTURE(path);
        REQUIRE(rank(layer) < order.size());
        for (const std::string& line : lines) {
            if (!line.starts_with("#include \"")) continue;
            const std::string included = line.substr(10, line.find('"', 10) - 10);
            const std::string below = layer_of(included);
            CAPTURE(included);
            CHECK(files.contains(included));
            CHECK(rank(below) <= rank(layer));
            CHECK_FALSE((layer == "balance" && below == "mechanics"));  // the two stand beside each other
        }
    }
}

TEST_CASE("the layers below symbolic know nothing of GiNaC") {
    for (const auto& [path, lines] : generator_files()) {
        if (rank(layer_of(path)) >= rank("symbolic")) continue;
        for (const std::string& line : lines) {
            CAPTURE(path);
            CAPTURE(line);
            CHECK(line.find("ginac/") == std::string::npos);
            CHECK(line.find("GiNaC::") == std::string::npos);
        }
    }
}

TEST_CASE("files of a layer can be compiled together: no two of them define a class of the same name") {
    std::map<std::string, std::string> seen;
    for (const auto& [path, lines] : generator_files()) {
        if (!path.ends_with(".cpp")) continue;
        for (const std::string& line : lines) {
            const std::string name = defined_by(line);
            if (name.empty()) continue;
            const auto [known, is_new] = seen.emplace(layer_of(path) + "/" + name, path);
            CAPTURE(name);
            CAPTURE(path);
            CAPTURE(known->second);
            CHECK((is_new || known->second == path));
        }
    }
    CHECK(seen.size() > 100);
}

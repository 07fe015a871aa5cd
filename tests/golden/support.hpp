// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs that are kept in files. With DALEMBERT_ACCEPT=1 in the environment the files are written anew instead of compared.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "command/command_line.hpp"
#include "tier.hpp"

namespace golden {

namespace fs = std::filesystem;

inline const fs::path source = SOURCE_DIR;

inline bool accepting() {
    const char* value = std::getenv("DALEMBERT_ACCEPT");
    return value != nullptr && std::string(value) == "1";
}

inline std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

struct Result {
    int exit_code;
    std::string out;
    std::string err;
};

/// Runs the program in this process.
inline Result run(const std::vector<std::string>& arguments) {
    std::ostringstream out, err;
    const int exit_code = dalembert::run_program(arguments, {out, err});
    return {exit_code, out.str(), err.str()};
}

/// The models in systems/, sorted: what is there but the catalogues of printed equations.
inline std::set<fs::path> system_models() {
    std::set<fs::path> models;
    for (const auto& entry : fs::recursive_directory_iterator(source / "systems"))
        if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "book") models.insert(entry.path());
    return models;
}

/// Whether a model is a controller that samples: it has a header, but nothing that moves.
inline bool is_controller(const fs::path& model) { return model.parent_path().filename() == "controllers"; }

/// Models and catalogues that take seconds each: of the full tier, but for one header a model.
inline bool is_slow(const fs::path& model) {
    static const std::set<std::string> slow{"enclosure",        "arm_6r", "block", "pneumatic_cylinder", "3_3_mass_and_momentum",
                                            "4_1_heat_transfer"};
    return slow.contains(model.stem().string());
}

/// Compares with the file, or writes it.
inline void expect(const fs::path& file, const std::string& text) {
    if (accepting()) {
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return;
    }
    INFO("expected output in ", file.string(), "; ./dev accept writes it anew");
    CHECK(text == content(file));
}

/// A folder for results that is empty at first and gone afterwards.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (fs::temp_directory_path() / "dalembert-test-XXXXXX").string();
        REQUIRE(mkdtemp(pattern.data()) != nullptr);
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }
    bool is_empty() const { return fs::is_empty(path_); }

private:
    fs::path path_;
};

}  // namespace golden

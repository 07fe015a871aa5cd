// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene leaves out costs nothing: its header is, behind the banner, that of a file in which nothing of it was ever written.
#include "golden/support.hpp"
#include "golden/without_effects.hpp"

namespace {

using namespace golden;

/// Without the comment at the top, which tells of effects.
std::string behind_banner(const std::string& header) {
    std::size_t line = 0;
    while (header.compare(line, 2, "//") == 0) line = header.find('\n', line) + 1;
    return header.substr(line);
}

}  // namespace

TEST_CASE("the header of a scene is that of a model without what the scene leaves out") {
    if (accepting()) return;  // what it compares with is about to be written
    int compared = 0;
    for (const fs::path& path : system_models()) {
        const TextModel model(content(path));
        if (content(path).find("\n[use") != std::string::npos) continue;  // of other files: golden/parts.cpp
        if (!model.leaves_out_anything() || (!is_full_tier() && is_slow(path))) continue;
        std::vector<std::string> scenes = model.scenes();
        if (!is_full_tier()) scenes.erase(scenes.begin(), scenes.end() - 1);  // of each model one
        for (const std::string& scene : scenes) {
            const TemporaryFolder folder;
            const fs::path file = folder.path() / path.filename();
            std::ofstream(file) << model.without(scene);
            for (const auto& beside : fs::directory_iterator(path.parent_path()))  // points of curves
                if (beside.path().extension() == ".csv") fs::copy(beside.path(), folder.path());
            const Result result = run({"generate", file.string(), "-o", folder.path().string()});
            INFO(path.filename().string(), ", ", scene, ": ", result.err);
            CHECK(result.exit_code == 0);
            if (result.exit_code != 0) continue;
            const fs::path header = result.out.substr(0, result.out.find(".hpp") + 4);
            const fs::path kept = source / "generated" / path.parent_path().filename() / header.filename();
            CHECK_MESSAGE(behind_banner(content(header)) == behind_banner(content(kept)), header.filename().string());
            ++compared;
        }
    }
    CHECK(compared > (is_full_tier() ? 60 : 20));
}

TEST_CASE("five models written by hand without what the scene leaves out") {
    for (const auto& entry : fs::directory_iterator(source / "tests/golden/by_hand")) {
        const TemporaryFolder folder;
        const Result result = run({"generate", entry.path().string(), "-o", folder.path().string()});
        INFO(entry.path().filename().string(), ": ", result.err);
        REQUIRE(result.exit_code == 0);
        const fs::path header = result.out.substr(0, result.out.find(".hpp") + 4);
        fs::path kept;
        for (const auto& other : fs::recursive_directory_iterator(source / "generated"))
            if (other.path().filename() == header.filename()) kept = other.path();
        CHECK_MESSAGE(behind_banner(content(header)) == behind_banner(content(kept)), header.filename().string());
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// A machine of parts, or with joints, is the same machine written by hand: its headers have the same bytes, in every scene and in both
// languages.
#include "golden/support.hpp"

namespace {

using namespace golden;

std::string headers_of(const fs::path& model, const std::string& language) {
    const TemporaryFolder folder;
    const Result result = run({"generate", model.string(), "--every-scene", "--language", language, "-o", folder.path().string()});
    INFO(model.string(), ": ", result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    std::set<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) files.insert(entry.path());
    std::string text;
    for (const fs::path& file : files) text += file.filename().string() + "\n" + content(file);
    return text;
}

}  // namespace

TEST_CASE("machines of parts and of joints have the headers of the same machines written by hand") {
    int compared = 0;
    for (const auto& entry : fs::directory_iterator(source / "tests/golden/parts")) {
        if (entry.path().extension() != ".toml") continue;
        const fs::path by_hand = entry.path().parent_path() / "by_hand" / entry.path().filename();
        REQUIRE(fs::exists(by_hand));
        const std::string stem = entry.path().stem().string();
        const bool takes_longer = stem == "brakes" || stem == "crane" || stem == "drive" || stem == "jointed_arm";
        if (takes_longer && !is_full_tier()) continue;
        for (const char* language : {"c++", "c"}) {
            if (!is_full_tier() && std::string(language) == "c") continue;
            const std::string of_parts = headers_of(entry.path(), language);
            CHECK(of_parts.size() > 1000);
            CHECK_MESSAGE((of_parts == headers_of(by_hand, language)), stem, " in ", language);
        }
        ++compared;
    }
    CHECK(compared >= (is_full_tier() ? 12 : 8));
}

TEST_CASE("what became of joined ports is told") {
    const auto derived = [](const char* name) { return run({"derive", (source / "tests/golden/parts" / name).string()}).out; };
    CHECK(derived("flange.toml").ends_with("\njoined ports\n  left.rod: coordinate 'left_s' is 'x'\n"));
    CHECK(derived("brakes.toml")
              .ends_with("\njoined ports\n  lever.end: constraint 'lever_end' holds it there, because no coordinate can go; "
                         "constraint_force[lever_end] is its force\n"));
    CHECK(derived("drive.toml").find("  motor.shaft: coordinate 'motor_phi' is 'i*shaft.phi_1'\n") != std::string::npos);
    CHECK(derived("wagon.toml")
              .ends_with("\njoined ports\n  string.plus: pin 'string_upper_plus' is 'line_p[0]'\n"
                         "  string.minus: pin 'string_ground' is 'ground'\n  line.other: pin 'dc' is 'line_p[line_N]'\n"
                         "  line.shield: pin 'line_ground' is 'ground'\n  motor.plus: pin 'motor_plus' is 'line_p[line_N]'\n"
                         "  motor.minus: pin 'motor_ground' is 'rail'\n  motor.shaft: coordinate 'motor_phi' is 'phi'\n"));
    const TemporaryFolder folder;
    fs::copy_file(source / "tests/golden/parts/pieces/controller.toml", folder.path() / "controller.toml");
    std::ofstream(folder.path() / "cascade.toml") << "[model]\nformat = 1\nname = \"cascade\"\n[use]\n"
                                                     "inner = { file = \"controller.toml\", ports = { w = \"outer.u\" } }\n"
                                                     "outer = { file = \"controller.toml\" }\n";
    CHECK(run({"derive", (folder.path() / "cascade.toml").string()})
              .out.ends_with("\njoined ports\n  inner.w: input 'inner_w' is 'outer_u'\n"));
}

TEST_CASE("results of a run are named as the header names them, and values are set by either name") {
    const TemporaryFolder folder;
    const fs::path model = source / "tests/golden/parts/flange.toml";
    const auto evaluated = [&](const std::string& state) { return run({"evaluate", model.string(), "--state", state}); };
    const Result one = evaluated("x=0.2, left_p_1=60 bar"), other = evaluated("x=0.2, left.p_1=60 bar");
    INFO(one.err, other.err);
    CHECK(one.exit_code == 0);
    CHECK(one.out == other.out);
    CHECK(one.out.find("left_p_1") != std::string::npos);
    const auto told = [](std::vector<std::string> arguments) {
        const TemporaryFolder results;
        arguments.insert(arguments.end(), {"-o", results.path().string(), "--no-plot"});
        Result result = run(arguments);
        INFO(result.err);
        CHECK(result.exit_code == 0);
        for (std::size_t at; (at = result.out.find(results.path().string())) != std::string::npos;)
            result.out.erase(at, results.path().string().size());
        return result.out;
    };
    const auto same = [&](std::vector<std::string> arguments, const char* option, const char* joined, const char* pointed) {
        std::vector<std::string> with_point = arguments;
        arguments.insert(arguments.end(), {option, joined});
        with_point.insert(with_point.end(), {option, pointed});
        CHECK_MESSAGE(told(arguments) == told(with_point), option);
    };
    const std::string file = model.string();
    same({"simulate", file, "--until", "0.01"}, "--sensitivities", "left_p_1,left_m", "left.p_1,left.m");
    same({"study", file, "--until", "0.01"}, "--vary", "left_m=1:2:3", "left.m=1:2:3");
    same({"study", file, "--until", "0.01", "--vary", "left_m=1:2:3"}, "--observe", "max(left_p_1)", "max(left.p_1)");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of bad input beside the message it gets. A file NAME.toml is generated (or what its first line says behind "# run:"),
// and NAME.txt holds what must be printed. Nothing may be written.
#include <set>

#include "golden/support.hpp"
#include "text/diagnostic.hpp"

using namespace golden;

namespace {

const fs::path folder = source / "tests" / "errors";

/// "# run: evaluate FILE --state s=1": words, FILE stands for the model.
std::vector<std::string> arguments_of(const fs::path& model, const fs::path& results) {
    std::ifstream in(model);
    std::string line;
    std::getline(in, line);
    std::vector<std::string> words;
    if (line.starts_with("# run: ")) {
        std::istringstream rest(line.substr(7));
        for (std::string word; rest >> word;) words.push_back(word == "FILE" ? model.string() : word);
        return words;
    }
    return {"generate", model.string(), "-o", results.string()};
}

std::string with_short_names(std::string text) {
    const std::string root = folder.string() + "/";
    for (std::size_t at; (at = text.find(root)) != std::string::npos;) text.erase(at, root.size());
    return text;
}

}  // namespace

TEST_CASE("bad input gets its message") {
    std::set<std::string> seen;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".toml") continue;
        const TemporaryFolder results;
        const Result result = run(arguments_of(entry.path(), results.path()));
        CAPTURE(entry.path().filename().string());
        CHECK(result.exit_code == 2);
        CHECK(results.is_empty());
        CHECK((result.out.empty() || result.out.find("could not be read") != std::string::npos));  // of catalogues, what can be read is checked
        fs::path expected = entry.path();
        expect(expected.replace_extension(".txt"), with_short_names(result.err));
        for (const auto& kind : dalembert::diagnostic_kinds())
            if (result.err.find(std::string("error[") + kind.name + "]") != std::string::npos) seen.insert(kind.name);
    }
    // Every id that a model can provoke is provoked by one of the files; the rest has tests of its own.
    const std::set<std::string> elsewhere{"unreadable-file", "file-too-large", "not-text", "not-equal", "tool-failed", "bad-plant", "unused", "can-vanish", "wrong-closed-form", "size-mismatch"};
    for (const auto& kind : dalembert::diagnostic_kinds()) {
        CAPTURE(kind.name);
        CHECK((seen.contains(kind.name) || elsewhere.contains(kind.name)));
    }
}

TEST_CASE("files that are no models") {
    const TemporaryFolder here;
    const auto generate = [&](const std::string& content) {
        std::ofstream(here.path() / "model.toml", std::ios::binary) << content;
        return run({"generate", (here.path() / "model.toml").string(), "-o", (here.path() / "out").string()});
    };
    const auto refused = [&](const Result& result, const char* id) {
        CHECK(result.exit_code == 2);
        CHECK(result.err.find(std::string("error[") + id + "]") != std::string::npos);
        CHECK_FALSE(fs::exists(here.path() / "out"));
    };
    refused(run({"generate", (here.path() / "nowhere.toml").string(), "-o", (here.path() / "out").string()}), "unreadable-file");
    refused(run({"generate", here.path().string(), "-o", (here.path() / "out").string()}), "unreadable-file");
    refused(generate(std::string(10'000'000, 'x')), "file-too-large");
    refused(generate(std::string("\x7f""ELF\x02\x01\x01\0\0\0", 10)), "not-text");
    refused(generate("name = \"\xff\xfe\""), "not-text");
    refused(generate(""), "missing-key");
}

TEST_CASE("two hundred nested brackets") {
    const TemporaryFolder here;
    const std::string nested = std::string(200, '(') + "x" + std::string(200, ')');
    std::ofstream(here.path() / "model.toml") << "[model]\nformat = 1\nname = \"m\"\n[coordinates]\nx = { unit = \"m\" }\n[bodies.b]\nmass = \"" << nested
                                              << "\"\nposition = [\"x\", 0, 0]\n";
    const Result result = run({"generate", (here.path() / "model.toml").string(), "-o", (here.path() / "out").string()});
    CHECK(result.exit_code == 2);
    CHECK(result.err.find("error[too-deep]") != std::string::npos);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What `dalembert new` writes for each kind of project, and what `check` says of it. tests/new/projects.sh builds the programs.
#include "command/project_kinds.hpp"
#include "golden/support.hpp"

using namespace golden;

namespace {

std::string without(std::string text, const std::string& folder) {
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    return text;
}

}  // namespace

TEST_CASE("new projects, and the check of their models") {
    const fs::path expected = source / "tests" / "golden" / "expected";
    std::set<std::string> kinds{"common"};
    for (const dalembert::ProjectKind& kind : dalembert::project_kinds) {
        kinds.insert(kind.name);
        const TemporaryFolder here;
        const std::string root = here.path().string() + "/";
        CAPTURE(kind.name);
        const Result written = run({"new", "crane", "--kind", kind.name, "-o", here.path().string()});
        CHECK(written.exit_code == 0);
        CHECK(written.err.empty());
        expect(expected / ("new_" + std::string(kind.name) + ".txt"), without(written.out, root));

        std::vector<std::string> check{"check"};
        std::set<fs::path> models;
        for (const auto& entry : fs::directory_iterator(here.path() / "crane"))
            if (entry.path().extension() == ".toml") models.insert(entry.path());
        check.insert(check.end(), models.begin(), models.end());
        const Result checked = run(check);
        CHECK(checked.exit_code == 0);
        CHECK(checked.err.empty());
        expect(expected / ("new_" + std::string(kind.name) + "_check.txt"), without(checked.out, root));
    }
    std::set<std::string> folders;
    for (const auto& entry : fs::directory_iterator(source / "templates" / "new")) folders.insert(entry.path().filename());
    CHECK(folders == kinds);
}

TEST_CASE("a new project as JSON, without a kind and in an empty folder") {
    const TemporaryFolder here;
    fs::create_directory(here.path() / "crane");
    const Result result = run({"new", "crane", "-o", here.path().string(), "--format", "json"});
    CHECK(result.exit_code == 0);
    expect(source / "tests" / "golden" / "expected" / "new.json", without(result.out, here.path().string() + "/"));
}

TEST_CASE("a new project that cannot be written leaves everything as it was") {
    const TemporaryFolder here;
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& sentence) {
        std::vector<std::string> all{"new"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        all.insert(all.end(), {"-o", here.path().string()});
        const Result result = run(all);
        CAPTURE(result.err);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(result.err.find(sentence) != std::string::npos);
    };
    for (const char* name : {"2cranes", "my-crane", "crane.toml", "../crane", "a/b", ".", ""}) refused({name}, "error[bad-name]: '" + std::string(name) + "' is not a name");
    for (const char* name : {"class", "std", "main", "sin"}) refused({name}, "error[reserved-name]: '" + std::string(name) + "'");
    refused({"crane", "--kind", "mechanic"}, "'mechanic' is not one of 'mechanics', 'hydraulics', 'heat', 'controller' and 'catalogue'; did you mean 'mechanics'?");
    CHECK(here.is_empty());

    std::ofstream(here.path() / "taken") << "text";
    refused({"taken"}, "there is a file of this name");
    CHECK(content(here.path() / "taken") == "text");
    fs::create_directory(here.path() / "crane");
    std::ofstream(here.path() / "crane" / "notes.txt") << "text";
    refused({"crane"}, "exists and is not empty");
    CHECK(std::distance(fs::directory_iterator(here.path() / "crane"), fs::directory_iterator()) == 1);
}

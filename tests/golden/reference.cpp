// SPDX-License-Identifier: GPL-3.0-or-later
// systems/reference holds the pages that the program writes from its tables; each row of these tables says something.
#include <set>

#include "golden/support.hpp"
#include "report/json_fields.hpp"
#include "text/diagnostic.hpp"

using namespace golden;

namespace {

std::set<std::string> files_in(const fs::path& folder) {
    std::set<std::string> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path().filename().string());
    return files;
}

}  // namespace

TEST_CASE("systems/reference is what the program writes") {
    const TemporaryFolder fresh;
    for (const char* format : {"markdown", "html"}) {
        const Result result = run({"help", "--format", format, "-o", fresh.path().string()});
        CHECK(result.exit_code == 0);
        CHECK(result.out.empty());
        CHECK(result.err.empty());
    }
    const fs::path kept = source / "systems" / "reference";
    if (accepting()) {
        fs::remove_all(kept);
        fs::copy(fresh.path(), kept, fs::copy_options::recursive);
        return;
    }
    const auto made = files_in(fresh.path());
    CHECK(files_in(kept) == made);
    for (const std::string& file : made) {
        INFO(file, "; ./dev accept writes systems/reference anew");
        CHECK((content(fresh.path() / file) == content(kept / file)));
    }
}

TEST_CASE("every id has a sentence and an example in which it occurs") {
    for (const dalembert::DiagnosticKind& kind : dalembert::diagnostic_kinds()) {
        CAPTURE(kind.name);
        const std::string meaning = kind.meaning, example = dalembert::example_of(kind);
        CHECK(meaning.size() > 10);
        CHECK(meaning.ends_with('.'));
        CHECK(example.find("[" + std::string(kind.name) + "]: ") != std::string::npos);
        CHECK(example.ends_with('\n'));
    }
}

TEST_CASE("every field of a result has a sentence") {
    const auto check = [](std::span<const dalembert::JsonField> fields) {
        for (const dalembert::JsonField& field : fields) {
            CAPTURE(field.path);
            CHECK(*field.doc != '\0');
        }
    };
    check(dalembert::common_json_fields());
    for (const dalembert::JsonSchema& schema : dalembert::json_schemas()) check(schema.fields);
}

TEST_CASE("a word finds its page, its section or its rows, in every format") {
    const auto help = [](std::vector<std::string> words) {
        words.insert(words.begin(), "help");
        const Result result = run(words);
        CAPTURE(result.err);
        CHECK(result.exit_code == 0);
        return result.out;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    CHECK(has(help({"unit-mismatch"}), "error[unit-mismatch]: "));
    CHECK_FALSE(has(help({"unit-mismatch"}), "unknown-unit"));
    CHECK(has(help({"bodies.mass"}), "not below zero; unit: kg; optional"));
    CHECK_FALSE(has(help({"bodies.mass"}), "springs"));
    CHECK(has(help({"atan2"}), "atan2(y, x)"));
    CHECK(has(help({"ambient"}), "rods"));     // a key of its own, and of the ends of rods
    CHECK(has(help({"effects"}), "--against"));  // the verb
    CHECK(has(help({"effects", "--format", "markdown"}), "| `level_of` |"));  // and the section
    CHECK(has(help({"bodies", "--format", "markdown"}), "| `mass` | expression, not below zero | kg | optional | parameters, states |"));
    CHECK(has(help({"bodies", "--format", "html"}), "<dt id=\"bodies.mass\">"));
    CHECK(has(help({"--format", "html"}), "id=\"errors.unit-mismatch\""));
    const TemporaryFolder folder;
    CHECK(run({"help", "-o", folder.path().string()}).exit_code == 2);
    CHECK(folder.is_empty());
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/files.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "golden/support.hpp"
#include "text/process.hpp"

using namespace dalembert;
namespace fs = std::filesystem;

TEST_CASE("files are written all or none") {
    const golden::TemporaryFolder here;
    const fs::path good = here.path() / "new" / "folder" / "a.txt";
    std::ofstream(here.path() / "file") << "no folder";
    CHECK_THROWS(write_files({{good, "a"}, {here.path() / "file" / "b.txt", "b"}}));
    CHECK_FALSE(fs::exists(good));
    CHECK_FALSE(fs::exists(here.path() / "new"));
    write_files({{good, "a"}, {here.path() / "c.txt", "c"}});
    CHECK(read_file(good) == "a");
    CHECK(read_file(here.path() / "c.txt") == "c");
    for (const auto& entry : fs::recursive_directory_iterator(here.path())) CHECK(entry.path().extension() != ".part");
}

TEST_CASE("a file with the same content keeps its time stamp") {
    const golden::TemporaryFolder here;
    const fs::path path = here.path() / "a.txt";
    write_files({{path, "a"}});
    const auto old = fs::last_write_time(path) - std::chrono::hours(1);
    fs::last_write_time(path, old);
    write_files({{path, "a"}});
    CHECK(fs::last_write_time(path) == old);
    write_files({{path, "b"}});
    CHECK(fs::last_write_time(path) != old);
}

TEST_CASE("other programs run without a shell") {
    const ProcessResult result = run_process({"printf", "%s", "a; b $(c) `d`"});
    CHECK(result.exit_code == 0);
    CHECK(result.output == "a; b $(c) `d`");
    CHECK(run_process({"no-such-program-anywhere"}).exit_code == 127);
    // More output than a pipe holds, on both streams.
    const ProcessResult much = run_process({"sh", "-c", "head -c 300000 /dev/zero | tr '\\0' x; head -c 300000 /dev/zero | tr '\\0' y >&2; exit 5"});
    CHECK(much.exit_code == 5);
    CHECK(much.output.size() == 300000);
    CHECK(much.errors.size() == 300000);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Models of the repository with random damage: whatever comes of them, the program ends with a documented exit code, an error has
// a place, and nothing is left on disk.
#include <random>

#include "golden/support.hpp"

using namespace golden;

namespace {

/// One to three changes of characters, words or lines.
std::string mutated(std::string text, std::mt19937& engine) {
    static const std::vector<std::string> words{
        "(",    ")",    "[",    "]",   "\"",  "=",   "^",    "/0",        "0",  "-1", "1e400", "dot(", "sum(k,1,3,", "t",
        "\\",   "\n",   ",",    "..",  "sin", "kg",  "m",    "1/2",       "when", "unit", "\xc3\xa9", "{", "}", "#",
        "'",    "^99",  "sqrt(", "ddot(", "inf", "N", "phi[0]", "*", "+", "10000000000", "abs(", "\"\"\""};
    const auto pick = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine); };
    for (std::size_t changes = 1 + pick(3); changes > 0 && text.size() > 10; --changes) {
        const std::size_t at = pick(text.size());
        switch (pick(6)) {
            case 0: text.erase(at, 1 + pick(4)); break;
            case 1: text.insert(at, words[pick(words.size())]); break;
            case 2: text[at] = static_cast<char>(32 + pick(95)); break;
            case 3: {  // a line vanishes
                const std::size_t begin = text.rfind('\n', at) + 1;
                const std::size_t end = text.find('\n', at);
                if (end != std::string::npos) text.erase(begin, end - begin + 1);
                break;
            }
            case 4: {  // a line comes twice
                const std::size_t begin = text.rfind('\n', at) + 1;
                const std::size_t end = text.find('\n', at);
                if (end != std::string::npos) text.insert(begin, text.substr(begin, end - begin + 1));
                break;
            }
            default: {  // two pieces change places
                const std::size_t other = pick(text.size());
                std::swap(text[at], text[other]);
                break;
            }
        }
    }
    return text;
}

}  // namespace

TEST_CASE("damaged models") {
    std::vector<fs::path> models;
    for (const auto& entry : fs::recursive_directory_iterator(source / "systems"))
        if (entry.path().extension() == ".toml") models.push_back(entry.path());
    std::sort(models.begin(), models.end());
    const int count = std::getenv("DALEMBERT_FULL") != nullptr ? 10'000 : 600;
    std::mt19937 engine(2013);
    std::map<int, int> codes;
    const TemporaryFolder here;
    fs::create_directory(here.path() / "drives");
    fs::create_directory_symlink(source / "systems/parts", here.path() / "parts");  // which drives are made of
    for (int i = 0; i < count; ++i) {
        const fs::path& original = models[std::uniform_int_distribution<std::size_t>(0, models.size() - 1)(engine)];
        const std::string text = mutated(content(original), engine);
        const fs::path model = here.path() / "drives/model.toml";
        const fs::path results = here.path() / "results";
        std::ofstream(model, std::ios::binary) << text;
        const bool check = i % 4 == 0;
        const Result result = check ? run({"check", model.string()}) : run({"generate", model.string(), "-o", results.string()});
        ++codes[result.exit_code];
        INFO("mutation ", i, " of ", original.string(), "\n", result.err, "\n", text);
        REQUIRE((result.exit_code == 0 || result.exit_code == 2 || (check && result.exit_code == 1)));
        if (result.exit_code == 2) {
            CHECK_FALSE(fs::exists(results));
            CHECK(result.err.find("model.toml:") != std::string::npos);
            CHECK(result.err.find("error[") != std::string::npos);
            CHECK(result.err.find("defect of") == std::string::npos);
        }
        fs::remove_all(results);
    }
    MESSAGE("exit codes of ", count, " damaged models: 0 ", codes[0], ", 1 ", codes[1], ", 2 ", codes[2]);
}

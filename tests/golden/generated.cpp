// SPDX-License-Identifier: GPL-3.0-or-later
// generated/ holds what the program generates from systems/: every scene, and of families a few small sizes.
// The quick tier compares one header a model.
#include <algorithm>
#include <regex>
#include <set>

#include "golden/support.hpp"
#include "golden/without_effects.hpp"

namespace {

using namespace golden;

/// Sizes for which headers are kept, by model; all others have one.
const std::map<std::string, std::vector<std::string>> kept_sizes{{"n_pendulum", {"N=1", "N=2", "N=3", "N=5"}}};

/// The plots that README.md shows. Their last digits, and times, depend on the machine, so their bytes are not compared.
const std::string path_plot = "mechanics/cart_pendulum_lab.svg";
const std::string effects_plot = "hydraulics/hydraulic_cylinder_effects.svg";
const std::string cost_plot = "hydraulics/hydraulic_cylinder_real_cost.svg";

/// The folders of systems/, in the order of the gallery.
const std::vector<std::string> domains{"mechanics", "hydraulics", "pneumatics", "heat", "drives", "parts"};

bool takes_everything() { return is_full_tier() || accepting(); }

void generate_all(const fs::path& to) {
    for (const fs::path& path : system_models()) {
        const fs::path folder = to / fs::relative(path.parent_path(), source / "systems");
        std::vector<std::string> common{"generate", path.string(), "-o", folder.string()};
        if (takes_everything())
            common.emplace_back("--every-scene");
        else
            common.insert(common.end(), {"--scene", TextModel(content(path)).scenes().front()});
        const auto sizes = kept_sizes.find(path.stem().string());
        std::vector<std::string> kept = sizes == kept_sizes.end() ? std::vector<std::string>{""} : sizes->second;
        if (!takes_everything()) kept.erase(kept.begin(), kept.end() - 1);
        for (const std::string& size : kept) {
            std::vector<std::string> arguments = common;
            if (!size.empty()) arguments.insert(arguments.end(), {"--size", size});
            const Result result = run(arguments);
            INFO(path.string(), " ", size, ": ", result.err);
            CHECK(result.exit_code == 0);
            CHECK(result.err.empty());
            CHECK(result.out.find("everything proven") != std::string::npos);
        }
    }
}

std::set<std::string> files_below(const fs::path& folder) {
    std::set<std::string> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), folder).string());
    return files;
}

}  // namespace

TEST_CASE("generated/ is what the program generates") {
    const TemporaryFolder fresh;
    if (accepting()) {
        for (const std::string& domain : domains) fs::remove_all(source / "generated" / domain);
        generate_all(source / "generated");
        const Result result = run({"simulate", (source / "systems/mechanics/cart_pendulum.toml").string(), "-o", fresh.path().string()});
        CHECK(result.exit_code == 0);
        fs::copy_file(fresh.path() / "cart_pendulum_lab.svg", source / "generated" / path_plot);
        const Result effects =
            run({"effects", (source / "systems/hydraulics/hydraulic_cylinder.toml").string(), "-o", fresh.path().string()});
        CHECK(effects.exit_code == 0);
        fs::copy_file(fresh.path() / "hydraulic_cylinder_effects.svg", source / "generated" / effects_plot);
        const Result cost = run({"cost", (source / "systems/hydraulics/hydraulic_cylinder.toml").string(), "--scene", "real",
                                 "--arithmetics", "float,double", "--limit", "1", "-o", fresh.path().string()});
        CHECK(cost.exit_code == 0);
        fs::copy_file(fresh.path() / "hydraulic_cylinder_real_cost.svg", source / "generated" / cost_plot);
        return;
    }
    generate_all(fresh.path());
    auto expected = files_below(source / "generated");
    CHECK(expected.erase("README.md") == 1);
    std::erase_if(expected, [](const std::string& file) { return file.starts_with("gallery/") || file.starts_with("pages/"); });
    CHECK(expected.erase(path_plot) == 1);
    CHECK(expected.erase(effects_plot) == 1);
    CHECK(expected.erase(cost_plot) == 1);
    const auto made = files_below(fresh.path());
    if (takes_everything())
        CHECK(expected == made);
    else
        CHECK(made.size() == system_models().size());
    CHECK(std::includes(expected.begin(), expected.end(), made.begin(), made.end()));
    for (const std::string& file : made) {
        INFO(file, "; ./dev accept writes generated/ anew");
        CHECK((content(fresh.path() / file) == content(source / "generated" / file)));
    }
}

namespace {

std::string matched(const std::string& text, const char* pattern) {
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : std::string();
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
    return count;
}

/// Writes systems/gallery.html, systems/GALLERY.md and generated/gallery below a folder with models and headers.
void write_gallery(const fs::path& root) {
    std::vector<std::string> arguments{"gallery"};
    const std::set<fs::path> models = system_models();
    for (const std::string& domain : domains)
        for (const fs::path& path : models)
            if (path.parent_path().filename() == domain) arguments.push_back((root / "systems" / domain / path.filename()).string());
    const auto controllers = std::count_if(models.begin(), models.end(), is_controller);
    CHECK(arguments.size() + static_cast<std::size_t>(controllers) == models.size() + 1);
    arguments.insert(arguments.end(), {"-o", (root / "systems").string(), "--generated", (root / "generated").string()});
    const Result result = run(arguments);
    INFO(result.err);
    CHECK(result.exit_code == 0);
}

}  // namespace

TEST_CASE("the gallery has every system, as its model and its header are") {
    if (accepting()) return;
    const std::string page = content(source / "systems/GALLERY.md"), html = content(source / "systems/gallery.html");
    for (const fs::path& path : system_models()) {
        if (is_controller(path)) continue;
        const std::string model = content(path), link = fs::relative(path, source / "systems").string();
        INFO(link, "; ./dev accept writes the gallery anew");
        const std::size_t at = page.find("](" + link + ")");
        REQUIRE(at != std::string::npos);
        const std::size_t begin = page.rfind('\n', at) + 1;
        const std::string row = page.substr(begin, page.find('\n', at) - begin);
        CHECK(row.find("[" + matched(model, "\ntitle *= \"(.*)\"") + "]") != std::string::npos);
        const std::string sentence = matched(model, "\ndoc *= \"(.*)\"");
        CHECK_FALSE(sentence.empty());
        CHECK(row.find("<br>" + sentence) != std::string::npos);
        const std::string header = content(source / "systems" / matched(row, "\\[header\\]\\(([^)]*)\\)"));
        int operations = 0;
        std::istringstream counts(matched(header, "\n//   rhs +([0-9 ]+)\n"));
        for (int count = 0; counts >> count;) operations += count;
        CHECK(row.find(" " + matched(header, "degrees_of_freedom = ([0-9]+);") + " | " + matched(header, "[^_]state_count = ([0-9]+);") +
                       " | " + std::to_string(operations) + " |") != std::string::npos);
        CHECK(count_of(html, "<article id=\"" + path.stem().string() + "\"") == 1);
        const std::string picture = content(source / "generated/gallery" / (path.stem().string() + ".svg"));
        CHECK(count_of(picture, "<path ") >= 2);
        CHECK(picture.ends_with("</svg>\n"));
        CHECK(picture.size() < 12000);
    }
}

TEST_CASE("the gallery is what the program writes") {
    if (accepting()) return write_gallery(source);
    if (!is_full_tier()) return;  // derives, checks and runs every system
    const TemporaryFolder fresh;
    for (const char* folder : {"systems", "generated"}) {
        fs::create_directory(fresh.path() / folder);
        for (const std::string& domain : domains) fs::create_directory_symlink(source / folder / domain, fresh.path() / folder / domain);
    }
    fs::create_directory_symlink(source / "systems/controllers", fresh.path() / "systems/controllers");  // that machines use
    write_gallery(fresh.path());
    for (const char* page : {"systems/gallery.html", "systems/GALLERY.md"}) {
        INFO(page, "; ./dev accept writes it anew");
        CHECK((content(fresh.path() / page) == content(source / page)));
    }
    // A rounding may move a point of a picture.
    const auto pictures = files_below(fresh.path() / "generated/gallery");
    CHECK(pictures == files_below(source / "generated/gallery"));
    for (const std::string& picture : pictures)
        CHECK(count_of(content(fresh.path() / "generated/gallery" / picture), "<path ") ==
              count_of(content(source / "generated/gallery" / picture), "<path "));
}

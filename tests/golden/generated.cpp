// SPDX-License-Identifier: GPL-3.0-or-later
// generated/ holds what the program generates from systems/: every scene, and of families a few small sizes.
#include <set>

#include "golden/support.hpp"

namespace {

using namespace golden;

/// Sizes for which headers are kept, by model; all others have one.
const std::map<std::string, std::vector<std::string>> kept_sizes{{"n_pendulum", {"N=1", "N=2", "N=3", "N=5"}}};

/// The plots that README.md shows. Their last digits, and times, depend on the machine, so their bytes are not compared.
const std::string path_plot = "mechanics/cart_pendulum_lab.svg";
const std::string effects_plot = "hydraulics/hydraulic_cylinder_effects.svg";
const std::string cost_plot = "hydraulics/hydraulic_cylinder_real_cost.svg";

void generate_all(const fs::path& to) {
    for (const fs::path& path : system_models()) {
        const fs::path folder = to / fs::relative(path.parent_path(), source / "systems");
        const std::vector<std::string> common{"generate", path.string(), "--every-scene", "-o", folder.string()};
        const auto sizes = kept_sizes.find(path.stem().string());
        for (const std::string& size : sizes == kept_sizes.end() ? std::vector<std::string>{""} : sizes->second) {
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
        fs::remove_all(source / "generated");
        generate_all(source / "generated");
        const Result result = run({"simulate", (source / "systems/mechanics/cart_pendulum.toml").string(), "-o", fresh.path().string()});
        CHECK(result.exit_code == 0);
        fs::copy_file(fresh.path() / "cart_pendulum_lab.svg", source / "generated" / path_plot);
        const Result effects = run({"effects", (source / "systems/hydraulics/hydraulic_cylinder.toml").string(), "-o", fresh.path().string()});
        CHECK(effects.exit_code == 0);
        fs::copy_file(fresh.path() / "hydraulic_cylinder_effects.svg", source / "generated" / effects_plot);
        const Result cost = run({"cost", (source / "systems/hydraulics/hydraulic_cylinder.toml").string(), "--scene", "real", "--arithmetics", "float,double", "--limit", "1", "-o", fresh.path().string()});
        CHECK(cost.exit_code == 0);
        fs::copy_file(fresh.path() / "hydraulic_cylinder_real_cost.svg", source / "generated" / cost_plot);
        return;
    }
    generate_all(fresh.path());
    auto expected = files_below(source / "generated");
    CHECK(expected.erase(path_plot) == 1);
    CHECK(expected.erase(effects_plot) == 1);
    CHECK(expected.erase(cost_plot) == 1);
    const auto made = files_below(fresh.path());
    CHECK(expected == made);
    for (const std::string& file : made) {
        INFO(file, "; ./dev accept writes generated/ anew");
        CHECK((content(fresh.path() / file) == content(source / "generated" / file)));
    }
}

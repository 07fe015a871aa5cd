// SPDX-License-Identifier: GPL-3.0-or-later
// What the verbs print for the systems of the repository.
#include <set>

#include "golden/support.hpp"

using namespace golden;

namespace {

/// The path of a model in outputs, whatever folder the repository stands in.
std::string without_path(std::string text) {
    const std::string root = source.string() + "/";
    for (std::size_t at; (at = text.find(root)) != std::string::npos;) text.erase(at, root.size());
    return text;
}

struct Kept {
    std::string file;
    std::vector<std::string> arguments;
    int exit_code = 0;
};

}  // namespace

TEST_CASE("outputs of the verbs") {
    const auto model = [](const char* name) { return (source / "systems" / "mechanics" / name).string() + ".toml"; };
    std::vector<Kept> kept{
        {"derive_cart_pendulum.txt", {"derive", model("cart_pendulum")}},
        {"derive_cart_pendulum.tex", {"derive", model("cart_pendulum"), "--format", "latex"}},
        {"derive_cart_pendulum.json", {"derive", model("cart_pendulum"), "--format", "json"}},
        {"derive_n_pendulum_N4.txt", {"derive", model("n_pendulum"), "--size", "N=4"}},
        {"derive_projectile.txt", {"derive", model("projectile")}},
        {"derive_drive_train.txt", {"derive", model("drive_train")}},
        {"check_coupled_springs.json", {"check", model("coupled_springs"), "--format", "json"}},
        {"evaluate_cart_pendulum.txt",
         {"evaluate", model("cart_pendulum"), "--state", "s=0.55,phi=0.7,dot(s)=-0.3", "--input", "f_e=4.5", "--parameter", "m_W=1200 g"}},
        {"evaluate_cart_pendulum.json", {"evaluate", model("cart_pendulum"), "--state", "s=55 cm, phi=40 deg", "--format", "json"}},
        {"evaluate_kepler_40_digits.txt", {"evaluate", model("kepler"), "--digits", "40"}},
        {"scenes_cart_pendulum.txt", {"scenes", model("cart_pendulum")}},
        {"scenes_projectile.json", {"scenes", model("projectile"), "--format", "json"}},
        {"help_bodies.txt", {"help", "bodies"}},
        {"help_mass.txt", {"help", "mass"}},
        {"help_errors.txt", {"help", "errors"}},
        {"help_functions.txt", {"help", "functions"}},
        {"help_quantities.txt", {"help", "quantities"}},
        {"dump_scene.txt", {"generate", model("cart_pendulum"), "--scene", "ideal", "--dump", "scene"}},
        {"header_in_c.txt", {"generate", model("cart_pendulum"), "--language", "c", "--dump", "code"}},
        {"dump_atoms.txt", {"generate", model("spherical_pendulum"), "--dump", "atoms"}},
    };
    std::set<fs::path> models{source / "tests/golden/capacitor.toml"};
    for (const auto& entry : fs::recursive_directory_iterator(source / "systems"))
        if (entry.path().extension() == ".toml") models.insert(entry.path());
    std::size_t number = 0;  // of machines every other one is of the quick tier, which proves all of them where it makes their headers
    for (const fs::path& path : models)
        if (is_full_tier() || accepting() || (!is_slow(path) && (path.parent_path().filename() == "book" || number++ % 2 == 0)))
            kept.push_back({"check_" + path.stem().string() + ".txt", {"check", path.string()}});
    for (const Kept& one : kept) {
        const Result result = run(one.arguments);
        CAPTURE(one.file);
        CHECK(result.exit_code == one.exit_code);
        CHECK(result.err.empty());
        expect(source / "tests" / "golden" / "expected" / one.file, without_path(result.out));
    }
}

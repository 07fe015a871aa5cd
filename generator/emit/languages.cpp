// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/languages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "c/fields.hpp"
#include "c/header.hpp"
#include "cpp/fields.hpp"
#include "cpp/header.hpp"
#include "elements/model.hpp"
#include "js/module.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

std::string prefix_of(const Scene& scene) { return scene.sized_name() + "_" + scene.name; }

std::string name_of_space(const Scene& scene) { return fmt::format("{}::{}", scene.sized_name(), scene.name); }

/// The warning of compilers that make wrong code, without the licence of its file.
std::string compiler_check() {
    const std::string_view text = embedded_file("compiler.h");
    return std::string(text.substr(text.find('\n') + 1)) + "\n";
}

std::string file_in_cpp(const Plant& plant, const PlantFields* fields, const Scene& scene, const std::string& banner) {
    const std::string name_space = name_of_space(scene);
    std::string guard = prefix_of(scene) + "_hpp";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string content =
        fields == nullptr ? cpp_plant(plant, name_space)
                          : cpp_plant(plant, name_space + "::core") + "\n" + cpp_fields(*fields, plant, name_space);
    return fill_template(embedded_file("header.hpp.in"), {{"BANNER", banner}, {"GUARD", guard}, {"CONTENT", compiler_check() + content}});
}

std::string file_in_c(const Plant& plant, const PlantFields* fields, const Scene& scene, const std::string& banner) {
    const std::string name = prefix_of(scene);
    return c_file(compiler_check() + (fields == nullptr ? c_plant(plant, name) : c_fields(plant, *fields, name)), name, banner);
}

std::string file_in_javascript(const Plant& plant, const PlantFields* fields, const Scene& scene, const std::string& banner) {
    if (fields != nullptr)
        throw Failure(Diagnostic{Id::bad_option, scene.model->name_span,
                                 fmt::format("scene '{}' has a rod whose cells are computed in loops, which JavaScript does not express "
                                             "yet; --language c and c++ do, and so does a rod of fewer cells",
                                             scene.name)});
    if (plant.sampling)
        throw Failure(Diagnostic{Id::bad_option, scene.model->name_span,
                                 fmt::format("'{}' is a controller that samples, and JavaScript has none yet; --language c and c++ do",
                                             scene.model->name)});
    return js_module(plant, prefix_of(scene), banner);
}

constexpr Language all_languages[]{
    {"c++", ".hpp", "a class for any scalar type, C++17", name_of_space, file_in_cpp},
    {"c", ".h", "functions for float or double, C99", prefix_of, file_in_c},
    {"javascript", ".js", "a module of functions for doubles, ECMAScript 2020", prefix_of, file_in_javascript},
};

}  // namespace

std::span<const Language> languages() { return all_languages; }

const Language& language_named(const std::string& name) {
    const auto found =
        std::find_if(std::begin(all_languages), std::end(all_languages), [&](const Language& one) { return name == one.name; });
    if (found == std::end(all_languages)) throw std::logic_error("no language of that name: " + name);
    return *found;
}

}  // namespace dalembert

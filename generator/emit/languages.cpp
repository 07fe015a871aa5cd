// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/languages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "c/header.hpp"
#include "cpp/header.hpp"
#include "emit/field_header.hpp"
#include "text/diagnostic.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

std::string prefix_of(const Scene& scene) { return scene.sized_name() + "_" + scene.name; }

std::string name_of_space(const Scene& scene) { return fmt::format("{}::{}", scene.sized_name(), scene.name); }

std::string cpp_file(const Plant& plant, const FieldCode* fields, const Scene& scene, const std::string& banner) {
    const std::string name_space = name_of_space(scene);
    std::string guard = prefix_of(scene) + "_hpp";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string content = fields == nullptr ? cpp_plant(plant, name_space) : cpp_plant(plant, name_space + "::core") + "\n" + field_content(*fields, name_space);
    return fill_template(embedded_file("header.hpp.in"), {{"BANNER", banner}, {"GUARD", guard}, {"CONTENT", content}});
}

std::string c_file(const Plant& plant, const FieldCode* fields, const Scene& scene, const std::string& banner) {
    if (fields != nullptr)
        throw Failure(Diagnostic{Id::bad_option, scene.model->name_span,
                                 fmt::format("--language c: '{}' has rods whose cells are computed in loops, which only C++ has so far; a smaller size has code for each of them", scene.model->name)});
    return c_plant(plant, prefix_of(scene), banner);
}

constexpr Language all_languages[]{
    {"c++", ".hpp", "a class for any scalar type, C++17", name_of_space, cpp_file},
    {"c", ".h", "functions for float or double, C99", prefix_of, c_file},
};

}  // namespace

std::span<const Language> languages() { return all_languages; }

const Language& language_named(const std::string& name) {
    const auto found = std::find_if(std::begin(all_languages), std::end(all_languages), [&](const Language& one) { return name == one.name; });
    if (found == std::end(all_languages)) throw std::logic_error("no language of that name: " + name);
    return *found;
}

}  // namespace dalembert

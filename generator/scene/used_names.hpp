// SPDX-License-Identifier: GPL-3.0-or-later
// What the elements of a scene use: parameters, inputs, states, definitions, solids and media, by their names.
#pragma once

#include <set>
#include <string>

#include "scene/choose_fields.hpp"
#include "scene/scene.hpp"

namespace dalembert {

class UsedNames {
public:
    /// `fields` are found already; what is used of them is tapped.
    UsedNames(Scene& scene, const Names& names, FieldChoice& fields) : scene_(scene), names_(names), fields_(fields) {}

    /// Throws Failure (needs-absent) where something that the scene has needs what it leaves out.
    void find_all();
    bool contains(const std::string& name) const { return used_.contains(name); }
    bool contains_solid(const std::string& name) const { return solids_.contains(name); }

private:
    void use_elements();
    void use_outputs();
    template <class Element>
    void use_element(const Element& item);
    template <class Element>
    void use_expressions(const Element& item);
    void use_references(const Reference& to, const std::vector<const char*>& kinds, bool all_members);
    void use_media();
    bool is_of_orifice(const Medium& medium) const;
    void use_declared();
    void use_in_runs();
    void use(const Site& site);
    void use_solid(const std::string& name);
    void use_name(const std::string& name, const Span& span);

    Scene& scene_;
    const Names& names_;
    FieldChoice& fields_;
    std::set<std::string> used_, solids_, media_;
    bool is_output_ = false;  ///< what is used is used by an output
    std::string owner_;       ///< "spring 'wall'", which uses it
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/expression_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/statics.hpp"
#include "elements/switching.hpp"
#include "text/nearest.hpp"

namespace dalembert {

unsigned ExpressionCheck::quantity(const Expression& e) {
    const QuantitySpec& spec = *find_quantity(e.name);
    const std::size_t given = e.children.size();
    const SubscriptSpec& shape = subscript(spec.subscript);
    const bool is_optional = spec.subscript == Subscript::optional_body || spec.subscript == Subscript::optional_store ||
                             spec.subscript == Subscript::optional_damper;
    if (given != shape.count && !(is_optional && given == 0) && !(spec.subscript == Subscript::fluid_or_medium && given == 3)) {
        error(Id::wrong_arguments, e.span, fmt::format("'{}' takes {} in square brackets", e.name, shape.words));
        return 0;
    }
    if (spec.subscript >= Subscript::fluid) return part_quantity(e, spec);
    if (spec.subscript >= Subscript::solid && spec.subscript <= Subscript::sticking) return statics_quantity(e, spec);
    const bool axes_follow = spec.subscript == Subscript::body_and_axis || spec.subscript == Subscript::body_and_two_axes ||
                             spec.subscript == Subscript::surface || spec.subscript == Subscript::two_surfaces;
    for (std::size_t i = 0; i < given; ++i) {
        const Expression& child = *e.children[i];
        if (i == 0) element(child, kinds_of_first(spec, given));
        else if (axes_follow) whole_number(child);
        else element(child, {"coordinate"});
    }
    return allow(e, dependence(spec),
                 spec.is_place      ? "a place of a body"
                 : spec.is_velocity ? "a velocity of a body"
                                    : "a derived quantity");
}

unsigned ExpressionCheck::statics_quantity(const Expression& e, const QuantitySpec& spec) {
    const Expression& named = *e.children[0];
    const bool is_name = named.kind == Kind::name && named.children.empty();
    const auto unknown = [&](const char* what, const std::vector<std::string>& known) {
        error(Id::unknown_name, named.span, fmt::format("'{}' is not {}{}", named.written(), what, did_you_mean(named.name, known)));
        return 0U;
    };
    if (spec.subscript == Subscript::sticking) {
        if (!is_name || names_.find_element<Sticking>(named.name) == nullptr)
            return unknown("an entry of [sticking]", names_.names_of({"sticking"}));
        return allow(e, dependence(spec), "a derived quantity");
    }
    if (spec.subscript <= Subscript::solid_and_axes) {
        if (!is_name || names_.find_element<Solid>(named.name) == nullptr) return unknown("a solid", names_.names_of({"solid"}));
        for (std::size_t i = 1; i < e.children.size(); ++i) whole_number(*e.children[i]);
        return allow(e, on_parameters, "made of parameters");
    }
    const Load* load = is_name ? names_.find_element<Load>(named.name) : nullptr;
    if (load == nullptr) return unknown("a load", names_.names_of({"load"}));
    if (spec.subscript == Subscript::load_and_axis) {
        whole_number(*e.children[1]);
    } else {
        const Expression& asked = *e.children[1];
        if (std::none_of(load->unknowns.begin(), load->unknowns.end(), [&](const Unknown& u) {
                return asked.kind == Kind::name && asked.children.empty() && u.name == asked.name;
            })) {
            std::vector<std::string> known;
            for (const Unknown& u : load->unknowns) known.push_back(u.name);
            error(Id::unknown_name, asked.span,
                  fmt::format("'{}' is not an unknown of load '{}'{}", asked.written(), load->name,
                              known.empty() ? "; it has none" : "; they are " + quoted_list(known)),
                  {{load->span, "the load is defined here"}});
            return 0;
        }
    }
    return allow(e, dependence(*load, names_), "what follows from forces that depend on more");
}

unsigned ExpressionCheck::part_quantity(const Expression& e, const QuantitySpec& spec) {
    if (!e.children.empty()) element(*e.children[0], kinds_of_first(spec, e.children.size()));
    unsigned depends =
        allow(e, spec.is_property ? on_properties : on_quantities, spec.is_property ? "a property of a medium" : "a derived quantity");
    for (std::size_t i = 1; i < e.children.size(); ++i) depends |= visit(*e.children[i]);
    return depends;
}

void ExpressionCheck::element(const Expression& e, const std::vector<const char*>& kinds) {
    const OfKind found = e.kind == Kind::name ? names_.find_element(e.name, kinds) : OfKind{nullptr, nullptr};
    if (found.item != nullptr && !found.kind->facts.has_cells) return index(e, *found.item);
    if (found.item != nullptr && e.children.size() == 1) return whole_number(*e.children[0]);
    if (found.item != nullptr)
        return error(
            Id::index_missing, e.span,
            fmt::format("'{}' is a {} and needs the index of a cell, as in '{}[1]'", e.name, found.kind->word, e.name));
    const std::string hint = e.kind == Kind::name ? did_you_mean(e.name, names_.names_of(kinds)) : "";
    error(Id::unknown_name, e.span, fmt::format("'{}' is not {}{}", e.written(), with_article(words_of(kinds)), hint));
}

}  // namespace dalembert

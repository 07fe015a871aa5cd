// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/expression_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/every_kind.hpp"
#include "text/nearest.hpp"

namespace dalembert {

void ExpressionCheck::check(const Site& site) {
    site_ = &site;
    bound_ = {site.bound.begin(), site.bound.end()};
    reported_ = false;
    for (const std::string& name : site.bound)
        if (!site.may_shadow && names_.find(name) != nullptr && shadowing_.insert(site.what + name).second)
            error(Id::doubly_defined, site.expression->span,
                  fmt::format("'{}' is already defined, but {} uses it again as an index or variable", name, site.what));
    visit(*site.expression);
}

void ExpressionCheck::error(Id id, const Span& span, std::string message, std::vector<Note> notes) {
    reported_ = true;
    diagnostics_.error(id, span, std::move(message), std::move(notes));
}

unsigned ExpressionCheck::visit(const Expression& e) {
    switch (e.kind) {
        case Kind::number: return 0;
        case Kind::name: return name(e);
        case Kind::call: return call(e);
        case Kind::sum: return sum(e);
        default: break;
    }
    unsigned result = 0;
    for (const ExpressionPtr& child : e.children) result |= visit(*child);
    return result;
}

std::vector<Note> ExpressionCheck::definition_of(const Expression& e) const {
    const Expression* named = &e;
    while (named->kind == Kind::call && !named->children.empty()) named = named->children[0].get();
    const Named* found = named->kind == Kind::name ? names_.find(named->name) : nullptr;
    if (found == nullptr) return {};
    return {{found->item->span, fmt::format("'{}' is defined here", named->name)}};
}

unsigned ExpressionCheck::allow(const Expression& e, unsigned depends, const char* is_a) {
    if ((depends & ~site_->allowed) != 0 && !reported_)
        error(Id::not_allowed_here, e.span, fmt::format("{} must not depend on '{}', which is {}", site_->what, e.written(), is_a),
              definition_of(e));
    return depends;
}

std::string ExpressionCheck::hint(const Expression& e) const {
    for (const char* ending : {"_ddot", "_dot"})
        if (const std::string base = e.name.substr(0, e.name.size() - std::min(e.name.size(), std::string(ending).size()));
            e.name.ends_with(ending) && names_.find(base) != nullptr)
            return fmt::format("; write {}({})", ending + 1, base);
    return hint_for_unknown(e, names_);
}

unsigned ExpressionCheck::name(const Expression& e) {
    if (bound_.contains(e.name)) {
        if (!e.children.empty()) error(Id::not_indexed, e.span, fmt::format("'{}' has no index", e.name));
        return 0;
    }
    if (e.name == "pi" || e.name == "stefan_boltzmann") return 0;
    if (e.name == "infinity") {
        error(Id::not_allowed_here, e.span, "'infinity' is not a number; only limits and bounds of integrals may use it");
        return 0;
    }
    if (find_quantity(e.name) != nullptr) return quantity(e);
    if (e.name == "t") {
        if (!e.children.empty()) error(Id::not_indexed, e.span, "'t' has no index");
        if (site_->sizes_only) return sizes_only(e);
        return allow(e, on_time, "the time");
    }
    const Named* named = names_.find(e.name);
    if (named == nullptr) {
        const bool is_function = find_function(e.name) != nullptr || is_special_form(e.name) || is_printed_form(e.name);
        const Curve* curve = names_.find_element<Curve>(e.name);
        error(Id::unknown_name, e.span,
              curve != nullptr ? fmt::format("'{0}' is a curve and needs its argument{2} in brackets, as in {0}({1})", e.name,
                                           arguments_of(*curve), curve->grid ? "s" : "")
              : is_function ? fmt::format("'{}' is a function and needs its arguments in brackets", e.name)
                          : fmt::format("'{}' is not defined{}", e.name, hint(e)));
        return 0;
    }
    index(e, *named->item);
    if (named->kind == Named::Kind::size) return 0;
    if (site_->sizes_only) return sizes_only(e);
    switch (named->kind) {
        case Named::Kind::parameter: return allow(e, on_parameters, "a parameter");
        case Named::Kind::coordinate: return allow(e, on_coordinates, "a coordinate");
        case Named::Kind::input: return allow(e, on_inputs, "an input");
        case Named::Kind::state: return allow(e, on_states, "a state");
        case Named::Kind::output: return allow(e, on_outputs, "an output");
        case Named::Kind::mode: return allow(e, on_modes, "a mode");
        default: break;
    }
    return definition(e, named->definition());
}

unsigned ExpressionCheck::sizes_only(const Expression& e) {
    error(Id::not_allowed_here, e.span,
          fmt::format("{} must be a whole number known at generation, but '{}' is not", site_->what, e.written()));
    return 0;
}

unsigned ExpressionCheck::definition(const Expression& e, const Definition& item) {
    const unsigned depends = dependence(*item.value, names_);
    if ((depends & ~site_->allowed) != 0 && !reported_)
        error(Id::not_allowed_here, e.span,
              fmt::format("{} must not depend on '{}': its definition contains a name that is not allowed here", site_->what, e.written()),
              {{item.span, fmt::format("'{}' is defined here", e.name)}});
    return depends;
}

void ExpressionCheck::index(const Expression& e, const Item& item) {
    const std::size_t expected = item.family ? 1 : 0;
    if (expected == 1 && e.children.empty()) {
        error(Id::index_missing, e.span, fmt::format("'{}' is a family and needs an index, as in '{}[1]'", e.name, e.name),
              {{item.span, "the family is defined here"}});
        return;
    }
    if (expected == 0 && !e.children.empty()) {
        error(Id::not_indexed, e.span, fmt::format("'{}' is not a family and has no index", e.name),
              {{item.span, "it is defined here"}});
        return;
    }
    if (e.children.size() > 1) error(Id::not_indexed, e.span, fmt::format("'{}' has one index", e.name));
    for (const ExpressionPtr& child : e.children) whole_number(*child);
}

void ExpressionCheck::whole_number(const Expression& e) {
    for_each(e, [&](const Expression& part) {
        if (part.kind == Kind::call || part.kind == Kind::sum)
            error(Id::not_allowed_here, part.span, "an index is made of whole numbers, sizes, + - and *");
        if (part.kind != Kind::name || bound_.contains(part.name)) return;
        const Named* named = names_.find(part.name);
        if (named == nullptr)
            error(Id::unknown_name, part.span, fmt::format("'{}' is not defined{}", part.name, did_you_mean(part.name, names_.all())));
        else if (named->kind != Named::Kind::size)
            error(Id::not_allowed_here, part.span,
                  fmt::format("an index must be known at generation, but '{}' is {}", part.name, describe(named->kind)));
    });
}

unsigned ExpressionCheck::sum(const Expression& e) {
    whole_number(*e.children[0]);
    whole_number(*e.children[1]);
    const bool shadows = bound_.contains(e.name) || names_.find(e.name) != nullptr || e.name == "t" || e.name == "pi";
    if (shadows) error(Id::doubly_defined, e.span, fmt::format("the index '{}' of the sum already has another meaning here", e.name));
    const auto inserted = bound_.insert(e.name);
    const unsigned result = visit(*e.children[2]);
    if (inserted.second) bound_.erase(inserted.first);
    return result;
}

void check_expressions(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    ExpressionCheck check(names, diagnostics);
    visit(model, [&](const Site& site) { check.check(site); });
}

void check_expressions(const PrintedEquation& printed, const Names& names, Diagnostics& diagnostics) {
    ExpressionCheck check(names, diagnostics);
    visit(printed, [&](const Site& site) { check.check(site); });
}

}  // namespace dalembert

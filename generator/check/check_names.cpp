// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "check/checks.hpp"
#include "elements/every_kind.hpp"
#include "elements/references.hpp"
#include "elements/sites.hpp"
#include "language/reserved_names.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

bool is_identifier(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (name.empty() || name.size() > 60 || !letter(name.front()) || name.back() == '_') return false;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool ok = letter(name[i]) || (name[i] >= '0' && name[i] <= '9') || (name[i] == '_' && name[i - 1] != '_');
        if (!ok) return false;
    }
    return true;
}

std::optional<NameProblem> problem_of_name(const std::string& name, bool is_in_header) {
    if (!is_identifier(name))
        return NameProblem{Id::bad_name, fmt::format("'{}' is not a name; a name is a letter followed by at most 59 letters, digits and "
                                                     "single underscores", name)};
    if (!is_in_header) return std::nullopt;
    const char* what = name == "restrict"     ? "a word of C"
                       : is_cpp_keyword(name) ? "a word of C++"
                       : is_cpp_macro(name)   ? "a macro of C++"
                       : name == "std"        ? "the namespace of C++"
                                              : nullptr;
    if (what == nullptr) return std::nullopt;
    return NameProblem{Id::reserved_name, fmt::format("'{}' is {} and cannot be a name in the header", name, what)};
}

/// Names, and who defined them first.
class NameCheck {
public:
    NameCheck(const Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    void run() {
        if (const auto problem = problem_of_model_name(model_.name))
            diagnostics_.error(problem->id, model_.name_span, problem->sentence);
        for_each_kind(model_, [&](const char*, const auto& items) { of_kind(items); });
        // A velocity gets the name NAME_dot in C++.
        for (const Coordinate& coordinate : model_.coordinates)
            if (const auto clash = in_formulas_.find(coordinate.name + "_dot"); clash != in_formulas_.end())
                diagnostics_.error(
                    Id::doubly_defined, clash->second->span,
                    fmt::format("'{}' is also the name of the velocity of '{}' in the header", clash->first, coordinate.name),
                    {{coordinate.span, fmt::format("'{}' is defined here", coordinate.name)}});
        for (const Event& event : model_.events)
            if (event.name == "event")
                diagnostics_.error(Id::reserved_name, event.span, "'event' is a name that every header with events defines itself");
        for (const PrintedEquation& printed : model_.printed)
            if (printed.name.empty() || printed.name.size() > 80)
                diagnostics_.error(Id::bad_name, printed.span, "the name of a printed equation has 1 to 80 characters");
    }

    void run_letters() {
        is_header_ = false;
        for (const Parameter& letter : model_.parameters) define(letter.name, letter);
        for (const Coordinate& letter : model_.coordinates) define(letter.name, letter);
    }

private:
    /// The names of the elements of one kind, and of the parts inside them that have names.
    template <class Items>
    void of_kind(const Items& items) {
        using Element = typename Items::value_type;
        if constexpr (std::derived_from<Element, Item>) {
            constexpr Naming naming = kind_of<Element>.facts.naming;
            std::map<std::string, const Item*> seen;
            for (const Element& item : items) {
                if (naming == Naming::section) well_formed(item.name, item.span);
                if (naming == Naming::formulas) define(item.name, item);
                if (naming == Naming::parts) part(item);
                if (naming == Naming::brought_section) only_one(seen, item, kind_of<Element>.word);
                if constexpr (std::same_as<Element, ModeGroup>)
                    for (const Mode& mode : item.modes) define(mode.name, mode);
                if constexpr (std::same_as<Element, Load>)
                    for (const LoadPart& force : item.parts) well_formed(force.name, force.span);
            }
        }
    }

    bool well_formed(const std::string& name, const Span& span) {
        const auto problem = problem_of_name(name, is_header_);
        if (problem) diagnostics_.error(problem->id, span, problem->sentence);
        return !problem;
    }

    void define(const std::string& name, const Item& item) {
        if (!well_formed(name, item.span)) return;
        const char* meaning = name == "t"                             ? "the time"
                              : name == "pi"                          ? "the number pi"
                              : name == "infinity"                    ? "beyond all numbers"
                              : name == "stefan_boltzmann"            ? "the constant of radiation"
                              : find_function(name) != nullptr        ? "a function"
                              : find_quantity(name) != nullptr        ? "a derived quantity"
                              : is_special_form(name)                 ? "an operation"
                                                                      : nullptr;
        if (meaning != nullptr) {
            diagnostics_.error(Id::reserved_name, item.span,
                               fmt::format("'{}' is {} in every model and cannot be defined again", name, meaning));
            return;
        }
        if (is_header_ && is_header_name(name)) {
            diagnostics_.error(Id::reserved_name, item.span, fmt::format("'{}' is a name that every header defines itself", name));
            return;
        }
        const auto [first, is_new] = in_formulas_.emplace(name, &item);
        if (!is_new)
            diagnostics_.error(Id::doubly_defined, item.span, fmt::format("'{}' is defined twice", name),
                               {{first->second->span, fmt::format("'{}' is first defined here", name)}});
    }

    void part(const Item& item) {
        if (!well_formed(item.name, item.span)) return;
        const auto [first, is_new] = parts_.emplace(item.name, &item);
        if (is_new) return;
        std::vector<const char*> sections;
        for_each_kind(model_, [&]<class Items>(const char* section, const Items&) {
            if constexpr (std::derived_from<typename Items::value_type, Item>)
                if (kind_of<typename Items::value_type>.facts.naming == Naming::parts) sections.push_back(section);
        });
        std::string among = words_of(sections);
        among.replace(among.rfind(" or "), 4, " and ");
        diagnostics_.error(Id::doubly_defined, item.span, fmt::format("'{}' is defined twice among {}", item.name, among),
                           {{first->second->span, fmt::format("'{}' is first defined here", item.name)}});
    }

    /// Of what elements bring along some may have the name of something that was written.
    void only_one(std::map<std::string, const Item*>& seen, const Item& item, const char* word) {
        if (!well_formed(item.name, item.span)) return;
        const auto [first, is_new] = seen.emplace(item.name, &item);
        if (!is_new)
            diagnostics_.error(Id::doubly_defined, item.span, fmt::format("there are two {}s '{}'", word, item.name),
                               {{first->second->span, fmt::format("'{}' is first defined here", item.name)}});
    }

    const Model& model_;
    Diagnostics& diagnostics_;
    bool is_header_ = true;
    std::map<std::string, const Item*> in_formulas_, parts_;  ///< by what they are called, the first of that name
};

/// Reports definitions, solids and loads that need themselves; the others can be followed without end.
class CycleCheck {
public:
    CycleCheck(const Names& names, Diagnostics& diagnostics) : names_(names), diagnostics_(diagnostics) {}

    void follow(const Definition& definition) {
        visit_once(definition, fmt::format("the definition of '{}' needs '{}' itself", definition.name, definition.name),
                   [&] { names_in(*definition.value, {}); });
    }
    void follow(const Solid& solid) {
        visit_once(solid, fmt::format("solid '{}' needs itself", solid.name), [&] {
            visit(solid, [&](const Site& site) { names_in(*site.expression, site.bound); });
            visit_references(solid, [&](const Referred& part) {
                if (const Solid* other = names_.find_element<Solid>(part.to.name)) follow(*other);
            });
        });
    }
    void follow(const Load& load) {
        visit_once(load, fmt::format("load '{}' depends on its own unknowns", load.name), [&] {
            std::vector<std::string> own;
            for (const Unknown& unknown : load.unknowns) own.push_back(unknown.name);
            visit(load, [&](const Site& site) { names_in(*site.expression, own); });
        });
    }
    void follow(const Sticking& sticking) {
        visit_once(sticking, fmt::format("sticking '{}' depends on its own result", sticking.name),
                   [&] { visit(sticking, [&](const Site& site) { names_in(*site.expression, {}); }); });
    }

private:
    /// What the names in an expression stand for, but for those that mean something else here.
    void names_in(const Expression& e, const std::vector<std::string>& bound) {
        if (e.kind == Kind::name && std::find(bound.begin(), bound.end(), e.name) != bound.end()) return;
        const QuantitySpec* quantity = e.kind != Kind::name || e.children.empty() ? nullptr : find_quantity(e.name);
        if (quantity != nullptr && quantity->subscript >= Subscript::solid && quantity->subscript <= Subscript::sticking) {
            const std::string& name = e.children[0]->name;
            if (const Solid* solid = names_.find_element<Solid>(name); solid != nullptr && quantity->subscript <= Subscript::solid_and_axes)
                follow(*solid);
            else if (const Load* load = names_.find_element<Load>(name);
                     load != nullptr && quantity->subscript <= Subscript::load_and_unknown)
                follow(*load);
            else if (const Sticking* sticking = names_.find_element<Sticking>(name);
                     sticking != nullptr && quantity->subscript == Subscript::sticking)
                follow(*sticking);
            return;
        }
        const Named* named = e.kind == Kind::name ? names_.find(e.name) : nullptr;
        if (named != nullptr && named->kind == Named::Kind::definition) follow(named->definition());
        for (const ExpressionPtr& child : e.children) names_in(*child, bound);
    }

    template <class Visit>
    void visit_once(const Item& item, const std::string& sentence, Visit visit) {
        if (const auto at = std::find(path_.begin(), path_.end(), &item); at != path_.end()) {
            std::vector<Note> notes;
            for (auto between = at + 1; between != path_.end(); ++between)
                notes.push_back({(*between)->span, fmt::format("by way of '{}'", (*between)->name)});
            diagnostics_.error(Id::cyclic_definition, item.span, sentence, notes);
            return;
        }
        if (!done_.insert(&item).second) return;
        constexpr std::size_t deepest = 500;
        if (path_.size() >= deepest) {
            diagnostics_.error(Id::too_large, item.span,
                               fmt::format("'{}' depends on a chain of more than {} definitions", item.name, deepest));
            return;
        }
        path_.push_back(&item);
        visit();
        path_.pop_back();
    }

    const Names& names_;
    Diagnostics& diagnostics_;
    std::set<const Item*> done_;
    std::vector<const Item*> path_;
};

void check_definition_cycles(const Model& model, const Names& names, Diagnostics& diagnostics) {
    CycleCheck check(names, diagnostics);
    for (const Definition& definition : model.definitions) check.follow(definition);
    for (const Solid& solid : model.solids) check.follow(solid);
    for (const Load& load : model.loads) check.follow(load);
    for (const Sticking& sticking : model.stickings) check.follow(sticking);
}

}  // namespace

std::optional<NameProblem> problem_of_model_name(const std::string& name) {
    if (auto problem = problem_of_name(name, true)) return problem;
    if (!is_global_function(name)) return std::nullopt;
    return NameProblem{Id::reserved_name,
                       fmt::format("'{}' has a meaning of its own in C or C++ and cannot be the namespace of the header", name)};
}

void check_names(const Model& model, Diagnostics& diagnostics) {
    NameCheck(model, diagnostics).run();
    check_definition_cycles(model, Names(model), diagnostics);
}

void check_letter_names(const Model& letters, Diagnostics& diagnostics) { NameCheck(letters, diagnostics).run_letters(); }

}  // namespace dalembert

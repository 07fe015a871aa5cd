// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "model/checks.hpp"
#include "model/vocabulary.hpp"

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

/// Names, and who defined them first.
class NameCheck {
public:
    NameCheck(const Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    void run() {
        if (well_formed(model_.name, model_.name_span) && is_global_function(model_.name))
            diagnostics_.error(Id::reserved_name, model_.name_span,
                               fmt::format("'{}' has a meaning of its own in C or C++ and cannot be the namespace of the header", model_.name));
        // Names that expressions use share one namespace; a velocity gets the name NAME_dot in C++.
        std::map<std::string, const Item*> used;
        const auto shared = [&](const auto& items) {
            for (const auto& item : items) define(used, item.name, item);
        };
        shared(model_.sizes);
        shared(model_.parameters);
        shared(model_.definitions);
        shared(model_.coordinates);
        shared(model_.inputs);
        shared(model_.states);
        shared(model_.outputs);
        for (const ModeGroup& group : model_.modes) shared(group.modes);
        for (const Coordinate& coordinate : model_.coordinates)
            if (const auto clash = used.find(coordinate.name + "_dot"); clash != used.end())
                diagnostics_.error(Id::doubly_defined, clash->second->span,
                                   fmt::format("'{}' is also the name of the velocity of '{}' in the header", clash->first, coordinate.name),
                                   {{coordinate.span, fmt::format("'{}' is defined here", coordinate.name)}});
        each_separately(model_.bodies);
        each_separately(model_.springs);
        each_separately(model_.dampers);
        each_separately(model_.forces);
        each_separately(model_.torques);
        each_separately(model_.jets);
        each_separately(model_.cuts);
        each_separately(model_.kinetic);
        each_separately(model_.potentials);
        each_separately(model_.generalised_forces);
        std::map<std::string, const Item*> parts;
        const auto part = [&](const auto& items) {
            for (const auto& item : items) {
                if (!well_formed(item.name, item.span)) continue;
                const auto [first, is_new] = parts.emplace(item.name, &item);
                if (!is_new)
                    diagnostics_.error(Id::doubly_defined, item.span, fmt::format("'{}' is defined twice among media, volumes, reservoirs, flows, nodes, links, rods, blocks and enclosures", item.name),
                                       {{first->second->span, fmt::format("'{}' is first defined here", item.name)}});
            }
        };
        part(model_.media);
        part(model_.volumes);
        part(model_.reservoirs);
        part(model_.flows);
        part(model_.nodes);
        part(model_.links);
        part(model_.rods);
        part(model_.blocks);
        part(model_.enclosures);
        distinct(model_.attitudes, "attitudes");
        distinct(model_.modes, "groups of modes");
        distinct(model_.constraints, "constraints");
        distinct(model_.events, "events");
        for (const Event& event : model_.events)
            if (event.name == "event") diagnostics_.error(Id::reserved_name, event.span, "'event' is a name that every header with events defines itself");
        each_separately(model_.effects);
        each_separately(model_.scenes);
        each_separately(model_.runs);
        for (const PrintedEquation& printed : model_.printed)
            if (printed.name.empty() || printed.name.size() > 80)
                diagnostics_.error(Id::bad_name, printed.span, "the name of a printed equation has 1 to 80 characters");
    }

private:
    bool well_formed(const std::string& name, const Span& span) {
        if (!is_identifier(name)) {
            diagnostics_.error(Id::bad_name, span,
                               fmt::format("'{}' is not a name; a name is a letter followed by at most 59 letters, digits and single underscores", name));
            return false;
        }
        const char* what = is_cpp_keyword(name) ? "a word of C++" : is_cpp_macro(name) ? "a macro of C++" : name == "std" ? "the namespace of C++" : nullptr;
        if (what != nullptr) diagnostics_.error(Id::reserved_name, span, fmt::format("'{}' is {} and cannot be a name in the header", name, what));
        return what == nullptr;
    }

    void define(std::map<std::string, const Item*>& used, const std::string& name, const Item& item) {
        if (!well_formed(name, item.span)) return;
        const char* meaning = name == "t"                             ? "the time"
                              : name == "pi"                          ? "the number pi"
                              : name == "stefan_boltzmann"            ? "the constant of radiation"
                              : find_function(name) != nullptr        ? "a function"
                              : find_quantity(name) != nullptr        ? "a derived quantity"
                              : is_special_form(name)                 ? "an operation"
                                                                      : nullptr;
        if (meaning != nullptr) {
            diagnostics_.error(Id::reserved_name, item.span, fmt::format("'{}' is {} in every model and cannot be defined again", name, meaning));
            return;
        }
        if (is_header_name(name)) {
            diagnostics_.error(Id::reserved_name, item.span, fmt::format("'{}' is a name that every header defines itself", name));
            return;
        }
        const auto [first, is_new] = used.emplace(name, &item);
        if (!is_new)
            diagnostics_.error(Id::doubly_defined, item.span, fmt::format("'{}' is defined twice", name),
                               {{first->second->span, fmt::format("'{}' is first defined here", name)}});
    }

    template <class T>
    void each_separately(const std::vector<T>& items) {
        for (const T& item : items) well_formed(item.name, item.span);
    }

    /// Of what elements bring along some may have the name of something that was written.
    template <class T>
    void distinct(const std::vector<T>& items, const char* what) {
        std::map<std::string, const Item*> seen;
        for (const T& item : items) {
            if (!well_formed(item.name, item.span)) continue;
            const auto [first, is_new] = seen.emplace(item.name, &item);
            if (!is_new)
                diagnostics_.error(Id::doubly_defined, item.span, fmt::format("there are two {} '{}'", what, item.name), {{first->second->span, fmt::format("'{}' is first defined here", item.name)}});
        }
    }

    const Model& model_;
    Diagnostics& diagnostics_;
};

/// Reports definitions that need themselves; the others can be followed without end.
void check_definition_cycles(const Model& model, const Names& names, Diagnostics& diagnostics) {
    std::set<const Definition*> done;
    std::vector<const Definition*> path;
    const std::function<void(const Definition&)> follow = [&](const Definition& definition) {
        if (const auto at = std::find(path.begin(), path.end(), &definition); at != path.end()) {
            std::vector<Note> notes;
            for (auto d = at + 1; d != path.end(); ++d) notes.push_back({(*d)->span, fmt::format("by way of '{}'", (*d)->name)});
            diagnostics.error(Id::cyclic_definition, definition.span, fmt::format("the definition of '{}' needs '{}' itself", definition.name, definition.name), notes);
            return;
        }
        if (!done.insert(&definition).second) return;
        constexpr std::size_t deepest = 500;
        if (path.size() >= deepest) {
            diagnostics.error(Id::too_large, definition.span, fmt::format("'{}' stands behind more than {} definitions that need each other", definition.name, deepest));
            return;
        }
        path.push_back(&definition);
        for_each(*definition.value, [&](const Expression& e) {
            const Named* named = e.kind == Kind::name ? names.find(e.name) : nullptr;
            if (named != nullptr && named->kind == Named::Kind::definition) follow(named->definition());
        });
        path.pop_back();
    };
    for (const Definition& definition : model.definitions) follow(definition);
}

}  // namespace

void check_names(const Model& model, Diagnostics& diagnostics) {
    NameCheck(model, diagnostics).run();
    check_definition_cycles(model, Names(model), diagnostics);
}

}  // namespace dalembert

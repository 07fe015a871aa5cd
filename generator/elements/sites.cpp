// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/sites.hpp"

#include <fmt/format.h>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "elements/walk.hpp"

namespace dalembert {

namespace {

/// What is written as a site; `bound` are the names that mean something in all of the item.
void take(const Written& written, std::vector<std::string> bound, const SiteVisitor& visitor) {
    bound.insert(bound.end(), written.bound.begin(), written.bound.end());
    visitor({&written.expression, written.depends, written.what, std::move(bound), written.is_of_sizes, written.key.may_be_absent,
             written.may_shadow});
}

/// The equations may use letters that are written beside them.
void visit_printed(const PrintedEquation& item, std::vector<std::string> bound, const SiteVisitor& visitor) {
    const auto each = [&](const ExpressionPtr& e, const char* part) {
        if (e) visitor({e.get(), on_anything, fmt::format("the {} of {}", part, owner_of(item)), bound});
    };
    for (const PrintedLetter& letter : item.letters) bound.push_back(letter.name);
    if (!item.solved.empty())
        for (const Equation& equation : item.equations) bound.push_back(equation.sides[0]->name);
    for (const PrintedLetter& letter : item.letters) each(letter.value, "letters");
    for (const Equation& equation : item.equations)
        for (const ExpressionPtr& side : equation.sides) each(side, "sides");
    for (const Equation& equation : item.solved)
        for (const ExpressionPtr& side : equation.sides) each(side, "equations to be solved");
    for (const AtPoint& at : item.at) {
        each(at.variable, "point");
        each(at.value, "point");
    }
}

}  // namespace

template <class Described>
void visit(const Described& item, const SiteVisitor& visitor) {
    std::vector<std::string> bound;
    if constexpr (std::derived_from<Described, Item>) {
        if (item.family) {
            for (const ExpressionPtr& end : {item.family->from, item.family->to})
                visitor({end.get(), constant_only, "the members of " + owner_of(item), {}, true});
            bound.push_back(item.family->index);
        }
    }
    if constexpr (std::is_same_v<Described, PrintedEquation>) visit_printed(item, std::move(bound), visitor);
    else walk(item, [&](const Written& written) { take(written, bound, visitor); });
}

#define DALEMBERT_VISIT(section, member, Type) template void visit(const Type& item, const SiteVisitor& visitor);
DALEMBERT_KINDS(DALEMBERT_VISIT)
#undef DALEMBERT_VISIT

void visit(const Model& model, const SiteVisitor& visitor) {
    const auto walk = [&](const auto& item) {
        if constexpr (requires { item.is_made; })
            if (item.is_made) return;
        visit(item, visitor);
    };
    for_each_kind(model, [&](const char*, const auto& items) { for_each_item(items, walk); });
}

}  // namespace dalembert

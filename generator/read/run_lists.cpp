// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/run_lists.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/runs.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

class RunLists {
public:
    RunLists(const Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    void expand(RunEntry& entry) const {
        const Expression& variable = *entry.variable;
        const bool is_rate = variable.kind == Kind::call && variable.name == "dot" && variable.children.size() == 1;
        const Expression& named = is_rate ? *variable.children[0] : variable;
        if (named.kind != Kind::name) return;
        const Item* item = find(named.name);
        const bool is_whole_family = item != nullptr && item->family && named.children.empty();
        if (entry.of_list && item != nullptr && !is_whole_family) {
            if (entry.of_list->place > 0) return;
            diagnostics_.error(Id::wrong_arguments, entry.span,
                               fmt::format("'{}' takes one value; a list is for all members of a family", variable.written()));
        }
        if (!is_whole_family) return;
        const std::size_t place = entry.of_list ? entry.of_list->place : 0;
        if (!entry.of_list) entry.of_list = RunEntry::OfList{0, 0};
        const ExpressionPtr& from = item->family->from;
        auto member = std::make_shared<Expression>(named);
        member->children = {make_binary(Kind::add, from, make_number(Rational(static_cast<long>(place)), named.span))};
        if (!is_rate) {
            entry.variable = member;
            return;
        }
        auto rate = std::make_shared<Expression>(variable);
        rate->children = {member};
        entry.variable = rate;
    }

private:
    const Item* find(const std::string& name) const {
        const Item* found = nullptr;
        const auto look = [&](const auto& items) {
            for (const auto& item : items)
                if (item.name == name) found = &item;
        };
        look(model_.coordinates);
        look(model_.states);
        look(model_.parameters);
        return found;
    }

    const Model& model_;
    Diagnostics& diagnostics_;
};

}  // namespace

void expand_run_lists(Model& model, Diagnostics& diagnostics) {
    const RunLists lists(model, diagnostics);
    for (Run& run : model.runs)
        for (auto* entries : {&run.start, &run.parameters})
            for (RunEntry& entry : *entries) lists.expand(entry);
}

}  // namespace dalembert

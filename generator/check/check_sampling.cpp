// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <map>

#include "check/checks.hpp"
#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

namespace {

/// What a controller may be made of.
template <class T>
constexpr bool is_of_controllers =
    std::is_same_v<T, Size> || std::is_same_v<T, Parameter> || std::is_same_v<T, Definition> || std::is_same_v<T, Input> ||
    std::is_same_v<T, State> || std::is_same_v<T, Output> || std::is_same_v<T, Curve> || std::is_same_v<T, Effect> ||
    std::is_same_v<T, SceneChoice> || std::is_same_v<T, ControllerSampling>;

void check_plain(const Model& model, Diagnostics& diagnostics) {
    for (const State& state : model.states)
        if (state.next)
            diagnostics.error(Id::not_allowed_here, state.next->span,
                              fmt::format("state '{}' has a next value, but the model has no [sampling], which says when that is; "
                                          "states of machines have derivatives",
                                          state.name));
}

}  // namespace

void check_controller_parameters(const Model& model, Diagnostics& diagnostics) {
    if (model.samplers.empty()) return;
    const Names names(model);
    std::map<std::string, const Sampler*> columns;
    for (const Sampler& sampler : model.samplers)
        for (const State& state : sampler.controller->states) {
            const std::string column = sampler.name + "_" + state.name;
            const Named* other = names.find(column);
            const auto [known, is_new] = columns.emplace(column, &sampler);
            if (other == nullptr && is_new) continue;
            diagnostics.error(Id::doubly_defined, sampler.span,
                              fmt::format("state '{}' of the controller of sampler '{}' is '{}' in results, as something else is",
                                          state.name, sampler.name, column),
                              {{other != nullptr ? other->item->span : known->second->span, "that is defined here"}});
        }
    for (const Sampler& sampler : model.samplers)
        for (const RunEntry& entry : sampler.of_machine)
            if ((dependence(*entry.value, names) & ~on_parameters) != 0)
                diagnostics.error(Id::not_allowed_here, entry.value->span,
                                  fmt::format("parameter '{}' of the controller of sampler '{}' is constant in a run, but '{}' is not; "
                                              "what changes is measured",
                                              entry.variable->name, sampler.name, entry.value->written()));
}

void check_sampling(const Model& model, Diagnostics& diagnostics) {
    if (!model.sampling) return check_plain(model, diagnostics);
    const Note samples{model.sampling->span, "it samples because of this section"};
    for_each_kind(model, [&]<class Items>(const char* section, const Items& items) {
        bool is_told = false;
        for_each_item(items, [&]<class T>(const T& item) {
            if (is_of_controllers<T> || is_told) return;
            is_told = true;
            diagnostics.error(Id::not_allowed_here, item.span,
                              fmt::format("a controller that samples has parameters, definitions, curves, inputs, states and outputs, "
                                          "and no [{}]",
                                          section),
                              {samples});
        });
    });
    for (const State& state : model.states) {
        if (!state.next)
            diagnostics.error(state.derivative ? Id::not_allowed_here : Id::missing_key, state.span,
                              fmt::format("state '{}' of a controller that samples needs its `next` value{}", state.name,
                                          state.derivative ? ", and has no derivative" : ""),
                              {samples});
        if (state.root)
            diagnostics.error(Id::not_allowed_here, state.span,
                              fmt::format("state '{}' cannot be integrated as its root: a controller that samples integrates nothing",
                                          state.name),
                              {samples});
    }
    for (const Input& input : model.inputs)
        if (input.family)
            diagnostics.error(Id::not_allowed_here, input.span,
                              fmt::format("input '{}' is a family; a controller that samples measures single values", input.name),
                              {samples});
    visit(model, [&](const Site& site) {
        for_each(*site.expression, [&](const Expression& e) {
            if (e.kind == Expression::Kind::name && e.name == "t" && e.children.empty())
                diagnostics.error(Id::not_allowed_here, e.span,
                                  fmt::format("{} depends on the time, which a controller that samples does not know; count samples "
                                              "in a state, or measure the time as an input",
                                              site.what),
                                  {samples});
        });
    });
}

}  // namespace dalembert

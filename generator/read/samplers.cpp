// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/samplers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// The item of a list that an entry names; null, with an error, if there is none.
template <class Items>
auto* named(Items& items, const RunEntry& entry, const Sampler& sampler, const char* word, Diagnostics& diagnostics) {
    const auto found = std::find_if(items.begin(), items.end(),
                                    [&](const auto& item) { return entry.variable->is_name() && item.name == entry.variable->name; });
    if (found != items.end()) return &*found;
    std::vector<std::string> known;
    for (const auto& item : items) known.push_back(item.name);
    diagnostics.error(Id::unknown_name, entry.span,
                      fmt::format("the controller of sampler '{}' has no {} '{}'{}", sampler.name, word, entry.variable->written(),
                                  did_you_mean(entry.variable->written(), known)),
                      {{sampler.file_span, "its file is named here"}});
    return static_cast<decltype(&*found)>(nullptr);
}

class SamplerCheck {
public:
    SamplerCheck(Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    void run() {
        for (const Sampler& sampler : model_.samplers) {
            measures(sampler);
            sets(sampler);
            parameters(sampler);
        }
    }

private:
    void measures(const Sampler& sampler) {
        std::vector<std::string> measured;
        for (const RunEntry& entry : sampler.measures) {
            const Input* input = named(sampler.controller->inputs, entry, sampler, "input", diagnostics_);
            if (input == nullptr) continue;
            measured.push_back(input->name);
            Output output;
            output.name = sampler.name + "_" + input->name;
            output.span = entry.span;
            output.doc = fmt::format("measured by sampler '{}'", sampler.name);
            output.when = sampler.when;
            output.value = entry.value;
            output.unit = input->unit;
            model_.outputs.push_back(std::move(output));
        }
        for (const Input& input : sampler.controller->inputs)
            if (std::find(measured.begin(), measured.end(), input.name) == measured.end())
                diagnostics_.error(Id::missing_key, sampler.span,
                                   fmt::format("sampler '{}' does not say what '{}' of its controller is; add it to measures", sampler.name,
                                               input.name),
                                   {{input.span, "the input is declared here"}});
    }

    void parameters(const Sampler& sampler) {
        for (const RunEntry& entry : sampler.of_machine) {
            const auto& list = sampler.controller->parameters;
            const auto parameter =
                std::find_if(list.begin(), list.end(), [&](const Parameter& one) { return one.name == entry.variable->name; });
            Definition definition;
            definition.name = sampler.name + "_" + parameter->name;
            definition.span = entry.span;
            definition.doc = parameter->doc;
            definition.value = entry.value;
            definition.unit = parameter->unit;
            model_.definitions.push_back(std::move(definition));
        }
    }

    void sets(const Sampler& sampler) {
        for (const RunEntry& entry : sampler.sets) {
            const Output* output = named(sampler.controller->outputs, entry, sampler, "output", diagnostics_);
            if (output == nullptr) continue;
            const auto input = std::find_if(model_.inputs.begin(), model_.inputs.end(), [&](const Input& one) {
                return entry.value->is_name() && one.name == entry.value->name;
            });
            if (input == model_.inputs.end()) {
                std::vector<std::string> known;
                for (const Input& one : model_.inputs) known.push_back(one.name);
                diagnostics_.error(Id::unknown_name, entry.value->span,
                                   fmt::format("sampler '{}' sets '{}', which is no input of this model{}", sampler.name,
                                               entry.value->written(), did_you_mean(entry.value->written(), known)));
                continue;
            }
            if (input->family)
                diagnostics_.error(Id::not_indexed, entry.value->span,
                                   fmt::format("sampler '{}' sets '{}', which is a family; samplers set single inputs", sampler.name,
                                               input->name),
                                   {{input->span, "the input is declared here"}});
            if (!output->unit)
                diagnostics_.error(Id::missing_key, entry.span,
                                   fmt::format("output '{}' of the controller of sampler '{}' needs a unit, since it sets an input",
                                               output->name, sampler.name),
                                   {{output->span, "the output is declared here"}});
            else if (output->unit->dimension != input->unit.dimension)
                diagnostics_.error(Id::unit_mismatch, entry.value->span,
                                   fmt::format("sampler '{}' sets '{}', which counts in {}, to '{}', which counts in {}", sampler.name,
                                               input->name, input->unit.written, output->name, output->unit->written),
                                   {{input->span, "the input is declared here"}, {output->span, "the output is declared here"}});
            once(sampler, *input, entry);
        }
    }

    /// Samplers that effects choose may set the same input; whether a scene has two of them is checked there.
    void once(const Sampler& sampler, const Input& input, const RunEntry& entry) {
        for (const auto& [known, by, span] : set_)
            if (known == input.name && (by == &sampler || (!by->when && !sampler.when)))
                diagnostics_.error(Id::doubly_defined, entry.span,
                                   fmt::format("input '{}' is set twice, by {}", input.name,
                                               by == &sampler ? fmt::format("sampler '{}'", by->name)
                                                              : fmt::format("samplers '{}' and '{}'", by->name, sampler.name)),
                                   {{span, "it is also set here"}});
        set_.push_back({input.name, &sampler, entry.span});
    }

    struct Set {
        std::string input;
        const Sampler* by;
        Span span;
    };

    Model& model_;
    Diagnostics& diagnostics_;
    std::vector<Set> set_;
};

}  // namespace

void set_controller(Model& controller, Sampler& sampler, const std::string& machine, Diagnostics& diagnostics) {
    if (!controller.sampling)
        throw Failure(Diagnostic{Id::not_allowed_here, sampler.file_span,
                                 fmt::format("sampler '{}' takes '{}', which is no controller: it has no [sampling]", sampler.name,
                                             controller.name),
                                 {{controller.name_span, "it is named here"}}});
    if (const auto problem = problem_of_model_name(sampler.name)) throw Failure(Diagnostic{problem->id, sampler.span, problem->sentence});
    controller.name = machine + "_" + sampler.name;
    if (problem_of_model_name(controller.name)) controller.name = sampler.name;  // too long together
    for (const RunEntry& entry : sampler.parameters) {
        Parameter* parameter = named(controller.parameters, entry, sampler, "parameter", diagnostics);
        if (parameter == nullptr) continue;
        if (has_names(*entry.value)) sampler.of_machine.push_back(entry);
        else parameter->values = {is_plain_number(*entry.value) ? to_si(entry.value, parameter->unit) : entry.value};
    }
}

void expand_samplers(Model& model, Diagnostics& diagnostics) { SamplerCheck(model, diagnostics).run(); }

}  // namespace dalembert

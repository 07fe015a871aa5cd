// SPDX-License-Identifier: GPL-3.0-or-later
// Controllers that sample, as they were written: a model file that is one, and its place in a machine.
#pragma once

#include <memory>

#include "elements/key.hpp"

namespace dalembert {

struct Model;

/// Makes a model a controller: at each sample it computes outputs and next states from its inputs, and in between they stay.
struct ControllerSampling {
    enum class Numbers { doubles, floats };
    ExpressionPtr every;
    ExpressionPtr offset;  ///< null: 0
    ExpressionPtr delay;   ///< null: 0
    Numbers numbers = Numbers::doubles;
    Span span;
};

template <>
inline constexpr KindSpec kind_of<ControllerSampling>{"the sampling",
    "Makes the model a controller, which samples: its states have `next`, its inputs are what it measures, and its outputs stay "
    "as they are until the next sample. [samplers] of a machine uses it. Its header has the function `sample`.",
    "[sampling]\nevery = \"T_s\"\ndelay = \"0.2*T_s\""};

inline const KeyChoices<ControllerSampling::Numbers>& numbers_of_controllers() {
    using N = ControllerSampling::Numbers;
    static const KeyChoices<N> choices{{"double", N::doubles}, {"float", N::floats}};
    return choices;
}

template <class Visitor, ElementOf<ControllerSampling> E>
void describe(Visitor& v, E& sampling) {
    const Unit second{Dimension::time(), 1, 0, 0, "s"};
    v("every", sampling.every, {.required = true, .unit = second, .depends = constant_only, .sign = above_zero("s"), .words = "period",
        .doc = "time from one sample to the next; an expression of parameters is allowed"});
    v("offset", sampling.offset, {.unit = second, .depends = constant_only, .sign = not_below_zero("s"),
        .doc = "time of the first sample; 0 if left out. Before it, outputs are what they would be at the start"});
    v("delay", sampling.delay, {.unit = second, .depends = constant_only, .sign = not_below_zero("s"),
        .doc = "time from a sample until its outputs take effect, at most one period; 0 if left out"});
    v.choice("numbers", sampling.numbers, {.doc = "in which `simulate` computes the controller, as the device does that it runs on; "
        "double if left out"}, numbers_of_controllers());
    v.item({.has_doc = false, .has_when = false});
}

/// A controller in a machine.
struct Sampler : Item {
    std::string file;
    Span file_span;
    std::vector<RunEntry> parameters, measures, sets;  ///< NAME of the controller = value here
    std::shared_ptr<const Model> controller;           ///< with those parameters that are numbers
    std::vector<RunEntry> of_machine;                  ///< of the parameters those that are made of parameters of this model
};

template <>
inline constexpr KindSpec kind_of<Sampler>{"sampler",
    "Controllers that sample: each takes its measurements at its samples, and sets inputs of this model, which stay until its "
    "next sample. Samplers whose samples fall together take them in the order of declaration, and each sees what those before it set.",
    "[samplers.speed]\nfile       = \"pi_controller.toml\"\nparameters = { K_p = \"0.5 V*s\" }\n"
    "measures   = { w = \"dot(phi)\", r = \"w_wanted\" }\nsets       = { u = \"u_a\" }",
    "file"};

template <class Visitor, ElementOf<Sampler> E>
void describe(Visitor& v, E& sampler) {
    constexpr ValueType by_name = ValueType::expressions_by_name;
    v("file", sampler.file, {.required = true, .doc = "the model file of the controller, with [sampling], beside this file or with a path "
        "from there"});
    v.by_hand("parameters", {.type = by_name,
        .doc = "values of parameters of the controller: numbers, which count in the declared unit, or expressions of parameters of this "
               "model"});
    v.by_hand("measures", {.required = true, .type = by_name,
        .doc = "{ NAME = expression }: what each input of the controller is here. It becomes the output `SAMPLER_NAME` of this model"});
    v.by_hand("sets", {.required = true, .type = by_name, .doc = "{ NAME = input }: the input of this model that an output of the "
        "controller sets"});
    v.item({});
}

}  // namespace dalembert

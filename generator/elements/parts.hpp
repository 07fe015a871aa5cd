// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as they were written: other files that a model uses, and the ports by which a file can be joined to others.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// Another file, whose elements become those of the model, each with the name of the part before its own.
struct Use : Item {
    std::string file;
    Span file_span;
    std::vector<RunEntry> parameters, sizes, start, ports, media, effects;  ///< NAME of the part = value here
    std::vector<std::string> joins;                                         ///< what became of each port that is joined, for people
};

template <>
inline constexpr KindSpec kind_of<Use>{"part",
    "Parts: other model files, whose elements belong to this model. `left.p_1` is the name here of `p_1` of the part `left`; "
    "in headers and results it is `left_p_1`. Printed equations, runs, measurements and scenes of a part count only where it stands "
    "alone. In each section, the elements of parts come first, in the order of [use].",
    "[use.left]\nfile       = \"cylinder.toml\"\nparameters = { A = \"12 cm^2\" }\nmedia      = { oil = \"oil\" }\n"
    "ports      = { rod = \"x\", a = \"right.b\" }",
    "file"};

template <class Visitor, ElementOf<Use> E>
void describe(Visitor& v, E& use) {
    constexpr ValueType by_name = ValueType::expressions_by_name;
    v("file", use.file, {.required = true, .doc = "the model file of the part, beside this file or with a path from there"});
    v.by_hand("parameters", {.type = by_name,
        .doc = "values of parameters of the part. A number without a unit counts in the declared unit; an expression of names of this "
               "model replaces the parameter"});
    v.by_hand("sizes", {.type = by_name, .doc = "sizes of the part: whole numbers, or expressions of sizes of this model"});
    v.by_hand("start", {.type = by_name, .doc = "start values of coordinates, their rates and states of the part"});
    v.by_hand("ports", {.type = by_name,
        .doc = "joins of ports of the part: `NAME.PORT` of another part, a coordinate or an expression (shaft, flange, signal), a volume, "
               "reservoir or junction (fluid), a node, volume, reservoir or cell (thermal), a body (point), or a pin of this model"});
    v.by_hand("media", {.type = by_name, .doc = "media of the part that are media of this model: { oil = \"oil\" }"});
    v.by_hand("effects", {.type = by_name,
        .doc = "effects of the part that are effects of this model; of one that is left out, `NAME.EFFECT` is an effect of this model"});
    v.item({.has_when = false});
}

/// A place at which a file can be joined to others.
struct Port : Item {
    enum class Kind { shaft, flange, fluid, thermal, point, pin, signal };
    Kind kind = Kind::signal;
    std::optional<Reference> coordinate;
    ExpressionPtr value;
    std::optional<Reference> at;
    std::optional<Reference> input;
    NamesWithPlaces alone;  ///< names of elements that a join of this port takes out of the model: a load, say
};

template <>
inline constexpr KindSpec kind_of<Port>{"port",
    "Ports by which a file that uses this one as a part can join it to others. A file with ports also stands alone.",
    "[ports.rod]\nkind       = \"flange\"\ncoordinate = \"s\"\nalone      = [\"load\", \"f_load\"]", ""};

inline const KeyChoices<Port::Kind>& port_kinds() {
    using K = Port::Kind;
    static const KeyChoices<K> choices{
        {"shaft", K::shaft, {}, {"coordinate", "value"}, ": an angle"},
        {"flange", K::flange, {}, {"coordinate", "value"}, ": a position along a line"},
        {"fluid", K::fluid, {"at"}, {}, ": a volume, reservoir or junction"},
        {"thermal", K::thermal, {"at"}, {}, ": a node"},
        {"point", K::point, {"at"}, {}, ": a body, on which others are placed"},
        {"pin", K::pin, {"at"}, {}, ": a pin of a circuit"},
        {"signal", K::signal, {}, {"input", "value"}, ": an input, or a value for inputs of others"},
    };
    return choices;
}

/// What a port of a kind may stand at; where `is_other`, what it may be joined to.
inline std::vector<const char*> elements_at(Port::Kind kind, bool is_other = false) {
    switch (kind) {
        case Port::Kind::fluid: return {"volume", "reservoir", "junction"};
        case Port::Kind::thermal:
            return is_other ? std::vector<const char*>{"node", "volume", "reservoir", "rod", "block"} : std::vector<const char*>{"node"};
        case Port::Kind::point: return {"body"};
        case Port::Kind::pin: return {"pin"};
        default: return {"volume", "reservoir", "junction", "node", "body", "pin"};
    }
}

template <class Visitor, ElementOf<Port> E>
void describe(Visitor& v, E& port) {
    using K = Port::Kind;
    v.choice("kind", port.kind, {.required = true}, port_kinds());
    v("coordinate", port.coordinate, {.type = ValueType::coordinate, .refers = {"coordinate"},
        .excludes = {{"value", "has a coordinate and a value; give one of them"}},
        .doc = "of a shaft or flange: the coordinate that is its angle or position"});
    v("input", port.input, {.refers = {"input"}, .excludes = {{"value", "has an input and a value; give one of them"}},
        .doc = "of a signal: the input that a join gives its value"});
    v("value", port.value,
      {.dimension = port.kind == K::shaft    ? std::optional(Dimension::none())
                    : port.kind == K::flange ? std::optional(Dimension::length())
                                             : std::nullopt,
       .depends = on_state_and_inputs | on_places,
       .doc = "of a shaft or flange, instead of a coordinate: its angle or position as an expression; of a signal: what it gives"});
    v("at", port.at, {.refers = elements_at(port.kind),
        .doc = "of a fluid port, thermal port, point or pin: the element that stands there. A reservoir, a node that is held at a "
               "temperature, a body without mass or a pin, `ground` too, is replaced by what the port is joined to"});
    v("alone", port.alone, {
        .doc = "names of elements, parameters or inputs that are there only while the port is not joined, such as a load"});
    v.item({.has_when = false});
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// How pages draw a machine, as it was written, each key in one place. Nothing of it changes the machine.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

struct ViewPart : Item {
    enum class Shape { usual, disc, wheel, box };
    Shape shape = Shape::usual;
    ExpressionPtr radius;
    ExpressionPtr width;
    ExpressionPtr height;
    std::string colour;  ///< a word; empty: the page chooses
    bool hidden = false;
};

template <>
inline constexpr KindSpec kind_of<ViewPart>{"the view of", "", ""};

inline const KeyChoices<ViewPart::Shape>& view_shapes() {
    using S = ViewPart::Shape;
    static const KeyChoices<S> choices{
        {"disc", S::disc, {"radius"}},
        {"wheel", S::wheel, {"radius"}, {}, ", whose spokes turn with the body"},
        {"box", S::box, {"width", "height"}, {}, ", which turns with the body"},
        {"", S::usual},
    };
    return choices;
}

/// Pages have a tone of each for light and for dark paper.
inline const KeyChoices<std::string>& view_colours() {
    static const KeyChoices<std::string> choices{{"", ""},           {"blue", "blue"}, {"orange", "orange"}, {"green", "green"},
                                                 {"purple", "purple"}, {"yellow", "yellow"}, {"grey", "grey"},     {"red", "red"},
                                                 {"brown", "brown"}};
    return choices;
}

template <class Visitor, ElementOf<ViewPart> E>
void describe(Visitor& v, E& part) {
    v.choice("shape", part.shape, {.doc = "of a body: what is drawn to scale at its position; a small disc of no certain size if left out"},
             view_shapes());
    v("radius", part.radius, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "of a disc or wheel: radius"});
    v("width", part.width, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "of a box: length along the x axis of the body"});
    v("height", part.height, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "of a box: length along the y axis of the body"});
    v.choice("colour", part.colour, {.doc = "of a body"}, view_colours());
    v("hidden", part.hidden, {.doc = "true: it is not drawn"});
}

/// What a part of a view may refine.
inline const std::vector<const char*>& viewed_kinds() {
    static const std::vector<const char*> kinds{"body", "spring", "damper", "volume", "junction", "reservoir", "flow",
                                                "node", "link",   "rod",    "block",  "enclosure", "pin",      "branch"};
    return kinds;
}

struct View {
    ExpressionPtr ground;
    ExpressionPtr turn;
    ExpressionPtr tilt;
    std::optional<bool> trails;
    std::vector<ViewPart> parts;
    Span span;
};

template <>
inline constexpr KindSpec kind_of<View>{"the view",
    "How the pages of `report` draw the machine; without it they draw what follows from the model. Nothing here changes the machine.",
    "[view]\nground     = \"-r\"\nparts.cart = { shape = \"box\", width = \"0.3 m\", height = \"0.15 m\", colour = \"blue\" }"};

template <class Visitor, ElementOf<View> E>
void describe(Visitor& v, E& view) {
    v.named("parts", view.parts,
            {.doc = "{ NAME = { KEY = ... } }: bodies and what else is drawn, by their names; of a family all members"});
    v("ground", view.ground, {.dimension = Dimension::length(), .depends = constant_only, .words = "height of the ground",
        .doc = "height of the ground, which is drawn as a line; in space as a grid at this z"});
    v("turn", view.turn, {.dimension = Dimension::none(), .depends = constant_only, .words = "turn of the camera",
        .doc = "in space: angle about the z axis by which the camera is turned from a look along y; -0.6 if left out"});
    v("tilt", view.tilt, {.dimension = Dimension::none(), .depends = constant_only, .words = "tilt of the camera",
        .doc = "in space: angle by which the camera looks down; 0.45 if left out"});
    v("trails", view.trails, {.doc = "false: bodies leave no trails"});
    v.item({.has_doc = false, .has_when = false});
}

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/solid_shape.hpp"

#include "elements/statics.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::realsymbol;

namespace {

/// Letters whose names no model can have, for what a solid says of itself.
class ShapeLetters {
public:
    ShapeLetters(SolidShape& shape, const Translator& translate) : shape_(shape), translate_(translate) {}

    /// A letter for a length; a number stands for itself, and what is left out is zero.
    ex operator()(const ExpressionPtr& length, const char* name) {
        if (!length) return 0;
        const ex value = translate_(length, {});
        if (GiNaC::is_exactly_a<GiNaC::numeric>(value)) return value;
        for (const auto& [letter, known] : shape_.lengths)
            if (known.is_equal(value)) return letter;
        const GiNaC::possymbol letter(std::string("solid.") + name);
        shape_.lengths[letter] = value;
        return letter;
    }
    static realsymbol variable(const char* name) { return realsymbol(std::string("solid.at.") + name); }

private:
    SolidShape& shape_;
    const Translator& translate_;
};

void box(SolidShape& shape, ShapeLetters& length, const Solid& solid) {
    static constexpr const char* sides[]{"a", "b", "c"};
    static constexpr const char* axes[]{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
        const ex side = length((*solid.size)[i], sides[i]);
        const realsymbol x = ShapeLetters::variable(axes[i]);
        shape.place[i] = x;
        shape.integrals.push_back({x, -side / 2, side / 2});
    }
    shape.volume_element = 1;
}

/// From the inner radius to the outer one, which may depend on z, around, and along z.
void round_about_axis(SolidShape& shape, const ex& inner, const ex& outer, const realsymbol& z, const ex& from, const ex& to) {
    const realsymbol r = ShapeLetters::variable("r"), phi = ShapeLetters::variable("phi");
    shape.place = {r * GiNaC::cos(phi), r * GiNaC::sin(phi), z};
    shape.volume_element = r;
    shape.integrals = {{r, inner, outer}, {phi, 0, 2 * GiNaC::Pi}, {z, from, to}};
}

void ball(SolidShape& shape, const ex& inner, const ex& outer, const ex& lowest) {
    const realsymbol r = ShapeLetters::variable("r"), theta = ShapeLetters::variable("theta"), phi = ShapeLetters::variable("phi");
    shape.place = {r * GiNaC::sin(theta) * GiNaC::cos(phi), r * GiNaC::sin(theta) * GiNaC::sin(phi), r * GiNaC::cos(theta)};
    shape.volume_element = GiNaC::pow(r, 2) * GiNaC::sin(theta);
    shape.integrals = {{r, inner, outer}, {theta, 0, lowest}, {phi, 0, 2 * GiNaC::Pi}};
}

}  // namespace

SolidShape shape_of(const Solid& solid, const Translator& translate) {
    SolidShape shape;
    ShapeLetters length(shape, translate);
    const realsymbol z = ShapeLetters::variable("z");
    switch (solid.shape) {
        case Solid::Shape::box: box(shape, length, solid); break;
        case Solid::Shape::cylinder: {
            const ex h = length(solid.height, "h");
            round_about_axis(shape, length(solid.inner_radius, "r"), length(solid.radius, "R"), z, -h / 2, h / 2);
            break;
        }
        case Solid::Shape::cone: {
            const ex h = length(solid.height, "h"), base = length(solid.radius, "R"), top = length(solid.top_radius, "r");
            round_about_axis(shape, 0, base + (top - base) * z / h, z, 0, h);
            break;
        }
        case Solid::Shape::sphere: ball(shape, length(solid.inner_radius, "r"), length(solid.radius, "R"), GiNaC::Pi); break;
        case Solid::Shape::hemisphere: ball(shape, 0, length(solid.radius, "R"), GiNaC::Pi / 2); break;
        case Solid::Shape::point:
        case Solid::Shape::composed: break;
    }
    return shape;
}

}  // namespace dalembert

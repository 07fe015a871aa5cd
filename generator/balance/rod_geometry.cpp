// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/rod_geometry.hpp"

#include "elements/conduction.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::pow;

namespace {

bool is_held(const std::optional<Boundary>& end) { return end && end->temperature; }

ex number(std::size_t n) { return numeric(static_cast<unsigned long>(n)); }

ex middle(const ex& a, const ex& b) { return ((a + b) / 2).expand(); }

/// The area that a bar of the same conductance has throughout, (b - a)/integral(dx/A): exact where A is linear (the logarithmic mean) or
/// the square of something linear (the product of its values at both ends); of other laws, and of tips through which nothing could flow, by
/// the area half way.
template <class Area>
ex mean_area(const Area& area, const ex& from, const ex& to, const ex& length) {
    const GiNaC::symbol x("x");
    const ex law = area(x).expand();
    if (!law.has(x)) return area(from);
    if (area(0).expand().is_zero() || area(length).expand().is_zero()) return area(middle(from, to));
    if (law.is_polynomial(x) && law.degree(x) == 1) return log_mean(area(from), area(to));
    if (law.is_polynomial(x) && law.degree(x) == 2) {
        const ex c = law.coeff(x, 2), b = law.coeff(x, 1), a = law.coeff(x, 0);
        if ((b * b - 4 * a * c).expand().is_zero()) return whole((c * from * to + b * (from + to) / 2 + a).expand());
    }
    return area(middle(from, to));
}

}  // namespace

RodGeometry::RodGeometry(const Rod& rod, const Translator& translate, std::size_t cells)
    : rod_(rod), translate_(translate), cells_(cells), skipped_(has_points() && is_held(rod.first) ? 1 : 0),
      intervals_(has_points() ? cells - 1 + skipped_ + (is_held(rod.last) ? 1 : 0) : cells) {}

GridPlace RodGeometry::place(std::size_t k) const {
    if (!has_points()) return {number(k), number(k) + numeric(1, 2), number(k + 1)};
    const std::size_t here = k + skipped_;
    return {number(here == 0 ? 0 : here - 1), number(here), number(std::min(here + 1, intervals_))};
}

ex RodGeometry::extent() const {
    return rod_.shape == Rod::Shape::bar ? value(rod_.length) : (value(rod_.outer) - value(rod_.inner)).expand();
}

ex RodGeometry::position(const ex& j) const {
    const ex s = j / number(intervals_);
    const ex part = rod_.grid ? translate_(*rod_.grid->body, {}, {{rod_.grid->variable, s}}) : s;
    const ex begin = rod_.shape == Rod::Shape::bar ? ex(0) : value(rod_.inner);
    return (begin + extent() * part).expand();
}

/// On a uniform grid without a difference of two positions, which would lose digits.
ex RodGeometry::distance(const ex& from, const ex& to) const {
    if (rod_.grid) return whole((position(to) - position(from)).expand());
    return extent() * whole(to - from) / number(intervals_);
}

ex RodGeometry::centre(const GridPlace& p) const { return has_points() ? position(p.here) : middle(position(p.left), position(p.right)); }

ex RodGeometry::width(const GridPlace& p) const { return distance(p.left, p.right) / (has_points() ? 2 : 1); }

ex RodGeometry::area(const ex& x) const {
    switch (rod_.shape) {
        case Rod::Shape::bar:
            return rod_.area->variables.empty() ? value(rod_.area->body) : translate_(*rod_.area->body, {}, {{rod_.area->variables[0], x}});
        case Rod::Shape::cylinder: return 2 * GiNaC::Pi * value(rod_.height) * x;
        case Rod::Shape::sphere: break;
    }
    return 4 * GiNaC::Pi * pow(x, 2);
}

ex RodGeometry::volume(const GridPlace& p) const {
    const ex from = has_points() ? middle(position(p.left), position(p.here)) : position(p.left);
    const ex to = has_points() ? middle(position(p.here), position(p.right)) : position(p.right);
    switch (rod_.shape) {
        case Rod::Shape::bar: return area(middle(from, to)) * width(p);
        case Rod::Shape::cylinder: return GiNaC::Pi * value(rod_.height) * width(p) * (to + from).expand();
        case Rod::Shape::sphere: break;
    }
    return 4 * GiNaC::Pi / 3 * width(p) * (pow(to, 2) + to * from + pow(from, 2)).expand();
}

ex RodGeometry::shape_factor(const ex& from, const ex& to, const ex& distance) const {
    if (rod_.shape == Rod::Shape::bar) return mean_area([this](const ex& x) { return area(x); }, from, to, extent()) / distance;
    if (from.is_zero()) return area(middle(from, to)) / distance;
    if (rod_.shape == Rod::Shape::cylinder) return 2 * GiNaC::Pi * value(rod_.height) / log_ratio(to, from);
    return 4 * GiNaC::Pi * from * to / distance;
}

ex RodGeometry::shape_factor(const GridPlace& a, const GridPlace& b) const {
    const ex apart = has_points() ? distance(a.here, b.here) : distance(a.left, b.right) / 2;
    return shape_factor(centre(a), centre(b), apart);
}

ex RodGeometry::end_factor(const GridPlace& nearest, bool is_first) const {
    const ex end = is_first ? ex(0) : number(intervals_);
    const ex inner = has_points() ? nearest.here : ex(0);
    const ex apart = has_points() ? (is_first ? distance(end, inner) : distance(inner, end)) : width(nearest) / 2;
    return is_first ? shape_factor(position(end), centre(nearest), apart) : shape_factor(centre(nearest), position(end), apart);
}

ex RodGeometry::end_area(bool is_first) const { return area(position(is_first ? ex(0) : number(intervals_))); }

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Where the cells of a rod lie, as functions of numbers on its grid: 0 at the first end, n at the last (4.94). The numbers may be
// letters, so that one formula serves all cells.
#pragma once

#include "elements/conduction.hpp"
#include "symbolic/translate.hpp"

namespace dalembert {

/// The place of a cell on the grid. Of points: its neighbours and itself, an end without a neighbour being its own. Of cells: its two
/// faces, and what lies between them.
struct GridPlace {
    GiNaC::ex left, here, right;
};

class RodGeometry {
public:
    /// `cells`: how many states there are.
    RodGeometry(const Rod& rod, const Translator& translate, std::size_t cells);

    std::size_t cells() const { return cells_; }
    /// n: points on held ends are on the grid, but are no states.
    std::size_t intervals() const { return intervals_; }
    /// The number of the first point that is a state.
    std::size_t skipped() const { return skipped_; }
    bool has_points() const { return rod_.scheme == Rod::Scheme::points; }
    GridPlace place(std::size_t k) const;

    /// Along the rod or its radius, m.
    GiNaC::ex position(const GiNaC::ex& number) const;
    GiNaC::ex centre(const GridPlace& place) const;
    /// Of a cell, m^3.
    GiNaC::ex volume(const GridPlace& place) const;
    /// Length of a cell, m.
    GiNaC::ex width(const GridPlace& place) const;
    /// Heat flow over the integral of the conductivity, between centres of neighbouring cells; m. Exact for steady heat flow (4.68), but
    /// from the centre of a solid cylinder or sphere, and in bars whose area is not linear nor a linear one squared: by the area half way
    /// there.
    GiNaC::ex shape_factor(const GridPlace& a, const GridPlace& b) const;
    /// The same between an end and the centre of the cell next to it.
    GiNaC::ex end_factor(const GridPlace& nearest, bool is_first) const;
    /// Across the flow of heat at an end, m^2.
    GiNaC::ex end_area(bool is_first) const;

private:
    GiNaC::ex value(const ExpressionPtr& e) const { return translate_(e, {}); }
    GiNaC::ex area(const GiNaC::ex& x) const;
    GiNaC::ex extent() const;
    GiNaC::ex distance(const GiNaC::ex& from, const GiNaC::ex& to) const;
    GiNaC::ex shape_factor(const GiNaC::ex& from, const GiNaC::ex& to, const GiNaC::ex& distance) const;

    const Rod& rod_;
    const Translator& translate_;
    std::size_t cells_;
    std::size_t skipped_;
    std::size_t intervals_;
};

}  // namespace dalembert

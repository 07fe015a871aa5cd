// SPDX-License-Identifier: GPL-3.0-or-later
// Which rods and blocks of a scene are computed in loops, and which of their cells something else asks for.
#pragma once

#include "scene/scene.hpp"

namespace dalembert {

/// The family of cells in loops that a sum adds up: its term has T[k], k being the index of the sum, and asks with k for nothing else.
/// Null for other sums.
const Field* summed_cells(const Expression& sum, const Scene& scene);

class FieldChoice {
public:
    explicit FieldChoice(Scene& scene) : scene_(scene) {}

    /// Those that say so, or that have too many cells to be written out.
    void find_all(const Names& names);
    /// By the name of the rod or block, or of its states; null where it is written out.
    Field* find(const std::string& name);

    /// A cell that an expression asks for by its number is a state of its own. Throws Failure (too-large: all of them;
    /// index-out-of-range).
    void tap(const Expression& name);
    /// The same in an output, where loops add up cells, and the rate of a cell is known where its neighbours are states too.
    void tap_output(const Expression& output);
    /// Cells at the ends of links and in enclosures.
    void tap_ends();
    /// "T[5]" in a plot; a whole family is plotted by those of its cells that are there.
    void tap_plotted(const std::string& name);

private:
    void tap_neighbours(const Expression& rate);
    void tap(Field& field, const Expression& index, const Indices& indices);
    void tap(const Reference& reference, const Indices& indices);

    Scene& scene_;
};

}  // namespace dalembert

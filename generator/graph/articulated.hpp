// SPDX-License-Identifier: GPL-3.0-or-later
// Accelerations of a chain of bodies without a mass matrix: from the ends inwards each link is replaced by the moment and force with which
// it answers an acceleration of its base, and then the accelerations follow outwards.
//
// note [articulated]: What link b needs is f = inertia*a + force + sum of transfer_c'*f_c over the links c on it, and along each of its
// directions f does what the rest of the forces do: directions'*f = rest. By induction f = I*a + p with a the acceleration that its base
// passes on, changed by those of its own coordinates: the last coordinate is eliminated first, with U = I*s, D = s'*U and
//     qdd = (rest - s'*p - U'*a)/D,    I - U*U'/D and p + U*(rest - s'*p)/D in place of I and p
// and what is left goes to the base as transfer'*I*transfer and transfer'*(p + I*remainder). D > 0 where M is positive definite: these are
// the pivots of M, factored from the ends.
#pragma once

#include <functional>

#include "graph/factorisation.hpp"

namespace dalembert {

using SixNodes = std::array<NodeId, 6>;
using SixBySix = std::array<SixNodes, 6>;  ///< rows

/// ChainLink, in a program.
struct LinkNodes {
    std::optional<std::size_t> base;
    std::vector<std::size_t> coordinates;
    SixBySix transfer, inertia;
    std::vector<SixNodes> directions;
};

/// A coordinate that is eliminated: U, U/D and 1/D.
struct EliminatedCoordinate {
    SixNodes image, scaled;
    NodeId inverse;
};

/// Sums and products of nodes; signs are taken out of factors.
class NodeAlgebra {
public:
    explicit NodeAlgebra(Program& program) : program_(program) {}
    using Pairs = std::vector<std::pair<NodeId, NodeId>>;
    /// a + sum of b*c, or minus.
    NodeId plus(NodeId a, const Pairs& products, bool is_minus = false) const;
    NodeId dot(const SixNodes& a, const SixNodes& b) const;
    SixNodes times(const SixBySix& matrix, const SixNodes& vector) const;
    SixNodes times_transposed(const SixBySix& matrix, const SixNodes& vector) const;
    SixNodes sum(const SixNodes& a, const SixNodes& b) const;
    SixNodes none() const;
    Program& program() const { return program_; }

private:
    Program& program_;
};

/// The steps, about which the proof is. `inertia` and `force` become what is left of them when a coordinate is eliminated.
EliminatedCoordinate eliminate(const NodeAlgebra& of, const SixNodes& direction, SixBySix& inertia, const Reciprocal& reciprocal);
/// rest - direction'*force
NodeId load(const NodeAlgebra& of, const SixNodes& direction, const EliminatedCoordinate& eliminated, NodeId rest, SixNodes& force);
/// qdd, from the acceleration without it; that becomes the one with it.
NodeId accelerate(const NodeAlgebra& of, const SixNodes& direction, const EliminatedCoordinate& eliminated, NodeId load,
                  SixNodes& acceleration);
/// What goes to the base: transfer'*inertia*transfer, which is symmetric, and transfer'*(force + inertia*remainder).
SixBySix handed_on(const NodeAlgebra& of, const SixBySix& transfer, const SixBySix& inertia);
SixNodes handed_on(const NodeAlgebra& of, const SixBySix& transfer, const SixBySix& inertia, const SixNodes& remainder,
                   const SixNodes& force);

/// What a chain is solved for with.
struct ChainLoads {
    std::vector<SixNodes> remainder, force;  ///< by link
    std::vector<NodeId> rest;                ///< by coordinate
    SixNodes ground;                         ///< acceleration
};

struct ChainMotion {
    std::vector<NodeId> accelerations;       ///< by coordinate
    std::vector<SixNodes> twists;            ///< rates of these, by link
};

/// Links with everything eliminated, to solve with for any loads.
class Articulated {
public:
    Articulated(Program& program, std::vector<LinkNodes> links, const Reciprocal& reciprocal);

    ChainMotion solve(const ChainLoads& loads) const;
    /// With accelerations that are known.
    ChainMotion moved(const ChainLoads& loads, std::vector<NodeId> accelerations) const;
    /// Of a link when what hangs on it has been handed to it, and when its coordinates have been eliminated.
    const SixBySix& inertia_with(std::size_t link) const { return whole_[link]; }
    const SixBySix& inertia_left(std::size_t link) const { return left_[link]; }

private:
    /// What a link is accelerated with before its own coordinates.
    SixNodes carried(std::size_t link, const ChainLoads& loads, const ChainMotion& motion) const;

    NodeAlgebra of_;
    std::vector<LinkNodes> links_;
    std::vector<std::vector<EliminatedCoordinate>> eliminated_;
    std::vector<SixBySix> whole_, left_;
};

/// A motion that is solved for from body to body, or known and only followed.
struct ChainNodes {
    std::vector<std::vector<NodeId>> letters;  ///< values of ChainLink::letters
    std::vector<LinkNodes> links;
    ChainLoads loads;
    std::vector<NodeId> inverses;      ///< of the pivots, in the order in which they are made
};

/// d(qdd)/d(column) by the same equations; nodes of Op::in_column choose the column.
struct ChainColumn {
    std::vector<std::size_t> columns;  ///< those in which anything is not zero
    // What the loads are made of, by link: how its letters change, its acceleration, and the moment and force that it needs.
    std::vector<std::vector<NodeId>> changes;
    std::vector<SixNodes> twists, needed;
    ChainLoads loads;
    std::vector<NodeId> results;       ///< by coordinate
};

}  // namespace dalembert

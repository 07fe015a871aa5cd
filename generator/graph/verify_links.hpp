// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs that code from body to body has the links that were derived, one link at a time.
//
// note [links in letters]: A link is made of its own letters and of those of its base. Each letter is shown to have the value that was
// derived, in letters of the base, and each part of a link to be what was derived, in both. By induction along the chain the equations are
// those that were derived, and nothing has to be written out in coordinates: a proof grows with the number of links.
// The same holds for the loop over columns. With d the derivative along a column at fixed accelerations, from a = X*a_base + S*qdd + r,
// f = I*a + p + sum of X_c'*f_c and S'*f = rest:
//     what changes a is dX*a_base + dS*qdd + dr,   f: dI*a + dp + sum of dX_c'*f_c,   rest: d(rest) - dS'*f
// and d of a part is the sum of its slopes times how the letters change, and its slope by the column.
// Where a quaternion turns a body, the equations of the links and those with M are the same at norm one alone. So are their derivatives
// along motions, which keep the norm; across it the code has those of the links.
#pragma once

#include "form/chain_slopes.hpp"
#include "graph/raise.hpp"
#include "prove/equivalence.hpp"
#include "prove/sum_by_sum.hpp"

namespace dalembert {

/// What could not be proven in letters is compared at random points.
using ComparisonAtPoints = std::function<void(const Prover::Evaluation& evaluate, const GiNaC::ex& emitted, const GiNaC::ex& derived)>;

class LinkProof {
public:
    LinkProof(const FunctionCode& f, const Code& code, CachedMeaning cached, Prover& prover, SumBySum& by_sums, ComparisonAtPoints compare);

    /// Letters, parts and loads.
    void links();
    /// What the loop over columns is solved with. Behind links().
    void columns(const ChainSlopes<GiNaC::ex>& slopes, By by);

private:
    using ex = GiNaC::ex;

    std::optional<NodeId> negated_by(NodeId id) const;
    void define(NodeId id, const ex& letter);
    /// Takes a node for a letter from here on; what is a number or a letter already stays that.
    ex stand_in(NodeId id, const ex& letter);
    Twist stand_in(const SixNodes& nodes, const std::string& name);
    void same(NodeId emitted, const ex& derived);
    bool is_same(const ex& raised, const ex& meant);
    void same(const SixNodes& emitted, const Twist& derived);
    /// Letters have the values that they stand for; accelerations that the function solves for are those of the motion.
    std::optional<cln::cl_R> value(const ex& e, const Point& point, int digits);
    std::optional<Point> with_letters(Point point, int digits) const;
    std::vector<NodeId> parts(std::size_t link) const;
    const Twist& base_acceleration(std::size_t link) const { return chain_.links[link].base ? twists_[*chain_.links[link].base] : ground_; }
    // Of a link, in a column: how its letters change, its acceleration, the moment and force that it needs, and what changes these.
    void changes(std::size_t link, const LinkSlopes<ex>& slopes, By by);
    void acceleration(std::size_t link);
    void needed(std::size_t link);
    void loads(std::size_t link, const ChainSlopes<ex>& slopes, By by);
    /// Slopes of the parts of a link, each with how much of it there is in a column.
    struct Change {
        LinkParts<ex> parts;
        ex change;
    };
    std::vector<Change> changes_of_parts(std::size_t link, const LinkSlopes<ex>& slopes, By by) const;

    const FunctionCode& f_;
    const System& system_;
    const Chain& chain_;
    Raiser raise_, kept_;                          ///< kept_: with sums kept whole
    Prover& prover_;
    SumBySum& by_sums_;
    ComparisonAtPoints compare_;
    std::vector<std::vector<std::size_t>> on_;     ///< links that are placed on a link
    GiNaC::exmap stands_for_;                      ///< letters of the derivation, and what code has in their place
    LetterMeanings meaning_;
    std::vector<ex> solved_;                       ///< accelerations that are letters for what they were solved to be
    struct Known {
        Point point;
        std::optional<Point> with_letters;
        int digits = 0;
    };
    Known known_;                                  ///< the last point
    std::vector<ex> in_column_;                    ///< by column: 1 in it, 0 in others
    std::vector<ex> accelerations_;                ///< by coordinate
    std::vector<std::vector<ex>> changes_;         ///< of letters, by link
    std::vector<Twist> twists_, needed_;
    Twist ground_;
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs for expressions with sums that are kept whole: one sum at a time.
#pragma once

#include "prove/equivalence.hpp"
#include "prove/fingerprint.hpp"
#include "prove/letter_meanings.hpp"

namespace dalembert {

/// note [sum by sum]: Velocities along a tree of bodies are sums of products of sums, and so on; written out they have no end. Each sum
/// that a derivation keeps whole becomes a letter, and stands for what it is in letters of the sums in it. A sum of the other side that
/// seems to be the same is proven to be, in letters, and is that letter from there on; what is like none is written out in letters.
/// What is equal whatever the letters are is equal. Where it is not, letters go one after the other, outermost first.
class SumBySum {
public:
    SumBySum(Prover& prover, const Symbols& symbols) : prover_(prover), print_(symbols) {}

    /// True only when proven. `derived` says what is a letter; the letters stay for the next call.
    bool proven_equal(const GiNaC::ex& other, const GiNaC::ex& derived);

    static bool has_sums(const GiNaC::ex& e);

private:
    using ex = GiNaC::ex;
    using Known = GiNaC::exhashmap<ex>;
    class Writer;

    ex letter_for(const ex& sum, bool is_derived);
    bool are_same(ex a, ex b);
    bool is_zero_down_to_leaves(ex difference);

    Prover& prover_;
    Fingerprints print_;
    LetterMeanings letters_;
    std::unordered_map<std::uint64_t, std::size_t> by_print_;  ///< of a sum, or of its negative where that is less
    Known derived_, other_;                                    ///< in letters
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints of a mode that repeat each other, as a stop and the friction beside it: the motion is determined, and the sum of what they
// bear, but not the share of each.
//
// note [shares]: A mode holds as long as the shares can be chosen so that every constraint that can let go holds on: friction within its
// limits, a stop that does not pull. Its events ask for that: the guards are linear in the shares, which Fourier and Motzkin's elimination
// takes out of them. A guard that is left is a sum of guards of events, which happen together where it falls through zero.
// Frictions in a loop hold one motion with factors that change with it and may have any sign. From holds + share > 0 and holds - share > 0
// of one, limit + b*share > 0 and limit - b*share > 0 of the other follows limit + |b|*holds > 0, where the share has left the forces: of
// all shares that the first allows, one lets the other hold. What is shown then divides the load in proportion to what each can hold.
// What is shown otherwise, and seen by other guards, is one of the possible choices: a constraint bears what those before it cannot, first
// those that can bear without limit, then friction, each in order of declaration.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// 1 or -1; 0 where it is not known.
int sign_of_factor(const GiNaC::ex& factor);

/// Whether nothing but frictions can let go of the constraints with these factors.
bool are_of_frictions(const System& system, const std::vector<GiNaC::ex>& factors);

/// " in mode 'open'"; nothing without modes.
std::string in_which_mode(const Scene& scene);
/// What is said of a constraint whose force is set to zero.
std::string why_alone(const System& system, std::size_t constraint);

/// Of factors with which the rates of constraints add up to zero. The last ones, whose forces are the shares, are frictions before others.
std::vector<Repetition> repetitions(const System& system, std::vector<std::vector<GiNaC::ex>> factors);

/// Positions of which one follows from others, but that cannot all be zero; a warning where the sign of a factor is not known, and not
/// all that can let go is friction.
std::optional<Diagnostic> why_not_shared(const System& system, const std::vector<Repetition>& repetitions);

/// Between its construction and settle(), outputs and guards are made with letters for forces that are shared.
class SharedForces {
public:
    explicit SharedForces(System& system);
    SharedForces(const SharedForces&) = delete;
    SharedForces& operator=(const SharedForces&) = delete;
    ~SharedForces();
    void settle();

private:
    struct Row;
    GiNaC::ex with_solved(const GiNaC::ex& e) const { return e.subs(solved_, GiNaC::subs_options::no_pattern); }
    bool has_letters(const GiNaC::ex& e) const;
    std::optional<std::vector<GiNaC::ex>> share_factors(const GiNaC::ex& guard) const;
    std::vector<Row> rows_of_events();
    std::vector<Row> without_share(const std::vector<Row>& rows, std::size_t share) const;
    struct Pair;
    std::optional<Pair> pair_of(const std::vector<Row>& rows, std::size_t share) const;
    std::vector<Row> without_even_share(const std::vector<Row>& rows, std::size_t share) const;
    GiNaC::ex even_share(std::size_t share, const std::vector<GiNaC::ex>& chosen) const;
    void choose_shares();
    void watch(const std::vector<Row>& rows);
    void tell() const;

    System& system_;
    std::vector<std::pair<std::size_t, GiNaC::ex>> letters_;  ///< of the constraints that share
    GiNaC::exmap solved_;                                     ///< their forces without shares
    GiNaC::exmap shown_;                                      ///< their forces with the shares that are chosen
    std::vector<std::vector<Row>> stages_;                    ///< rows with a share, when it is taken out of them
};

}  // namespace dalembert

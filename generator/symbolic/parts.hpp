// SPDX-License-Identifier: GPL-3.0-or-later
// What an expression is made of. Velocities along a chain of bodies are made of each other, so that what occurs in an expression may occur
// more often than could be counted.
#pragma once

#include <ginac/ginac.h>

#include <set>
#include <unordered_set>

namespace dalembert {

using LettersInside = std::set<GiNaC::ex, GiNaC::ex_is_less>;

/// Calls visit for the expression and what is inside it, outer ones first, until that returns true. Returns whether it did. What has parts
/// itself is looked at once, wherever it occurs.
template <class Visit>
bool any_part(const GiNaC::ex& e, const Visit& visit) {
    std::unordered_set<GiNaC::ex> seen;
    const auto look = [&](const auto& again, const GiNaC::ex& part) -> bool {
        if (part.nops() == 0) return visit(part);
        if (!seen.insert(part).second) return false;
        if (visit(part)) return true;
        for (std::size_t i = 0; i < part.nops(); ++i)
            if (again(again, part.op(i))) return true;
        return false;
    };
    return look(look, e);
}

/// Calls visit for all of that.
template <class Visit>
void each_part_once(const GiNaC::ex& e, const Visit& visit) {
    any_part(e, [&](const GiNaC::ex& part) {
        visit(part);
        return false;
    });
}

inline LettersInside letters_in(const GiNaC::ex& e) {
    LettersInside letters;
    each_part_once(e, [&](const GiNaC::ex& part) {
        if (GiNaC::is_a<GiNaC::symbol>(part)) letters.insert(part);
    });
    return letters;
}

/// Puts expressions for letters, which are symbols. Functions, sums that are kept whole among them, may occur many times, and are looked
/// at once.
class WithLetters : public GiNaC::map_function {
public:
    explicit WithLetters(GiNaC::exmap letters);
    GiNaC::ex operator()(const GiNaC::ex& e) override;

private:
    GiNaC::exmap letters_;
    GiNaC::exhashmap<GiNaC::ex> known_;
};

}  // namespace dalembert

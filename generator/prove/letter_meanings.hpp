// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "symbolic/parts.hpp"

namespace dalembert {

/// Letters that stand for something in a proof, each made of those before it.
class LetterMeanings {
public:
    struct Letter {
        GiNaC::ex symbol, meaning;
    };

    void add(const GiNaC::ex& symbol, const GiNaC::ex& meaning) {
        places_.emplace(symbol, letters_.size());
        letters_.push_back({symbol, meaning});
    }
    std::size_t size() const { return letters_.size(); }
    const Letter& operator[](std::size_t place) const { return letters_[place]; }
    auto begin() const { return letters_.begin(); }
    auto end() const { return letters_.end(); }

    std::set<std::size_t> in(const GiNaC::ex& e) const {
        std::set<std::size_t> result;
        each_part_once(e, [&](const GiNaC::ex& part) {
            if (const auto known = places_.find(part); known != places_.end()) result.insert(known->second);
        });
        return result;
    }
    GiNaC::ex without(const GiNaC::ex& e, std::size_t place) const {
        return e.subs(letters_[place].symbol == letters_[place].meaning, GiNaC::subs_options::no_pattern);
    }

    /// Writes letters out that only one of the two has, the last ones first, until both have the same or is_enough() says so.
    template <class Enough>
    void write_out(GiNaC::ex& a, GiNaC::ex& b, const Enough& is_enough) const {
        std::set<std::size_t> in_a = in(a), in_b = in(b);
        while (true) {
            std::vector<std::size_t> one_sided;
            std::set_symmetric_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(one_sided));
            if (one_sided.empty()) return;
            const bool is_in_a = in_a.contains(one_sided.back());
            GiNaC::ex& side = is_in_a ? a : b;
            side = without(side, one_sided.back());
            (is_in_a ? in_a : in_b) = in(side);
            if (is_enough()) return;
        }
    }

private:
    std::vector<Letter> letters_;
    GiNaC::exhashmap<std::size_t> places_;
};

}  // namespace dalembert

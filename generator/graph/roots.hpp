// SPDX-License-Identifier: GPL-3.0-or-later
// What the builder is asked for at once.
#pragma once

#include "graph/build.hpp"

namespace dalembert {

/// Roots for one call of the builder, and which of them is what.
class Roots {
public:
    std::size_t add(const std::vector<Polynomial>& polynomials) {
        const std::size_t first = polynomials_.size();
        polynomials_.insert(polynomials_.end(), polynomials.begin(), polynomials.end());
        return first;
    }
    std::size_t add(const std::vector<std::vector<Polynomial>>& columns, const Rational& factor = 1) {
        const std::size_t first = polynomials_.size();
        for (const auto& column : columns)
            for (Polynomial p : column) polynomials_.push_back(std::move(p *= factor));
        return first;
    }
    const std::vector<Polynomial>& polynomials() const { return polynomials_; }

private:
    std::vector<Polynomial> polynomials_;
};

}  // namespace dalembert

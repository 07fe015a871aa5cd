// SPDX-License-Identifier: GPL-3.0-or-later
// Points at which plants are compared.
#pragma once

#include "export/expected_values.hpp"

class Random {
public:
    double operator()() {
        state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }
    Vector vector(std::size_t n) {
        Vector v(n);
        for (double& value : v) value = 2 * (*this)() - 1;
        return v;
    }
    /// Near the start, with parameters near the defaults; the first one exactly there.
    Point point(ExpectedValues& plant, bool is_first) {
        Point q{{}, Vector(plant.inputs()), Vector(plant.parameters()), (*this)()};
        for (std::size_t i = 0; i < q.p.size(); ++i) q.p[i] = plant.table.parameter_defaults[i] * (is_first ? 1 : 1 + 0.01 * (*this)());
        q.x = plant.start(q.p);
        for (double& value : q.x) value = value * (1 + 0.1 * (*this)()) + 0.01 * ((*this)() - 0.5);
        for (std::size_t i = 0; i < q.u.size(); ++i)
            q.u[i] = std::isfinite(plant.table.input_table[i].low) ? plant.table.input_table[i].low : (*this)();
        return q;
    }

private:
    unsigned long long state_ = 88172645463325252ULL;
};

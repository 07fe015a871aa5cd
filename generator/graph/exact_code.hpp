// SPDX-License-Identifier: GPL-3.0-or-later
// What the code of a system computes at one point, with as many digits as wanted and with the slopes by everything that it gets.
#pragma once

#include "graph/code.hpp"
#include "graph/exact_number.hpp"

namespace dalembert {

class ExactCode {
public:
    ExactCode(const Code& code, int digits);

    /// What the functions of a header get: parameters, the state x in its order, inputs, the time, and residuals of constraints.
    static std::vector<const Variable*> inputs(const System& system);

    /// A point: one number for each input. Everything is computed when it is asked for.
    void set(const std::vector<Rational>& values);

    /// Of a function, a node of its program.
    const MaybeExact& at(Function function, NodeId id);
    /// Of a function that fills a list, everything in it.
    std::vector<MaybeExact> results(Function function);
    /// dx/dt
    std::vector<MaybeExact> rates();
    /// An entry of d(dx/dt)/d(column), in rows and columns of x, u, p or t.
    MaybeExact slope(Function function, std::size_t row, std::size_t column);
    /// An entry of dy/dx or dy/du.
    MaybeExact output_slope(Function function, std::size_t row, std::size_t column);

private:
    struct Memory {
        std::vector<MaybeExact> values = {};
        std::vector<char> is_known = {};
        std::map<std::size_t, std::vector<MaybeExact>> columns = {};  ///< solved by loops
        std::optional<std::vector<MaybeExact>> factors = {};
    };

    const MaybeExact& of_letter(Letter letter);
    MaybeExact compute(Function function, const Program& program, NodeId id);
    void update();
    MaybeExact acceleration(std::size_t j);
    MaybeExact jerk(std::size_t j);
    const std::vector<MaybeExact>& factors(Function function);
    std::vector<MaybeExact> solve(Function function, std::vector<MaybeExact> b);
    std::vector<MaybeExact> nodes(Function function, const std::vector<NodeId>& ids);

    const Code& code_;
    ExactArithmetic arithmetic_;
    std::vector<const Variable*> inputs_;
    std::array<Memory, function_count> memory_;
    std::map<Letter, MaybeExact> letters_;
    std::vector<MaybeExact> cached_;
};

}  // namespace dalembert

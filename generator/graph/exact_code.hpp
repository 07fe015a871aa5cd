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

    /// Where M*x = b is solved, M and b are computed first, and rounded. So slopes have more behind those by the inputs: one for each
    /// unknown of the motion, then one for each of a column of a Jacobian, where these are solved for.
    std::size_t slope_count() const { return inputs_.size() + 2 * unknowns_; }
    /// How far the unknowns move (Skeel) when each entry of M and b is known no better than its own condition and rounding allow:
    /// |M^-1|*(d(b) + d(M)*|x|), d(a) = uncertainty(a) + half_ulp(a). b: of the motion, or a column of right sides in a function.
    std::vector<double> rounding(Function function, std::optional<std::size_t> column, const std::function<double(double)>& ulp,
                                 const std::function<double(const ExactNumber&)>& uncertainty);

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
        std::map<NodeId, std::size_t> solved = {};                    ///< nodes that were solved for, and their slopes
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
    const std::vector<MaybeExact>& solved_in_loop(Function function, std::size_t column);
    std::vector<double> rounding_of_chain(Function function, std::optional<std::size_t> column, const std::function<double(double)>& ulp,
                                          const std::function<double(const ExactNumber&)>& uncertainty);
    void note_solved(MaybeExact& value, std::size_t number) const;
    void find_solved(Function function);
    struct Equations {
        std::vector<std::vector<ExactNumber>> matrix;
        std::vector<std::vector<cln::cl_R>> inverse;
    };
    const std::optional<Equations>& equations(Function function);
    std::vector<bool> left_out(Function function, std::size_t n) const;

    const Code& code_;
    ExactArithmetic arithmetic_;
    std::vector<const Variable*> inputs_;
    std::size_t unknowns_;
    std::array<Memory, function_count> memory_;
    std::map<Function, std::optional<Equations>> equations_;
    std::map<Letter, MaybeExact> letters_;
    std::vector<MaybeExact> cached_;
    std::size_t column_ = 0;  ///< of a loop over columns
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// How the functions of a header are compared with what was derived, one method for each kind of function.
#pragma once

#include "graph/derived_values.hpp"
#include "graph/raise.hpp"
#include "graph/verify.hpp"
#include "graph/verify_chain.hpp"
#include "graph/verify_links.hpp"
#include "graph/verify_solve.hpp"
#include "prove/sum_by_sum.hpp"

namespace dalembert {

class Verification {
public:
    explicit Verification(const Code& code)
        : code_(code),
          system_(code.system),
          prover_(code.system),
          by_sums_(prover_, code.system.symbols),
          cached_(cached_meaning(code)) {}

    std::vector<AuditEntry> run();

private:
    using Kind = HeaderFunction::Kind;
    using ex = GiNaC::ex;

    struct MovingRaisers {
        Raiser with_letters, with_sums, with_solutions;  ///< with_sums: letters, and sums kept whole
    };

    const ex& acceleration(std::size_t j) const { return system_.symbols.get(SymbolKind::acceleration, j); }

    AuditEntry& entry(const std::string& name);
    void compare(Function function, const ex& emitted, const ex& derived);
    void compare(Function function, Raiser& plain, Raiser& kept, NodeId node, const ex& derived) {
        if (is_proven_by_sums(kept, node, derived)) compare(function, derived, derived);
        else compare(function, plain(node), derived);
    }
    /// note [sum by sum]: whether a node raised with its sums kept whole is what was derived.
    bool is_proven_by_sums(Raiser& kept, NodeId node, const ex& derived) {
        return SumBySum::has_sums(derived) && by_sums_.proven_equal(kept(node), derived);
    }
    GiNaC::exmap solutions(const FunctionCode& f, Raiser& raise) const;
    void solved_motion(Function function);
    Raiser raiser(const FunctionCode& f, Raiser::Sums sums = Raiser::Sums::open) const {
        return Raiser(f.program, code_.atoms, cached_, sums);
    }
    MovingRaisers moving_raisers(const FunctionCode& f) const;
    void compare_moving(Function function, MovingRaisers& raise, NodeId node, const ex& derived);
    /// By the chain rule through the free accelerations, whose slopes are letters here.
    void held_column(Function function, const FunctionCode& f, std::size_t c, const std::vector<ex>& at_fixed);
    void solve_is_right(const std::string& name, std::size_t n, std::size_t multipliers, const std::vector<bool>& is_zero);
    void prove(const HeaderFunction& row);
    void definitions();
    /// M and the right sides, the accelerations that follow from what is solved for, and rates of states.
    void motion(Function function);
    /// The equations of the links mean M and Q - bias, whatever function they are emitted in.
    const Comparison& equations_of_links();
    /// The links of a function are those that were derived; what solves them was proven to.
    LinkProof link_proof(Function function);
    /// The loads of each column, in the same equations, are what these change by.
    void chain_columns(Function function, By by);
    void chain_is_solved(Function function);
    /// In the code of the joint function accelerations are solutions; for the comparison they are letters again. Where the same
    /// operations happen to stand for an acceleration and for something else, the solutions are put into the derivation instead.
    void columns(Function function, By by);
    /// Rates and Jacobian, and behind them outputs and energies.
    void together();
    /// Next states, and behind them outputs.
    void sample();
    /// Its parts as they are derived, in letters of the unknowns and of w, and made of them as note [Hessian] says.
    void hessian();
    /// Each w is a letter again, unless its node stands for something else as well: then the letter is what the node is.
    GiNaC::exmap define_adjoints(const FunctionCode& f, MovingRaisers& raise) const;
    /// The correction that brings a run back to constraints.
    void correction();
    void resets();
    /// Values may contain what was solved for on the way, and its rates; these are letters in the comparison.
    void values(Function function, const std::vector<ex>& derived);
    std::vector<ex> rates_of_unknowns() const;
    GiNaC::exmap rate_solutions(const FunctionCode& f, Raiser& raise) const;
    /// What was solved for on the way becomes letters again.
    void define_solutions(const FunctionCode& f, Raiser& raise) const;
    void output_columns(Function function, By by);
    /// The slopes of outputs are made of those that were compared, by the chain rule.
    void whole_output(Function function, const FunctionCode& f, const Partials& p);

    const Code& code_;
    const System& system_;
    Prover prover_;
    SumBySum by_sums_;
    CachedMeaning cached_;
    std::optional<Comparison> of_links_;
    std::vector<AuditEntry> entries_;
};

}  // namespace dalembert

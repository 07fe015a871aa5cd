// SPDX-License-Identifier: GPL-3.0-or-later
// The code of a system, function by function, before it becomes C++.
#pragma once

#include <memory>
#include <set>

#include "form/jacobian.hpp"
#include "graph/articulated.hpp"
#include "graph/build.hpp"
#include "graph/chain_use.hpp"
#include "graph/functions.hpp"
#include "graph/rewrite.hpp"

namespace dalembert {

/// A matrix of values, column-major.
struct CodeMatrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<NodeId> entries = {};
    NodeId at(std::size_t row, std::size_t column) const { return entries[column * rows + row]; }
};

/// One function of the header. Which parts are there depends on the function.
struct FunctionCode {
    Program program = {};
    bool by_loops = false;                  ///< solves with M by loops: M and right sides are results, not steps on the way
    std::vector<NodeId> mass = {};          ///< lower triangle of M, row by row
    std::vector<NodeId> factors = {};       ///< L below the diagonal and 1/D on it, where the solve is written out
    std::vector<NodeId> force = {};         ///< Q - bias
    std::vector<NodeId> accelerations = {};  ///< qdd: solved for where the solve is written out, else symbols; those that constraints
                                             ///< determine with them, and multipliers behind them
    std::vector<NodeId> solved_for =
        {};  ///< accelerations and multipliers that results need on the way, in functions that are about something else
    std::vector<NodeId> results = {};       ///< of rhs: the rates of plain states; of `together` behind them outputs and energies
    CodeMatrix right = {};                  ///< -dR/d(column), the right sides of M*X
    CodeMatrix solved = {};                 ///< X = d(qdd)/d(column) where the solve is written out
    CodeMatrix below = {};                  ///< d(zd)/d(column)
    CodeMatrix by_output = {};              ///< d(y)/d(column) at fixed accelerations
    CodeMatrix by_acceleration = {};        ///< d(y)/d(qdd), and by the multipliers behind them
    CodeMatrix whole_output = {};           ///< d(y)/d(column), where outputs contain multipliers
    struct SecondOrder {
        std::vector<NodeId> right, solved;  ///< w of note [Hessian]: what M is solved for with, and the solution
        std::vector<NodeId> direct;         ///< lower triangle of L_yy
        CodeMatrix mixed;                   ///< [unknown][column]: L_ya
    };
    std::optional<SecondOrder> second = {};
    std::vector<NodeId> rates_solved_for =
        {};  ///< rates of accelerations and multipliers, where results contain those of multipliers; of the one column in `right`
    std::optional<ChainNodes> chain = {};   ///< where the motion is followed from body to body: what it is solved with, or would be
    std::optional<ChainColumn> loop = {};   ///< d(qdd)/d(column), computed in a loop over the columns
    bool uses_accelerations = false;        ///< the symbols of qdd occur: they are to be computed first
    bool uses_jerks = false;                ///< those of their rates occur

    /// Sets uses_accelerations and uses_jerks.
    void note_letters(const Atoms& atoms);
    /// Whether a node differs from column to column of the loop, by number.
    std::vector<bool> varying() const;
    bool is_zero(NodeId id) const { return program.is_constant(id, 0); }
    /// What the emitted code has to compute.
    std::vector<NodeId> roots() const;
};

/// What an event sets: these places in x, to results of Function::resets from `first` on.
struct ResetCode {
    std::vector<std::size_t> places = {};
    std::size_t first = 0;
    std::optional<std::size_t> impact = {};  ///< the column of solved in which M^-1*direction stands
    std::optional<NodeId> impulse = {}, limited = {};  ///< where it takes roundings and no more: see note [dead centres]
};

/// Whose sine and cosine the header calls: those of the library, or of float its own, which makes both from one reduction.
enum class Trig { library, combined };

/// What is asked of code besides the functions that every header has.
struct CodeWish {
    Passes passes = {};
    bool series = false;   ///< of the motion
    std::set<Function> functions = {};  ///< of those that headers have where they are asked for
    ChainUse chain = ChainUse::where_shorter;
    Trig trig = Trig::library;
};

struct Code {
    explicit Code(const System& derived) : system(derived), atoms(derived.symbols) {}
    Code(const Code&) = delete;

    const System& system;
    mutable KnownPartials partials{system};       ///< taken when they are asked for
    Atoms atoms;
    ParameterCache cache;
    Solve solve;                                  ///< how M*x = b is solved
    Passes passes;
    Trig trig = Trig::library;
    bool has_long_chain = false;                  ///< the motion is solved for from body to body, and nothing with M
    std::set<Function> wished;                    ///< functions that were asked for and are there
    std::vector<std::size_t> definition_order;    ///< definitions, each behind those it needs
    std::array<FunctionCode, function_count> functions;
    /// Where series are asked for, what they are made of: the motion, and behind the rates of plain states the power that changes its
    /// energy.
    std::optional<FunctionCode> series_of;
    std::vector<ResetCode> resets, rests;         ///< by event
    std::vector<std::optional<std::size_t>>
        condition_places;                         ///< of x, with the results of Function::conditions; nothing: they are to be zero
    std::vector<Rewriting> rewritten;             ///< what has another form than it was derived in

    FunctionCode& operator[](Function f) { return functions[static_cast<std::size_t>(f)]; }
    const FunctionCode& operator[](Function f) const { return functions[static_cast<std::size_t>(f)]; }
    OperationCount count(Function f) const;
};

/// Factors of note [choice] for the multipliers that are solved for, and for all constraints that hold: those that are eliminated are never
/// left out. None where nothing is chosen.
std::vector<NodeId> chosen(Program& program, const Solve& solve);
std::vector<NodeId> chosen_of_held(Program& program, const Code& code, const std::vector<std::size_t>& held);

/// All functions of a system as code.
std::unique_ptr<Code> make_code(const System& system, const CodeWish& wish = {});

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and argument lists of the header's functions.
#pragma once

#include "program/statement_maker.hpp"
#include "program/shared_members.hpp"

namespace dalembert {

class SeriesStatements;

/// Inputs as series: what computes their first coefficients, and those of order k.
struct InputSeries {
    std::size_t rows;  ///< of series that are multiplied
    Statements start, step;
};
/// Of expressions of time and states. Throws Failure (no-series).
InputSeries input_series(Code& code, const std::vector<GiNaC::ex>& inputs);
bool have_series(Code& code, const std::vector<GiNaC::ex>& inputs);

class FunctionBodies {
public:
    FunctionBodies(const Code& code, const SharedMembers& shared);

    /// `done`: members that other modes have computed, which grows.
    FunctionBody update(std::set<std::string>& done);
    FunctionBody start_state();
    /// Of all functions but those that have one of their own here.
    FunctionBody body(const HeaderFunction& function);
    FunctionBody jacobian_x() const;
    /// Taylor series of the motion. Afterwards series_rows() is known.
    FunctionBody series();
    std::size_t series_rows() const { return series_rows_; }
    FunctionBody move_back();
    /// What events change, by `resets`: a switch over the event.
    FunctionBody resets(const std::vector<ResetCode>& resets);
    /// Guards that end nothing, each at its place in a list for all modes.
    FunctionBody kinks(const std::vector<Guard>& kinks);

    /// The header's own functions that its code calls: "ldlt", "sign", ...
    const std::set<std::string>& helpers() const { return helpers_; }

private:
    /// Arguments that are used although no symbol of the program stands for them.
    struct Uses {
        bool state = false;
        bool everything = false;
        bool has_input = true;
    };

    FunctionBody rhs();
    FunctionBody rhs_and_jacobian();
    FunctionBody together();
    FunctionBody hessian(const HeaderFunction& row);
    FunctionBody jacobian(const HeaderFunction& row);
    FunctionBody symmetric(const HeaderFunction& row);
    FunctionBody values(const HeaderFunction& row);
    FunctionBody number(const HeaderFunction& row);
    FunctionBody sample();
    FunctionBody matrix(const HeaderFunction& row);
    FunctionBody output_jacobian(const HeaderFunction& row);
    FunctionBody whole_output_jacobian(StatementMaker& maker, const FunctionCode& f, const HeaderFunction& row);
    /// Guards of events that are watched, or their rates.
    FunctionBody event_values(const HeaderFunction& row);
    FunctionBody conditions();
    /// What brings a state back to constraints, from the residuals of their positions or rates.
    FunctionBody correction(const HeaderFunction& row);

    static Argument result_of(const char* type, const char* name, bool is_used);
    static Statement vector_of(const char* type, const char* name);
    std::vector<std::size_t> needed_definitions() const;
    Statements motion(StatementMaker& maker, const FunctionCode& f);
    Statements stored_motion(StatementMaker& maker, const FunctionCode& f);
    Statements motion_and_jacobian(StatementMaker& maker, const FunctionCode& f);
    Statements entries_if_few(StatementMaker& maker, const FunctionCode& f);
    Statements filled_jacobian(StatementMaker& maker, const FunctionCode& f, const JacobianLayout& layout, By by, bool has_mass);
    Statements column_loop(StatementMaker& maker, const FunctionCode& f, const JacobianLayout& layout);
    Statements factored_mass(StatementMaker& maker, const FunctionCode& f);
    Value mass() const;
    Value call_of(const char* function, std::vector<std::string> results) const;
    Statements solved(Value right) const;
    Statements assigned(StatementMaker& maker, Value target, NodeId value);
    Statements integrated_rates(SeriesStatements& series, const FunctionCode& f) const;
    Statements solved_at_start(StatementMaker& maker, const FunctionCode& f);
    Statements rates_at_start(StatementMaker& maker, const FunctionCode& f);
    static Statements loop_over_orders(const SeriesStatements& series, Statements step, bool uses_inputs);
    void name_multipliers(StatementMaker& maker, const std::vector<NodeId>& solved_for) const;
    FunctionBody finish(const StatementMaker& maker, Statements statements, std::vector<Argument> results, Uses uses);
    Statements accelerations_by_rhs(StatementMaker& maker);

    bool is_kept(std::size_t definition) const { return shared_.is_kept(definition); }
    const JacobianLayout& layout(By by) const { return shared_.layout(by); }
    Statements jerks(const FunctionCode& f);

    const Code& code_;
    const SharedMembers& shared_;
    std::size_t n_;
    std::size_t velocities_, states_;  ///< where these begin in x
    std::size_t m_;
    const std::map<std::uint32_t, std::size_t>& cached_;
    CachedValues cached_values_;
    std::vector<Value> mode_;  ///< the first argument of calls, or nothing
    std::set<std::string> arguments_;
    std::set<std::string> helpers_;
    std::size_t series_rows_ = 0;
};

}  // namespace dalembert

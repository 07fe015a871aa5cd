// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and argument lists of the header's functions.
#pragma once

#include "emit/cpp_function.hpp"
#include "emit/shared_members.hpp"

namespace dalembert {

struct CppBody {
    std::string arguments;  ///< names of what is not used are commented out
    std::string statements;
};

/// Inputs as series: what computes their first coefficients, and those of order k.
struct InputSeries {
    std::size_t rows;  ///< of series that are multiplied
    std::string start, step;
};
/// Of expressions of time and states. Throws Failure (no-series).
InputSeries input_series(Code& code, const std::vector<GiNaC::ex>& inputs);
bool have_series(Code& code, const std::vector<GiNaC::ex>& inputs);

/// Of statements in a member function.
inline constexpr const char* indent = "        ";

/// Every line by four blanks.
std::string shifted(const std::string& text);

class CppBodies {
public:
    CppBodies(const Code& code, const SharedMembers& shared);

    /// `done`: members that other modes have computed, which grows.
    CppBody update(std::set<std::string>& done);
    CppBody start_state();
    CppBody rhs();
    CppBody rhs_and_jacobian();
    /// Rates, Jacobian, outputs and energies.
    CppBody together();
    /// Taylor series of the motion. Afterwards series_rows() is known.
    CppBody series();
    std::size_t series_rows() const { return series_rows_; }
    CppBody jacobian(Function function, By by);
    CppBody mass_matrix();
    /// A function that fills an array with one value a row.
    CppBody values(Function function, const char* type, const char* result, bool has_input = true);
    CppBody constraint_jacobian();
    CppBody output_jacobian(Function function, By by);
    CppBody scalar(Function function);
    /// What brings a state back to constraints, from the residuals of their positions or rates.
    CppBody correction();
    CppBody move_back();
    /// Of a machine that switches: guards of events that are watched, or their rates.
    CppBody guards(Function function, const char* type, const char* result);
    CppBody conditions();
    /// What events change, by `resets`: a switch over the event.
    CppBody resets(const std::vector<ResetCode>& resets);
    /// Guards that end nothing, each at its place in a list for all modes.
    CppBody kinks(const std::vector<Guard>& kinks);

    /// The header's own functions that its code calls: "ldlt", "sign", ...
    const std::set<std::string>& helpers() const { return helpers_; }

private:
    /// Arguments that are used although no symbol of the program stands for them.
    struct Uses {
        bool state = false;
        bool everything = false;
        bool has_input = true;
    };

    std::vector<std::size_t> needed_definitions() const;
    std::string motion(CppFunction& cpp, const FunctionCode& f);
    std::string stored_motion(CppFunction& cpp, const FunctionCode& f);
    std::string motion_and_jacobian(CppFunction& cpp, const FunctionCode& f);
    std::string entries_if_few(CppFunction& cpp, const FunctionCode& f);
    std::string filled_jacobian(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout, By by, bool has_mass);
    std::string column_loop(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout);
    std::string factored_mass(CppFunction& cpp, const FunctionCode& f);
    std::string mass_name() const;
    std::string assigned(CppFunction& cpp, const std::string& target, NodeId value);
    std::string scope(const std::set<std::string>& called);
    static std::string argument(const char* type, const char* name, bool is_used);
    CppBody whole_output_jacobian(CppFunction& cpp, const FunctionCode& f, By by);
    void name_multipliers(CppFunction& cpp, const std::vector<NodeId>& solved_for) const;
    CppBody finish(const CppFunction& cpp, std::string statements, const std::string& result, Uses uses);
    std::string accelerations_by_rhs(CppFunction& cpp);

    bool is_kept(std::size_t definition) const { return shared_.is_kept(definition); }
    const JacobianLayout& layout(By by) const { return shared_.layout(by); }
    std::string jerks(const FunctionCode& f);

    const Code& code_;
    const SharedMembers& shared_;
    std::size_t n_;
    std::size_t velocities_, states_;  ///< where these begin in x
    std::size_t m_;
    const std::map<std::uint32_t, std::size_t>& cached_;
    CachedTexts cached_texts_;
    const char* mode_;  ///< the first argument of calls: "mode, ", or nothing
    std::set<std::string> arguments_;
    std::set<std::string> helpers_;
    std::size_t series_rows_ = 0;
};

}  // namespace dalembert

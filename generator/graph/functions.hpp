// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of a header, a row each. What making code, proving, measuring, printing and reporting have to know of one stands in its
// row; what they do, they do by its kind.
#pragma once

#include <set>
#include <span>

#include "form/jacobian.hpp"
#include "graph/build.hpp"

namespace dalembert {

/// In the order of reports.
enum class Function {
    update,
    rhs,
    rhs_and_jacobian,
    jacobian_u,
    jacobian_p,
    jacobian_t,
    mass_matrix,
    bias,
    generalised_force,
    output,
    output_jacobian_x,
    output_jacobian_u,
    kinetic_energy,
    potential_energy,
    supplied_power,
    dissipated_power,
    prescribed_power,
    internal_energy,
    exchanged_power,
    guards,
    time_switches,
    start_state,
    events,
    event_rates,
    conditions,
    resets,
    constraint_positions,
    constraint_rates,
    constraint_forces,
    constraint_jacobian,
    correction,
    together,
    hessian,
    output_jacobian_p,
    output_jacobian_t,
    sample,
};
inline constexpr std::size_t function_count = static_cast<std::size_t>(Function::sample) + 1;

struct HeaderFunction {
    enum class Kind {
        update,           ///< fills what depends on parameters alone
        start,            ///< values of x
        motion,           ///< dx/dt, and with it its derivative where `by` says by what
        together,         ///< a motion and its derivative, and outputs and energies of it
        jacobian,         ///< the derivative of dx/dt, alone
        symmetric,        ///< a matrix, of which the lower triangle is made, row by row
        values,           ///< an array with a value a name
        number,           ///< one value, which is returned
        output_jacobian,  ///< the derivative of the outputs
        matrix,           ///< names x coordinates; made row by row
        event_values,     ///< a value an event; of those that a mode does not watch none
        conditions,       ///< whether values are near entries of x, or zero
        resets,           ///< new values of x, by event
        correction,       ///< a step that takes residuals of constraints away
        hessian,          ///< second derivatives of dx/dt, contracted
        sample,           ///< outputs and next states of a controller
    };
    /// Which headers have it.
    enum class In { none, all, switching, timed, constrained, wished, controllers };
    using Values = std::vector<GiNaC::ex> (*)(const System&);
    using Names = std::vector<std::string> (*)(const System&);

    Function function;
    const char* name;               ///< in reports
    Kind kind;
    In in;
    ParameterParts parts;
    const char* doc;                ///< for users of the header; lines
    const char* group = "";         ///< what reports say that its values belong to
    const char* in_header = nullptr;  ///< its name there, where it is another one; of two with one code, see `resets`, the first
    const char* type = "";          ///< of the array that it fills
    const char* array = "";         ///< the name of that
    bool takes_input = true;        ///< x, u, t; else x, t
    std::optional<By> by = {};      ///< what it is a derivative by
    Values values = nullptr;        ///< as they are derived: what is lowered to code, and what code is proven to be
    Names names = nullptr;          ///< of the values, in reports
    const char* letter = "";        ///< of the equations "letter[name] = value"
    bool has_equations = false;     ///< they stand above it
    Values shown = nullptr;         ///< the values as people read them, where they are not `values`
    const char* energy = nullptr;   ///< its name in what `together` fills
    const char* wish = "";          ///< what those get who ask for it

    const char* header_name() const { return in_header != nullptr ? in_header : name; }
    std::vector<GiNaC::ex> shown_values(const System& system) const { return (shown != nullptr ? shown : values)(system); }
};

/// In the order of the header. Code is made first of what adds to the cache, see ParameterParts.
std::span<const HeaderFunction> header_functions();
const HeaderFunction& header_function(Function function);
inline const char* name_of(Function function) { return header_function(function).name; }
/// By which the command line asks for it: "--output-jacobian-p".
std::string flag_of(Function function);
/// Whether code of it is made: of a controller that samples `sample` alone, with what parameters and start values need.
bool is_made(const HeaderFunction& row, const System& system, const std::set<Function>& wished);
/// The function in which the derivatives of dx/dt are computed.
Function jacobian_by(By by);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// "s=0.55, dot(s)=-0.3, p=5bar": values from the command line.
#pragma once

#include "form/system.hpp"
#include "run/options.hpp"
#include "scene/fix_parameters.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// One assignment, with the value as it was written.
struct Setting {
    ExpressionPtr variable;
    ExpressionPtr value;
};

/// The next comma outside of brackets, or the end.
std::size_t end_of_part(const std::string& text, std::size_t from);

/// Texts between commas outside of brackets, without blanks around them, as excerpts of a source.
std::vector<Excerpt> parts_of_list(const SourcePtr& source);

/// `option` names the option in diagnostics. Throws Failure (bad-option, syntax, unknown-unit).
std::vector<Setting> parse_settings(const std::vector<std::string>& texts, const std::string& option);

/// "parameters", or names and values: what --fix asks for. Throws Failure (bad-option, syntax, unknown-unit, unit-mismatch,
/// not-allowed-here).
FixWish parse_fixed(const std::string& text, const Names& names);

/// Those of parameter files, and behind them those of --parameter. A parameter file is TOML with a table of values, as "5 bar" or 0.3, by
/// names: [parameters]. Throws Failure (unreadable-file, toml-syntax, unknown-key, missing-key, wrong-type, syntax, unknown-unit).
std::vector<Setting> parameter_settings(const Options& options);

/// Applies them. `allowed` says what may be set: bits of Dependence. Throws Failure (unknown-name, unit-mismatch, value-out-of-range).
void apply_settings(Values& values, const std::vector<Setting>& settings, unsigned allowed, const System& system);

/// The value in SI. Throws Failure when its unit is not that of the variable, or it depends on what it must not depend on.
ExpressionPtr value_of(const Setting& setting, unsigned may_depend, const Names& names);
/// Throws Failure (missing-key) for an input that nobody gives and that cannot be meant to be zero: one with a range without zero, an
/// absolute temperature or pressure. `is_given` says which are given, in the order of the scene.
void check_inputs_given(const std::vector<bool>& is_given, const System& system);

/// Warnings, as they are shown, of temperatures of media and nodes, and of pressures, that hardly anybody means. Without
/// known inputs it skips values that depend on an input.
std::string doubts_of_start(const Values& values, const System& system, bool knows_inputs = true);

/// Warnings, as they are shown, of curves that end runs and are taken outside of their points; one for each, where that is farthest.
std::string doubts_of_curves(const Values& values, const System& system);

/// Warnings, as they are shown, of a state and inputs that were computed: curves outside of their points, values outside of their
/// declared ranges, temperatures below absolute zero, pressures below a vacuum. `x` and `u` are in the order of the state variables and
/// inputs.
std::string doubts_of_found(const Values& values, const System& system, const std::vector<double>& x, const std::vector<double>& u);

/// A standard deviation in SI, above zero: of a difference, so that degC count as K. A number alone counts in `unit`. `what` stands in the
/// sentence: "the noise of 'phi'". Throws Failure (unit-mismatch, not-allowed-here, value-out-of-range).
double deviation_in_si(const ExpressionPtr& written, Unit unit, const std::string& what, const System& system);
/// The same as it is written, also as "5 %" of a mean in SI.
double deviation_in_si(const Span& written, double mean, const Unit& unit, const std::string& what, const System& system);

void check_dependence(const Expression& value, unsigned may_depend, const std::string& what, const Names& names);

}  // namespace dalembert

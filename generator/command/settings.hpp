// SPDX-License-Identifier: GPL-3.0-or-later
// "s=0.55, dot(s)=-0.3, p=5bar": values from the command line.
#pragma once

#include "form/system.hpp"
#include "model/fix_parameters.hpp"

namespace dalembert {

/// One assignment. A number with a unit is converted to SI; a bare number is in SI.
struct Setting {
    ExpressionPtr variable;
    ExpressionPtr value;
    std::optional<Unit> unit;  ///< as it was written
};

/// `option` names the option in diagnostics. Throws Failure (bad-option, syntax, unknown-unit).
std::vector<Setting> parse_settings(const std::vector<std::string>& texts, const std::string& option);

/// "parameters", or names and values: what --fix asks for. Throws Failure (bad-option, syntax, unknown-unit, unit-mismatch, not-allowed-here).
FixWish parse_fixed(const std::string& text, const Names& names);

/// Applies them. `allowed` says what may be set: bits of Dependence. Throws Failure (unknown-name, unit-mismatch, value-out-of-range).
void apply_settings(Values& values, const std::vector<Setting>& settings, unsigned allowed, const System& system);

/// Throws Failure when the unit is not that of the variable, or the value depends on what it must not depend on.
void check_setting(const Setting& setting, unsigned may_depend, const Names& names);
void check_dependence(const Expression& value, unsigned may_depend, const std::string& what, const Names& names);

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// Printed equations and what they are in the model language.
#pragma once

#include <string>

#include "language/expression_text.hpp"
#include "printed/latex_reader.hpp"

namespace latex_rows {

struct Row {
    const char* latex;
    const char* model;  ///< equations with "; " between them, conditions behind " if "
};

inline dalembert::Excerpt text(const std::string& latex) { return dalembert::excerpt_of(std::make_shared<const dalembert::Source>("book", latex)); }

/// All equations of a text as a row has them.
inline std::string in_rows(const std::string& latex, const dalembert::PrintedNotation& notation = {}) {
    std::string result;
    for (const dalembert::LatexEquation& read : dalembert::read_latex(text(latex), notation)) {
        if (!result.empty()) result += "; ";
        for (std::size_t i = 0; i < read.equation.sides.size(); ++i)
            result += (i > 0 ? std::string(" ") + sign_of(read.relations[i - 1]) + " " : "") + in_model_language(*read.equation.sides[i]);
        for (const auto& condition : read.conditions) result += " if " + in_model_language(*condition);
    }
    return result;
}

}  // namespace latex_rows

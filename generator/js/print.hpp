// SPDX-License-Identifier: GPL-3.0-or-later
// Values and statements as JavaScript. No name of a model contains "$": with it begins what this printer adds, functions of the plant and
// helpers, and `$p` and `$c`, the parameters and what depends on them alone.
#pragma once

#include "js/helpers.hpp"
#include "program/plant.hpp"

namespace dalembert {

class JsPrinter {
public:
    explicit JsPrinter(const Plant& plant) : plant_(plant) {}

    std::string text(const Value& value);
    /// Statements from column 8 on.
    std::string text(const Statements& statements);
    /// "x, u, t, dxdt".
    static std::string text(const std::vector<Argument>& arguments);

    /// Tables of measured characteristics.
    std::string curves(const std::vector<PlantCurve>& curves);

    /// Functions of the runtime that were called so far.
    const std::set<CHelper>& called() const { return called_; }

private:
    std::string operand(const Value& value, int least_precedence);
    std::string listed(const std::vector<Value>& parts, const char* between);
    std::string sum(const Value& value);
    std::string product(const Value& value);
    std::string call(const Value& value);
    std::string comparison(const Value& value);
    std::string declaration(const Declaration& d);
    std::string filled_by_call(const Declaration& d);
    std::string invocation(const Value& call);
    std::string assignment(const Assignment& a);
    std::string modes(const ByMode& by_mode);
    std::string braced(const std::string& head, const Statements& body);
    std::string one(const Statement& statement);
    std::size_t mode_number(const std::string& mode) const;
    std::size_t event_number(const std::string& event) const;

    const Plant& plant_;
    std::set<CHelper> called_;
};

/// The shortest text that is read as this double.
std::string js_number(double value);
/// A string literal that ends neither a script nor a comment.
std::string js_string(const std::string& text);

}  // namespace dalembert

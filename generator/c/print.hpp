// SPDX-License-Identifier: GPL-3.0-or-later
// Values and statements as C99, in functions whose names begin with that of the plant. Every name ends in no underscore but those of this
// printer: `plant_`, the plant itself, and `data_`.
#pragma once

#include "c/helpers.hpp"
#include "program/plant.hpp"

namespace dalembert {

class CPrinter {
public:
    /// `name` stands before every name that the header defines.
    CPrinter(const Plant& plant, std::string name) : plant_(plant), name_(std::move(name)) {}

    std::string text(const Value& value);
    /// Statements from column 4 on.
    std::string text(const Statements& statements);
    /// "const NAME_real x[4], NAME_real t".
    std::string text(const std::vector<Argument>& arguments);
    /// The body of a function, without its braces. Arguments that it does not use are cast to void.
    std::string body(const FunctionBody& body);
    /// Tables of measured characteristics.
    std::string curves(const std::vector<PlantCurve>& curves);

    /// Functions of the runtime that were called so far.
    const std::set<CHelper>& called() const { return called_; }
    void call(CHelper helper) { called_.insert(std::move(helper)); }

private:
    std::string operand(const Value& value, int least_precedence);
    std::string listed(const std::vector<Value>& parts, const char* between);
    std::string sum(const Value& value);
    std::string product(const Value& value);
    std::string call(const Value& value);
    std::string member(const Value& value) const;
    std::string comparison(const Value& value);
    std::string declaration(const Declaration& d);
    std::string filled_by_call(const Declaration& d);
    std::string assignment(const Assignment& a);
    std::string filling(const Filling& f);
    std::string inputs(const std::string& name) const;
    std::string loop(const Loop& loop);
    std::string modes(const ByMode& by_mode);
    std::string braced(const std::string& head, const Statements& body);
    std::string one(const Statement& statement);

    const Plant& plant_;
    std::string name_;
    std::set<CHelper> called_;
};

}  // namespace dalembert

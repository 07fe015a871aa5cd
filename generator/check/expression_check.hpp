// SPDX-License-Identifier: GPL-3.0-or-later
// Words of an expression and what they may depend on: names and indices (check_expressions.cpp), functions and what is written like them
// (check_calls.cpp), derived quantities with what stands in their brackets (check_quantities.cpp).
#pragma once

#include <set>
#include <vector>

#include "check/checks.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

/// Each visit reports what is wrong and returns what the expression depends on (bits of Dependence).
class ExpressionCheck {
public:
    ExpressionCheck(const Names& names, Diagnostics& diagnostics) : names_(names), diagnostics_(diagnostics) {}

    /// Reports what is unknown, and the first part that the site must not depend on.
    void check(const Site& site);

private:
    using Kind = Expression::Kind;

    void error(Id id, const Span& span, std::string message, std::vector<Note> notes = {});
    unsigned visit(const Expression& e);
    /// Where the name at the bottom of an expression such as dot(phi) is defined.
    std::vector<Note> definition_of(const Expression& e) const;
    /// Reports a dependence that the site does not allow.
    unsigned allow(const Expression& e, unsigned depends, const char* is_a);
    /// A rate as C++ calls it, or a name like it.
    std::string hint(const Expression& e) const;
    unsigned name(const Expression& e);
    unsigned sizes_only(const Expression& e);
    unsigned definition(const Expression& e, const Definition& item);
    void index(const Expression& e, const Item& item);
    /// An index: sizes and bound indices only.
    void whole_number(const Expression& e);
    unsigned sum(const Expression& e);

    unsigned call(const Expression& e);
    unsigned derivative(const Expression& e);
    unsigned partial(const Expression& e);
    unsigned integral(const Expression& e);
    /// quantity(9.81, m/s^2)
    unsigned quantity_in_unit(const Expression& e);
    unsigned at_place(const Expression& e);
    /// A place that may lie at infinity.
    unsigned end(const Expression& e, bool may_be_infinite);
    bool derived_allowed(const Expression& e);

    unsigned quantity(const Expression& e);
    /// A quantity of a solid, of a load, or of a body that may stick.
    unsigned statics_quantity(const Expression& e, const QuantitySpec& spec);
    /// A quantity of a volume, reservoir, medium or flow.
    unsigned part_quantity(const Expression& e, const QuantitySpec& spec);
    /// The name of an element of one of these kinds, with an index where it is a family.
    void element(const Expression& e, const std::vector<const char*>& kinds);

    const Names& names_;
    Diagnostics& diagnostics_;
    const Site* site_ = nullptr;
    std::set<std::string, std::less<>> bound_;
    std::set<std::string> shadowing_;
    bool reported_ = false;
};

}  // namespace dalembert

// SPDX-License-Identifier: GPL-3.0-or-later
// What a user wrote in a formula, with the place of every part. Nothing is simplified here.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "language/rational.hpp"
#include "text/source.hpp"

namespace dalembert {

struct Expression;
using ExpressionPtr = std::shared_ptr<const Expression>;

struct Expression {
    enum class Kind {
        number,    ///< value; of one that was written with a unit, in SI, with the SI unit as name
        name,      ///< name, children are its indices: phi, phi[k], mass_matrix[s, phi]
        call,      ///< name(children)
        negate,    ///< -children[0]
        add,       ///< children[0] + children[1]
        subtract,  ///< children[0] - children[1]
        multiply,
        divide,
        power,
        sum,  ///< sum(name, children[0], children[1], children[2]): index, from, to, term
    };
    Kind kind;
    Span span;
    Rational value = 0;
    std::string name = {};
    std::vector<ExpressionPtr> children = {};

    bool is_name() const { return kind == Kind::name && children.empty(); }
    /// The text as the user wrote it.
    std::string written() const { return std::string(span.text()); }
};

/// A law of one variable, written "e -> c*e + c3*e^3".
struct Law {
    std::string variable;
    ExpressionPtr body;
    Span span;
};

/// A property of a material: an expression (no variables), or a law of one or two, "T -> ...", "(p, T) -> ...".
struct Property {
    std::vector<std::string> variables;
    ExpressionPtr body;
    Span span;
};

/// "a = b" or "a = b = c": at least two sides.
struct Equation {
    std::vector<ExpressionPtr> sides;
    Span span;
    std::string entry = {};  ///< of an equation of matrices that is taken apart, "row 1, column 2"
    std::string sizes = {};  ///< of a third row that the text leaves out in the plane: what is wrong if it is not zero
    bool is_near_zero = false;  ///< printed with '\approx 0', which does not say how near
};

/// "k = 1..N": the members of a family.
struct Family {
    std::string index;
    ExpressionPtr from;
    ExpressionPtr to;
    Span span;
};

/// An expression that no user wrote, at the place of the thing it stands for.
ExpressionPtr make_number(Rational value, Span span);
ExpressionPtr make_name(std::string name, Span span);
ExpressionPtr make_binary(Expression::Kind kind, ExpressionPtr left, ExpressionPtr right);

/// Whether it is made of more than numbers and pi.
bool has_names(const Expression& expression);

/// Calls visit for the expression and everything below it, parents first.
void for_each(const Expression& expression, const std::function<void(const Expression&)>& visit);

}  // namespace dalembert

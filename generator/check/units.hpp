// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of every expression, from the units of the names in it.
#pragma once

#include <map>

#include "elements/names.hpp"
#include "language/vocabulary.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// The dimension of an expression. A literal 0 fits every dimension; so does what could not be determined.
struct Measure {
    Dimension dimension;
    bool fits_all = false;
};

class Units {
public:
    using Bound = std::map<std::string, Dimension, std::less<>>;

    /// The time is a number of seconds without a unit where `is_time_plain`.
    Units(const Names& names, Diagnostics& diagnostics, bool is_time_plain = false)
        : names_(names), diagnostics_(diagnostics), is_time_plain_(is_time_plain) {}

    /// Reports disagreements inside the expression (unit-mismatch).
    Measure of(const Expression& expression, const Bound& bound);
    /// Reports when the expression is not in the expected unit. What is named in the sentence.
    void expect(const Expression& expression, const Dimension& expected, const std::string& what, const Bound& bound = {});
    /// Of a coordinate.
    Dimension of_coordinate(std::string_view name) const;

private:
    Measure name(const Expression& e, const Bound& bound);
    Measure quantity(const Expression& e, const Bound& bound);
    Measure call(const Expression& e, const Bound& bound);
    Measure function(const FunctionSpec& function, const Expression& e, const Bound& bound);
    Measure power(const Expression& e, const Bound& bound);
    Measure agreeing(const Expression& whole, const Expression& a, const Measure& ma, const Expression& b, const Measure& mb);
    Measure mismatch(const Expression& at, std::string message, std::initializer_list<const Expression*> sides);
    void dimensionless(const Expression& e, const std::string& what, const Bound& bound);

    const Names& names_;
    Diagnostics& diagnostics_;
    std::map<const Definition*, Measure> definitions_;
    bool is_time_plain_;
};

}  // namespace dalembert

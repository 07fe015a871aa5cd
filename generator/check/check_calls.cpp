// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/expression_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/curves.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// How functions of other languages are written here; empty for what none has.
std::string foreign_function(std::string_view name) {
    static const std::map<std::string_view, const char*> usual{{"ln", "log(x)"},
                                                               {"lg", "log(x)/log(10)"},
                                                               {"log10", "log(x)/log(10)"},
                                                               {"log2", "log(x)/log(2)"},
                                                               {"arcsin", "asin(x)"},
                                                               {"arccos", "acos(x)"},
                                                               {"arctan", "atan(x)"},
                                                               {"arctan2", "atan2(y, x)"},
                                                               {"tg", "tan(x)"},
                                                               {"cot", "1/tan(x)"},
                                                               {"fabs", "abs(x)"},
                                                               {"sgn", "sign(x)"},
                                                               {"signum", "sign(x)"},
                                                               {"pow", "x^y"},
                                                               {"sqr", "x^2"},
                                                               {"square", "x^2"},
                                                               {"cbrt", "x^(1/3)"},
                                                               {"root", "x^(1/n)"},
                                                               {"der", "dot(x)"}};
    const auto found = usual.find(name);
    return found == usual.end() ? std::string() : found->second;
}

}  // namespace

unsigned ExpressionCheck::call(const Expression& e) {
    if (e.name == "dot" || e.name == "ddot") return derivative(e);
    if (e.name == "diff") return partial(e);
    if (e.name == "integral") return integral(e);
    if (e.name == "quantity") return quantity_in_unit(e);
    if (e.name == "limit" || e.name == "at") return at_place(e);
    const FunctionSpec* function = find_function(e.name);
    unsigned result = 0;
    for (const ExpressionPtr& child : e.children) result |= visit(*child);
    if (const Curve* curve = names_.find_element<Curve>(e.name); function == nullptr && curve != nullptr) {
        if (const std::size_t count = curve->grid ? 2 : 1; e.children.size() != count)
            error(Id::wrong_arguments, e.span,
                  fmt::format("curve '{}({})' takes {} argument{}, here it has {}", e.name, arguments_of(*curve), count,
                              count == 1 ? "" : "s", e.children.size()),
                  {{curve->span, fmt::format("'{}' is defined here", e.name)}});
        return result;
    }
    static const std::set<std::string, std::less<>> of_matrices{"transpose", "inverse", "det", "trace", "cross", "diag"};
    if (function == nullptr && of_matrices.contains(e.name)) {
        // What is known to be a matrix is gone by now, so that something in it is not.
        if (!diagnostics_.has_errors())
            error(Id::wrong_arguments, e.span,
                  fmt::format("'{}' takes a matrix, but '{}' is not defined as one; define it under 'with', as in A = \"matrix(row(a, b), "
                              "row(c, d))\"",
                              e.name, e.children.empty() ? e.written() : e.children[0]->written()));
    } else if (function == nullptr) {
        std::vector<std::string> known{"dot", "ddot", "sum"};
        for (const FunctionSpec& f : functions()) known.emplace_back(f.name);
        for (const std::string& curve : names_.names_of({"curve"})) known.push_back(curve);
        const std::string usual = foreign_function(e.name);
        error(Id::unknown_name, e.span,
              fmt::format("there is no function '{}'{}", e.name, usual.empty() ? did_you_mean(e.name, known) : "; write " + usual));
    } else if (const std::size_t count = function->count(); e.children.size() != count) {
        error(Id::wrong_arguments, e.span,
              fmt::format("'{}({})' takes {} argument{}, here it has {}", e.name, function->arguments, count, count == 1 ? "" : "s",
                          e.children.size()));
    }
    return result;
}

unsigned ExpressionCheck::derivative(const Expression& e) {
    if (e.children.size() != 1) {
        error(Id::wrong_arguments, e.span, fmt::format("'{}' takes one argument, here it has {}", e.name, e.children.size()));
        return 0;
    }
    // What is differentiated is not what the site depends on; its derivative is. So the site is asked about that alone.
    const Site inner{site_->expression, on_anything, site_->what, {}};
    const Site& outer = *site_;
    site_ = &inner;
    unsigned depends = visit(*e.children[0]);
    site_ = &outer;
    for (int order = e.name == "dot" ? 1 : 2; order > 0; --order) {
        if ((depends & on_inputs) != 0)
            error(Id::not_allowed_here, e.span,
                  fmt::format("'{}' needs the time derivative of an input, which is not known", e.written()));
        depends = derivative_dependence(depends);
    }
    if (site_->sizes_only) return sizes_only(e);
    return allow(e, depends, (depends & on_accelerations) != 0 ? "an acceleration" : "a velocity");
}

unsigned ExpressionCheck::partial(const Expression& e) {
    if (!derived_allowed(e)) return 0;
    if (e.children.size() != 2) {
        error(Id::wrong_arguments, e.span, "'diff' takes an expression and a variable, as in 'diff(kinetic_energy, dot(phi))'");
        return 0;
    }
    return visit(*e.children[0]) | visit(*e.children[1]);
}

unsigned ExpressionCheck::integral(const Expression& e) {
    if (!derived_allowed(e)) return 0;
    if (e.children.size() != 4 || e.children[1]->kind != Kind::name || !e.children[1]->children.empty()) {
        error(Id::wrong_arguments, e.span, "'integral' takes a function, its variable and two limits, as in 'integral(x^2, x, 0, l)'");
        return 0;
    }
    const unsigned limits = end(*e.children[2], true) | end(*e.children[3], true);
    const auto inserted = bound_.insert(e.children[1]->name);
    const unsigned result = limits | visit(*e.children[0]);
    if (inserted.second) bound_.erase(inserted.first);
    return result;
}

unsigned ExpressionCheck::quantity_in_unit(const Expression& e) {
    if (!derived_allowed(e)) return 0;
    if (e.children.size() != 2) {
        error(Id::wrong_arguments, e.span, "'quantity' takes a number and its unit, as in 'quantity(9.81, m/s^2)'");
        return 0;
    }
    try {
        evaluate_unit(*e.children[1]);
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) error(d.id, d.span, d.message);
    }
    return visit(*e.children[0]);
}

unsigned ExpressionCheck::at_place(const Expression& e) {
    if (!derived_allowed(e)) return 0;
    const bool has_side = e.name == "limit" && e.children.size() == 4;
    if (e.children.size() != 3 && !has_side) {
        error(Id::wrong_arguments, e.span,
              fmt::format("'{0}' takes an expression, its variable and a place, as in '{0}(sin(x)/x, x, 0)'", e.name));
        return 0;
    }
    const Expression& variable = *e.children[1];
    const Expression* side = has_side ? e.children[3].get() : nullptr;
    if (side != nullptr && side->kind == Kind::negate) side = side->children[0].get();
    if (side != nullptr && !(side->kind == Kind::number && side->value == 1))
        error(Id::wrong_arguments, e.children[3]->span, "the side of a limit is 1, from above, or -1, from below");
    if (variable.kind != Kind::name && !(variable.kind == Kind::call && (variable.name == "dot" || variable.name == "ddot")))
        error(Id::wrong_arguments, variable.span, fmt::format("'{}' is not a variable, and '{}' needs one", variable.written(), e.name));
    return visit(*e.children[0]) | visit(variable) | end(*e.children[2], e.name == "limit");
}

unsigned ExpressionCheck::end(const Expression& e, bool may_be_infinite) {
    const Expression& place = e.kind == Kind::negate ? *e.children[0] : e;
    return may_be_infinite && place.kind == Kind::name && place.name == "infinity" ? 0 : visit(e);
}

bool ExpressionCheck::derived_allowed(const Expression& e) {
    if ((site_->allowed & on_quantities) != 0) return true;
    error(Id::not_allowed_here, e.span, fmt::format("'{}' is for outputs and printed equations; {} is neither", e.name, site_->what));
    return false;
}

}  // namespace dalembert
